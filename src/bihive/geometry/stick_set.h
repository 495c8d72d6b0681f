// Sticks between spheres of a set, such as the bonds of a molecule.
//
// A pair of which one sphere is an image along the periodic cell has two stubs instead of a stick: from either sphere
// half the way to the image of the other one. So nothing crosses the cell, and copies of the cell join their stubs.
//
// So has a pair of spheres of different opacity, because a stick has one opacity: its stubs meet in the middle.
//
// A set may also have sticks with ends and radii of their own, such as arrows. Each belongs to a sphere, or each half
// to one, whose appearance it has, but for a colour and an opacity of its own.
//
// Sticks have ids too, after those of all spheres: each half of a stick has one, because it looks like the sphere at
// its end. With N = SphereSet::total_size(), the halves of stick k are N + 2 k, at its first end, and N + 2 k + 1. Both
// halves of a stub look like its sphere. So spheres win over sticks at equal t, by the rule of the smaller id. Copies
// of the set (SphereSet::replicate) have copies of the sticks: that of stick k in copy c is stick c * size() + k.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/geometry/stick.h"
#include "bihive/math/aabb.h"

namespace bihive {

/// Two spheres, by their ids.
using SpherePair = std::array<std::int32_t, 2>;

/// The second of them as an image: moved by `image` times the vectors of the set's cell.
struct ImagePair {
  SpherePair pair{};
  std::array<std::int64_t, 3> image{};

  bool is_image() const { return image != std::array<std::int64_t, 3>{}; }
  friend bool operator==(const ImagePair& a, const ImagePair& b) { return a.pair == b.pair && a.image == b.image; }
  friend bool operator<(const ImagePair& a, const ImagePair& b) {
    return a.pair != b.pair ? a.pair < b.pair : a.image < b.image;
  }
};

/// A stick with ends of its own: local positions and radii (SphereSet), one of which may be 0.
struct OwnStick {
  Vec3d a, b;
  double radius_a = 0, radius_b = 0;
  std::int32_t sphere = 0;           ///< to which it belongs
  std::optional<Vec3f> colour = {};  ///< linear RGB; unset: that of the sphere
  float opacity = 1;                 ///< 0 to 1: multiplies that of the sphere
  std::int32_t other = -1;           ///< to which its second half belongs; below 0: the same sphere
};

/// 8 bytes for each stick, 20 for a stub, 56 for one with ends of its own. The spheres are not kept: queries get them.
class StickSet {
 public:
  StickSet() = default;

  /// A stick of this radius (world units) between the centres of each pair. Error: a radius that is not above 0, or
  /// larger than the set's extent; an id of no stored sphere.
  static Result<StickSet> between(const SphereSet& spheres, std::vector<SpherePair> pairs, double radius);
  /// The same with two stubs for each pair with an image, after all sticks, and for each pair that `is_parted` names:
  /// in these, stubs meet in the middle. Makes room in the stored units of the spheres where stubs end far outside.
  /// More errors: a pair with an image where there is no cell.
  static Result<StickSet> between(SphereSet& spheres, const std::vector<ImagePair>& pairs, double radius,
                                  const std::function<bool(const SpherePair&)>& is_parted = nullptr);

  /// Appends sticks with ends of their own, after all others. Makes room in the stored units of the spheres where they
  /// reach farther. Error: a number that is not finite or beyond binary32, a negative radius, two radii that are 0 in
  /// binary32, an id of no stored sphere, an opacity out of range. Then no stick is added.
  Status add(SphereSet& spheres, const std::vector<OwnStick>& sticks);

  std::int64_t size() const { return static_cast<std::int64_t>(pairs_.size() + own_.size()); }
  bool empty() const { return size() == 0; }
  /// Those between spheres, which come first. The second of a stub is below 0.
  const std::vector<SpherePair>& pairs() const { return pairs_; }
  /// The sticks with ends of their own: from pairs().size() on.
  std::int64_t own_count() const { return static_cast<std::int64_t>(own_.size()); }
  bool has_own_ends(std::int64_t stick) const { return own_at(stick % size()) != nullptr; }
  /// Of those between spheres, in stored units of the spheres.
  double stored_radius() const { return double(radius_); }
  /// The larger one of a stick, in stored units of the spheres.
  double stored_radius(std::int64_t stick) const {
    const Own* const own = own_at(stick % size());
    return double(own == nullptr ? radius_ : std::max(own->radius_a, own->radius_b));
  }

  /// With those of all copies of the set. Every stick below is one.
  std::int64_t total_size(const SphereSet& spheres) const { return size() * spheres.images().count(); }
  /// The sphere at the end of a half: 2 k or 2 k + 1.
  std::int64_t sphere_at(const SphereSet& spheres, std::int64_t half) const {
    const std::int64_t copy = half < 2 * size() ? 0 : half / 2 / size();
    const std::int64_t stick = half / 2 - copy * size();
    if (const Own* const own = own_at(stick))
      return own->spheres[static_cast<std::size_t>(half % 2)] + copy * spheres.size();
    const SpherePair& pair = pairs_[static_cast<std::size_t>(stick)];
    const std::int32_t stored = half % 2 == 0 || pair[1] < 0 ? pair[0] : pair[1];
    return stored + copy * spheres.size();
  }
  /// Whether some stick has a colour of its own.
  bool has_colours() const { return has_colours_; }
  /// The colour of its own that a half has, linear RGB; null: that of its sphere.
  const Vec3f* colour_at(std::int64_t half) const {
    const Own* const own = own_at(half / 2 % size());
    return own == nullptr || own->colour.x < 0 ? nullptr : &own->colour;
  }
  /// Whether some stick has an opacity of its own, below 1.
  bool has_opacities() const { return has_opacities_; }
  /// The factor that a half has for the opacity of its sphere.
  double opacity_at(std::int64_t half) const {
    const Own* const own = own_at(half / 2 % size());
    return own == nullptr ? 1 : double(own->opacity);
  }
  /// In stored units. The ends of a copy are rounded to binary32, as the centres of its spheres are.
  Stick stored(const SphereSet& spheres, std::int64_t stick) const {
    const std::int64_t copy = stick < size() ? 0 : stick / size();
    Stick made = of_first_copy(spheres, stick - copy * size());
    if (copy > 0) {
      const Vec3d shift = spheres.scale() * spheres.images().shift(copy);
      made.a = to_double(to_float(made.a + shift));
      made.b = to_double(to_float(made.b + shift));
    }
    return made;
  }
  /// The box of a stored stick as a tree uses it: of its ends, rounded to nearest as those of spheres.
  Aabb stored_box(const SphereSet& spheres, std::int64_t stick) const {
    Aabb box;
    const auto add_ball = [&box](Vec3f centre, float radius) {
      box.add({{centre.x - radius, centre.y - radius, centre.z - radius},
               {centre.x + radius, centre.y + radius, centre.z + radius}});
    };
    if (const Own* const own = own_at(stick)) {
      add_ball(own->a, own->radius_a);
      add_ball(own->b, own->radius_b);
      return box;
    }
    for (const std::int32_t id : pairs_[static_cast<std::size_t>(stick)]) add_ball(end(spheres, id), radius_);
    return box;
  }

  /// The same sticks in the same order, between the same spheres.
  friend bool operator==(const StickSet& a, const StickSet& b) {
    return a.radius_ == b.radius_ && a.pairs_ == b.pairs_ && a.free_ends_ == b.free_ends_ && a.own_ == b.own_;
  }

  std::int64_t allocated_bytes() const {
    return static_cast<std::int64_t>(pairs_.capacity() * sizeof(SpherePair) + free_ends_.capacity() * sizeof(Vec3f) +
                                     own_.capacity() * sizeof(Own));
  }

 private:
  static constexpr Vec3f kColourOfSphere{-1, -1, -1};

  // In stored units.
  struct Own {
    Vec3f a, b;
    float radius_a, radius_b;
    SpherePair spheres;  // of each half
    Vec3f colour;
    float opacity;

    friend bool operator==(const Own& one, const Own& other) {
      return one.a == other.a && one.b == other.b && one.radius_a == other.radius_a && one.radius_b == other.radius_b &&
             one.spheres == other.spheres && one.colour == other.colour && one.opacity == other.opacity;
    }
  };

  // Null: the stick is between spheres.
  const Own* own_at(std::int64_t stick) const {
    const std::int64_t between = static_cast<std::int64_t>(pairs_.size());
    return stick < between ? nullptr : &own_[static_cast<std::size_t>(stick - between)];
  }

  Stick of_first_copy(const SphereSet& spheres, std::int64_t stick) const {
    if (const Own* const own = own_at(stick))
      return {to_double(own->a), to_double(own->b), double(own->radius_a), double(own->radius_b)};
    const SpherePair& pair = pairs_[static_cast<std::size_t>(stick)];
    return {to_double(end(spheres, pair[0])), to_double(end(spheres, pair[1])), double(radius_), double(radius_)};
  }

  // In stored units.
  Vec3f end(const SphereSet& spheres, std::int32_t id) const {
    if (id < 0) return free_ends_[static_cast<std::size_t>(-1 - id)];
    const auto i = static_cast<std::size_t>(id);
    return {spheres.x()[i], spheres.y()[i], spheres.z()[i]};
  }

  Status set_radius(const SphereSet& spheres, double radius);
  // The stored units of the spheres have become smaller by a power of two.
  void change_exponent(int change);

  std::vector<SpherePair> pairs_;  // the second of a stub is -1 - k for free end k
  std::vector<Vec3f> free_ends_;
  std::vector<Own> own_;
  bool has_colours_ = false, has_opacities_ = false;
  float radius_ = 0;  // stored units
};

/// Boxes of sticks may end at 2 in stored units, where binary32 rounds by up to 2^-24: padding that their traversal
/// needs beside that of spheres, whose boxes end at 1 (docs/precision.md).
constexpr double kPadOfSticks = 0x1p-24;

/// Rounding moves the ends of a copy by up to 2^-25, and its shift is rounded too.
constexpr double kPadOfCopies = 0x1p-24;

/// A valid ray as the sticks between `spheres` meet it; ray.leaves is the id of a sphere or of half a stick.
inline StickRay stick_ray(const Ray& ray, const SphereSet& spheres, const StickSet& sticks) {
  StickRay made{ScaledRay(ray, spheres)};
  const std::int64_t half = ray.leaves - spheres.total_size();
  if (half < 0 || half >= 2 * sticks.total_size(spheres)) return made;
  made.leaves_stick = true;
  made.left = sticks.stored(spheres, half / 2);
  return made;
}

/// The same ray as the spheres meet it. A ray that exits a stick outward does not meet a sphere at its end that lies in
/// the stick, because the stick is convex: it exits the surface that both may share.
inline std::int64_t left_sphere(const SphereSet& spheres, const StickSet& sticks, std::int64_t leaves, bool inside) {
  const std::int64_t half = leaves - spheres.total_size();
  if (half < 0 || half >= 2 * sticks.total_size(spheres)) return leaves;
  if (inside) return kNothing;
  const std::int64_t sphere = sticks.sphere_at(spheres, half);
  const double radius = spheres.stored_radius(sphere);
  if (!sticks.has_own_ends(half / 2)) return radius <= sticks.stored_radius() ? sphere : kNothing;
  const Stick stick = sticks.stored(spheres, half / 2);
  const Vec3d centre = spheres.stored_centre(sphere);
  const bool in_stick =
      (centre == stick.a && radius <= stick.radius_a) || (centre == stick.b && radius <= stick.radius_b);
  return in_stick ? sphere : kNothing;
}

/// The half of a stick on which a hit lies.
inline std::int64_t half_of(std::int64_t stick, const StickHit& hit) {
  return 2 * stick + (hit.s > 0.5 ? 1 : 0);
}

}  // namespace bihive
