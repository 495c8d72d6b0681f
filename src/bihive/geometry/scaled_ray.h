// A ray as a query uses it: in binary64, in the stored units of one sphere set.
#pragma once

#include <cstdint>

#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// Stored units are world units times a power of two. The scaling is exact and multiplies origin and direction alike,
/// so t is unchanged. The ray keeps centre and radius of the sphere that it exits, not the id: spheres that coincide
/// share one surface, and a ray that starts on it exits all of them.
struct ScaledRay {
  Vec3d origin;
  Vec3d direction;
  double direction_squared;  ///< direction . direction
  double t_min, t_max;
  bool inside;
  Vec3d left_centre;        ///< of the sphere that the ray exits
  double left_radius = -1;  ///< -1: it exits none

  /// A valid ray that exits no sphere, or for which that sphere does not matter.
  ScaledRay(const Ray& ray, double scale)
      : origin(to_double(ray.origin) * scale),
        direction(to_double(ray.direction) * scale),
        direction_squared(dot(direction, direction)),
        t_min(ray.t_min),
        t_max(ray.t_max),
        inside(ray.inside) {}

  /// A valid ray against `spheres`. An id outside the set counts as kNothing.
  ScaledRay(const Ray& ray, const SphereSet& spheres) : ScaledRay(ray, spheres.scale()) {
    if (ray.leaves < 0 || ray.leaves >= spheres.total_size()) return;
    left_centre = spheres.stored_centre(ray.leaves);
    left_radius = spheres.stored_radius(ray.leaves);
  }

  bool leaves(Vec3d centre, double radius) const { return radius == left_radius && centre == left_centre; }
};

}  // namespace bihive
