#include "bihive/geometry/stick_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace bihive {
namespace {

Status check_ends(const SphereSet& spheres, const SpherePair& pair) {
  for (const std::int32_t id : pair)
    if (id < 0 || id >= spheres.size())
      return Error{"there is no sphere " + std::to_string(id) + " at the end of a stick", "", 0, 0, ""};
  return Done{};
}

SpherePair spheres_of_halves(const OwnStick& stick) {
  return {stick.sphere, stick.other < 0 ? stick.sphere : stick.other};
}

}  // namespace

Status StickSet::set_radius(const SphereSet& spheres, double radius) {
  radius_ = static_cast<float>(radius * spheres.scale());
  if (!(radius > 0) || !(radius_ > 0 && radius_ <= 1))
    return Error{"the radius of sticks must be above 0, and at most the extent of the spheres", "", 0, 0, ""};
  return Done{};
}

Result<StickSet> StickSet::between(const SphereSet& spheres, std::vector<SpherePair> pairs, double radius) {
  StickSet made;
  if (pairs.empty()) return made;
  if (Status status = made.set_radius(spheres, radius); !status) return status.error();
  for (const SpherePair& pair : pairs)
    if (Status status = check_ends(spheres, pair); !status) return status.error();
  made.pairs_ = std::move(pairs);
  return made;
}

Result<StickSet> StickSet::between(SphereSet& spheres, const std::vector<ImagePair>& pairs, double radius,
                                   const std::function<bool(const SpherePair&)>& is_parted) {
  StickSet made;
  if (pairs.empty()) return made;
  std::vector<const ImagePair*> with_stubs;
  for (const ImagePair& one : pairs) {
    if (Status status = check_ends(spheres, one.pair); !status) return status.error();
    if (one.is_image() && !spheres.cell()) return Error{"sticks to images need a periodic cell", "", 0, 0, ""};
    if (one.is_image() || (is_parted && is_parted(one.pair)))
      with_stubs.push_back(&one);
    else
      made.pairs_.push_back(one.pair);
  }
  if (with_stubs.size() > std::numeric_limits<std::int32_t>::max() / 2)
    return Error{"there are more than 2^30 sticks in two parts", "", 0, 0, ""};

  // Stubs end half the way to the image of the other sphere: local positions.
  std::vector<Vec3d> ends;
  const Images::Shifts of_copies = spheres.images().shifts();
  double extent = 0;
  for (const ImagePair* const one : with_stubs) {
    Vec3d shift;
    if (one->is_image()) {
      const auto& [a, b, c] = spheres.cell()->vectors;
      shift = double(one->image[0]) * a + double(one->image[1]) * b + double(one->image[2]) * c;
    }
    const Vec3d from = spheres.local_centre(one->pair[0]), to = spheres.local_centre(one->pair[1]);
    const Vec3d half = 0.5 * (to + shift - from);
    for (const Vec3d& end : {from + half, to - half}) {
      for (int axis = 0; axis < 3; ++axis)
        extent = std::max({extent, std::abs(end[axis] + of_copies.lo[axis]), std::abs(end[axis] + of_copies.hi[axis])});
      ends.push_back(end);
    }
  }
  if (!(extent <= double(std::numeric_limits<float>::max())))
    return Error{"sticks to images must fit single precision (3.4e38)", "", 0, 0, ""};
  spheres.make_room(extent);
  if (Status status = made.set_radius(spheres, radius); !status) return status.error();
  for (std::size_t k = 0; k < ends.size(); ++k) {
    made.pairs_.push_back({with_stubs[k / 2]->pair[k % 2], -1 - static_cast<std::int32_t>(k)});
    made.free_ends_.push_back(to_float(spheres.scale() * ends[k]));
  }
  return made;
}

Status StickSet::add(SphereSet& spheres, const std::vector<OwnStick>& sticks) {
  if (sticks.empty()) return Done{};
  if (size() + static_cast<std::int64_t>(sticks.size()) > std::numeric_limits<std::int32_t>::max())
    return Error{"there are more than 2^31 sticks", "", 0, 0, ""};

  // The room that they take, with those of all copies.
  const Images::Shifts of_copies = spheres.images().shifts();
  double extent = 0;
  for (const OwnStick& one : sticks) {
    for (const std::int32_t id : spheres_of_halves(one))
      if (id < 0 || id >= spheres.size())
        return Error{"a stick belongs to sphere " + std::to_string(id) + ", which there is not", "", 0, 0, ""};
    if (!(one.opacity >= 0 && one.opacity <= 1))
      return Error{"the opacity of a stick must lie from 0 to 1", "", 0, 0, ""};
    for (const auto& [end, radius] : {std::pair(one.a, one.radius_a), std::pair(one.b, one.radius_b)}) {
      if (!(radius >= 0)) return Error{"the radius of a stick must be at least 0", "", 0, 0, ""};
      for (int axis = 0; axis < 3; ++axis) {
        const double low = end[axis] + of_copies.lo[axis] - radius, high = end[axis] + of_copies.hi[axis] + radius;
        if (!(std::isfinite(low) && std::isfinite(high)))
          return Error{"the ends and radii of sticks must be finite", "", 0, 0, ""};
        extent = std::max({extent, std::abs(low), std::abs(high)});
      }
    }
  }
  if (!(extent <= double(std::numeric_limits<float>::max())))
    return Error{"sticks must fit single precision (3.4e38)", "", 0, 0, ""};
  const int before = spheres.scale_exponent();
  spheres.make_room(extent);
  change_exponent(spheres.scale_exponent() - before);

  std::vector<Own> added;
  added.reserve(sticks.size());
  for (const OwnStick& one : sticks) {
    const auto stored = [&](double number) { return static_cast<float>(spheres.scale() * number); };
    added.push_back({to_float(spheres.scale() * one.a), to_float(spheres.scale() * one.b), stored(one.radius_a),
                     stored(one.radius_b), spheres_of_halves(one), one.colour.value_or(kColourOfSphere), one.opacity});
    if (!(added.back().radius_a > 0 || added.back().radius_b > 0))
      return Error{"a stick must have a radius above 0, and not vanish beside the extent of the spheres", "", 0, 0, ""};
  }
  for (const OwnStick& one : sticks) {
    has_colours_ = has_colours_ || one.colour.has_value();
    has_opacities_ = has_opacities_ || one.opacity < 1;
  }
  own_.insert(own_.end(), added.begin(), added.end());
  return Done{};
}

void StickSet::change_exponent(int change) {
  if (change == 0) return;
  const auto scale = [change](float& number) { number = static_cast<float>(std::ldexp(double(number), change)); };
  const auto scale_point = [&](Vec3f& point) {
    for (int axis = 0; axis < 3; ++axis) scale(point[axis]);
  };
  scale(radius_);
  for (Vec3f& end : free_ends_) scale_point(end);
  for (Own& one : own_) {
    scale_point(one.a);
    scale_point(one.b);
    scale(one.radius_a);
    scale(one.radius_b);
  }
}

}  // namespace bihive
