// An infinite plane, tested analytically beside the tree and never part of it.
#pragma once

#include <cmath>
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

/// Two directions that span a plane, from its normal. For the thesis's ground they are +x and +z.
struct PlaneAxes {
  Vec3d u, v;
};

inline PlaneAxes plane_axes(Vec3d normal) {
  // Start from the world axis closest to the plane; of equal ones the first.
  int flattest = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(normal[axis]) < std::abs(normal[flattest])) flattest = axis;
  Vec3d start;
  start[flattest] = 1;
  const Vec3d u = normalized(start - dot(start, normal) * normal);
  return {u, cross(u, normal)};
}

}  // namespace bihive
