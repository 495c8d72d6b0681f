// An infinite plane, tested analytically beside the tree and never part of it.
#pragma once

#include <limits>

#include "bihive/geometry/ray.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// All points p with normal . (p - point) = 0, in world units. `normal` has length 1. Seen from both sides.
struct Plane {
  Vec3d point;
  Vec3d normal{0, 1, 0};
};

/// The t at which a valid ray hits the plane, +inf if it is parallel, hits outside its segment, or leaves the plane.
inline double plane_hit(const Ray& ray, const Plane& plane) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  if (ray.leaves == kPlane) return inf;
  const double speed = dot(plane.normal, to_double(ray.direction));
  if (speed == 0) return inf;
  const double t = dot(plane.normal, plane.point - to_double(ray.origin)) / speed;
  return t >= ray.t_min && t <= ray.t_max ? t : inf;
}

}  // namespace bihive
