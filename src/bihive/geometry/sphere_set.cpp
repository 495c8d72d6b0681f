#include "bihive/geometry/sphere_set.h"

#include <algorithm>
#include <cstdio>
#include <limits>

namespace bihive {
namespace {

// The set counts radii below this share of the extent: their squares still fit binary32, but little else does.
constexpr double kVanishingShare = 0x1p-60;

// Scales the smallest number of binary32, 2^-149, to 1. A binary64 file may hold smaller sets, but no ray can see them,
// and a larger scale could overflow.
constexpr int kLargestScaleExponent = 149;

template <class T>
std::int64_t bytes_of(const std::vector<T>& array) {
  return static_cast<std::int64_t>(array.capacity() * sizeof(T));
}

Error bad_sphere(std::size_t i, const std::string& what, double value) {
  char number[40];
  std::snprintf(number, sizeof number, "%.9g", value);
  return {"sphere " + std::to_string(i) + ": " + what + " is " + number, "", 0, 0, ""};
}

}  // namespace

template <class T>
Result<SphereSet> SphereSet::make(const std::vector<T>& x, const std::vector<T>& y, const std::vector<T>& z,
                                  const std::vector<T>& r) {
  BIHIVE_CHECK_EQ(x.size(), y.size());
  BIHIVE_CHECK_EQ(x.size(), z.size());
  BIHIVE_CHECK_EQ(x.size(), r.size());

  // Check every number, and find the farthest bound from 0.
  constexpr double kLargest = std::numeric_limits<float>::max();
  double extent = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double values[4] = {double(x[i]), double(y[i]), double(z[i]), double(r[i])};
    const char* const names[4] = {"x", "y", "z", "the radius"};
    for (int k = 0; k < 4; ++k) {
      if (!std::isfinite(values[k])) return bad_sphere(i, std::string(names[k]) + " must be finite but", values[k]);
      if (!(std::abs(values[k]) <= kLargest))
        return bad_sphere(i, std::string(names[k]) + " must fit single precision (3.4e38) but", values[k]);
      if (k < 3) extent = std::max(extent, std::abs(values[k]) + values[3]);
    }
    if (values[3] < 0) return bad_sphere(i, "the radius must not be negative but", values[3]);
  }

  // Choose the power of two that brings that bound into [1/2, 1], and round once.
  SphereSet set;
  if (extent > 0) std::frexp(extent, &set.scale_exponent_);
  set.scale_exponent_ = std::min(-set.scale_exponent_, kLargestScaleExponent);
  const double scale = set.scale();
  const auto round = [scale](const std::vector<T>& world) {
    std::vector<float> stored(world.size());
    for (std::size_t i = 0; i < world.size(); ++i) stored[i] = static_cast<float>(double(world[i]) * scale);
    return stored;
  };
  set.x_ = round(x);
  set.y_ = round(y);
  set.z_ = round(z);
  set.r_ = round(r);
  for (std::size_t i = 0; i < r.size(); ++i)
    if (r[i] > 0 && double(r[i]) * scale < kVanishingShare) ++set.vanishing_radii_;
  return set;
}

Result<SphereSet> SphereSet::from_world(const std::vector<double>& x, const std::vector<double>& y,
                                        const std::vector<double>& z, const std::vector<double>& r) {
  return make(x, y, z, r);
}

Result<SphereSet> SphereSet::from_world(const std::vector<float>& x, const std::vector<float>& y,
                                        const std::vector<float>& z, const std::vector<float>& r) {
  return make(x, y, z, r);
}

SphereSet::Bounds SphereSet::bounds() const {
  constexpr double inf = std::numeric_limits<double>::infinity();
  Bounds box{{inf, inf, inf}, {-inf, -inf, -inf}};
  for (std::int64_t id = 0; id < size(); ++id) {
    const Vec3d c = stored_centre(id);
    const double radius = stored_radius(id);
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], c[axis] - radius);
      box.hi[axis] = std::max(box.hi[axis], c[axis] + radius);
    }
  }
  return {box.lo * inverse_scale(), box.hi * inverse_scale()};
}

SphereSet SphereSet::part(const std::vector<std::int64_t>& ids) const {
  SphereSet made;
  made.scale_exponent_ = scale_exponent_;
  const auto take = [&](const std::vector<float>& from, std::vector<float>& to) {
    to.reserve(ids.size());
    for (const std::int64_t id : ids) to.push_back(from[static_cast<std::size_t>(id)]);
  };
  take(x_, made.x_);
  take(y_, made.y_);
  take(z_, made.z_);
  take(r_, made.r_);
  for (const float radius : made.r_)
    if (radius > 0 && double(radius) < kVanishingShare) ++made.vanishing_radii_;
  return made;
}

std::int64_t SphereSet::allocated_bytes() const {
  std::int64_t bytes = bytes_of(x_) + bytes_of(y_) + bytes_of(z_) + bytes_of(r_);
  bytes += attributes_.allocated_bytes();
  return bytes;
}

}  // namespace bihive
