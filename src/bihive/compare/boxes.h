// Boxes that never cull too much: outward rounding, and a ray or a point against a box.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/aabb.h"
#include "bihive/math/interval.h"
#include "bihive/math/vec3.h"

namespace bihive::workbench {

/// The largest binary32 number that is not above `value`, and the smallest that is not below.
inline float rounded_down(double value) {
  const auto nearest = static_cast<float>(value);
  return double(nearest) > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}
inline float rounded_up(double value) {
  return -rounded_down(-value);
}

/// The box of a sphere in stored units, rounded outward. centre -/+ radius is a sum in binary64, wrong by at most
/// 2^-53: the padding below allows for it.
inline Aabb outward_box(const SphereSet& spheres, std::int64_t id) {
  const Vec3d centre = spheres.stored_centre(id);
  const double radius = spheres.stored_radius(id);
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    box.lo[axis] = rounded_down(centre[axis] - radius);
    box.hi[axis] = rounded_up(centre[axis] + radius);
  }
  return box;
}

/// The box of that part of a ball which lies in a cell, rounded outward; empty where the ball does not reach into the
/// cell. The radius is 2^-40 larger: more than rounding can take from the half chord below, and little enough to list
/// no ball in cells far from it.
inline Aabb clipped_box(const SphereSet& spheres, std::int64_t id, const Aabb& cell) {
  const Vec3d centre = spheres.stored_centre(id);
  const double radius = spheres.stored_radius(id) + 0x1p-40;
  // Square the distances between the centre and the cell along each axis.
  Vec3d beyond_squared;
  for (int axis = 0; axis < 3; ++axis) {
    const double beyond = std::max({double(cell.lo[axis]) - centre[axis], centre[axis] - double(cell.hi[axis]), 0.0});
    beyond_squared[axis] = beyond * beyond;
  }
  // Along each axis the ball reaches as far as half a chord at the nearest position across it.
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const double across_squared = beyond_squared[(axis + 1) % 3] + beyond_squared[(axis + 2) % 3];
    if (across_squared > radius * radius) return {};
    const double half_chord = std::sqrt(radius * radius - across_squared);
    box.lo[axis] = std::max(cell.lo[axis], rounded_down(centre[axis] - half_chord));
    box.hi[axis] = std::min(cell.hi[axis], rounded_up(centre[axis] + half_chord));
  }
  return box.empty() ? Aabb{} : box;
}

/// The part of a box on one side of a plane that crosses it.
inline Aabb part_below(Aabb cell, int axis, float plane) {
  cell.hi[axis] = plane;
  return cell;
}
inline Aabb part_above(Aabb cell, int axis, float plane) {
  cell.lo[axis] = plane;
  return cell;
}

/// 0 for an empty box.
inline double half_surface(const Aabb& box) {
  if (box.empty()) return 0;
  const Vec3d size = to_double(box.hi) - to_double(box.lo);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

/// An error of positions that no query from here exceeds, as docs/precision.md ("Padding") derives it for boxes that
/// are not smaller than their spheres: 52 units of 2^-53 are needed, 128 in use. `from`: in stored units.
inline double rounding_pad(Vec3d from) {
  return 0x1p-46 * (std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z)}) + 2.0);
}

/// A ray made ready for many boxes.
class RayAndBoxes {
 public:
  explicit RayAndBoxes(const ScaledRay& ray)
      : inverse_{1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z},
        segment_{ray.t_min, ray.t_max},
        pad_(rounding_pad(ray.origin)) {
    for (int axis = 0; axis < 3; ++axis) {
      plus_pad_[axis] = ray.origin[axis] + pad_;
      minus_pad_[axis] = ray.origin[axis] - pad_;
      backward_[static_cast<std::size_t>(axis)] = inverse_[axis] < 0;
    }
  }

  /// The ray's interval inside the padded box, as far as it is in the segment.
  Interval inside(const Aabb& box) const {
    Interval part = segment_;
    for (int axis = 0; axis < 3; ++axis) {
      const double below = (double(box.lo[axis]) - plus_pad_[axis]) * inverse_[axis];
      const double above = (double(box.hi[axis]) - minus_pad_[axis]) * inverse_[axis];
      const bool swap = backward_[static_cast<std::size_t>(axis)];
      // Along a plane the inverse is infinite: the products say on which side the ray is, or are NaN on the plane
      // itself. max() and min() return their first argument then.
      part.t_near = std::max(part.t_near, swap ? above : below);
      part.t_far = std::min(part.t_far, swap ? below : above);
    }
    // A ray along a slab that it misses has t_near = +inf or t_far = -inf.
    if (part.t_near == std::numeric_limits<double>::infinity()) part.t_far = 0;
    return part;
  }

  /// Where that interval begins; infinite where it is empty.
  double entry(const Aabb& box) const {
    const Interval part = inside(box);
    return part.empty() ? std::numeric_limits<double>::infinity() : part.t_near;
  }

  double inverse(int axis) const { return inverse_[axis]; }
  /// In stored units.
  double pad() const { return pad_; }

 private:
  Vec3d inverse_;
  Interval segment_;
  double pad_;
  Vec3d plus_pad_, minus_pad_;
  std::array<bool, 3> backward_{};
};

/// A lower bound of the distance between a point and the surface of any sphere inside the box. It is negative where the
/// point lies inside: no ball in the box reaches farther around the point than the nearest face.
inline double least_distance(Vec3d point, const Aabb& box, double pad) {
  double outside_squared = 0, deepest = -std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const double beyond = std::max(double(box.lo[axis]) - point[axis], point[axis] - double(box.hi[axis]));
    deepest = std::max(deepest, beyond);
    if (beyond > 0) outside_squared += beyond * beyond;
  }
  return (deepest > 0 ? std::sqrt(outside_squared) : deepest) - pad;
}

/// The same for structures that list a ball in every cell that it reaches into. A ball that contains the point is
/// listed in a cell that does so, too, which -inf makes the first one. Any other ball's nearest position is as far as
/// the nearest cell that lists it, or farther.
inline double least_distance_to_cell(Vec3d point, const Aabb& cell, double pad) {
  const double distance = least_distance(point, cell, pad);
  return distance > 0 ? distance : -std::numeric_limits<double>::infinity();
}

}  // namespace bihive::workbench
