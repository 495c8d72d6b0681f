// The scalar truth of the intersection of a ray and a sphere: one fixed sequence of binary64 operations.
//
// Every engine must give exactly these roots. The file is compiled without fused multiply-add (-ffp-contract=off). The
// perpendicular form is used because it stays accurate for small spheres far away; docs/precision.md derives its error.
#pragma once

#include <cmath>
#include <limits>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// The two parameters at which the whole line meets a sphere, t_near <= t_far; NaN in both if the line misses it.
struct SphereRoots {
  double t_near, t_far;
};

/// `centre` and `radius` in the ray's (stored) units. A sphere of radius 0 is never hit. A tangent line has two equal
/// roots.
inline SphereRoots sphere_roots(const ScaledRay& ray, Vec3d centre, double radius) {
  // Find the point of the line that is closest to the centre, and the vector from it to the centre.
  const Vec3d oc = centre - ray.origin;
  const double t_closest = dot(oc, ray.direction) / ray.direction_squared;
  const Vec3d perpendicular = oc - t_closest * ray.direction;

  // Pythagoras gives half of the chord.
  const double discriminant = radius * radius - dot(perpendicular, perpendicular);
  if (!(discriminant >= 0) || !(radius > 0)) {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    return {nan, nan};
  }
  const double half_chord = std::sqrt(discriminant / ray.direction_squared);
  return {t_closest - half_chord, t_closest + half_chord};
}

/// The t at which the ray hits the sphere: the nearer root if it lies in the segment, else the farther one, else +inf.
/// For the sphere that the ray leaves: no root if the ray goes outward, the farther root only if it goes inside.
inline double sphere_hit(const ScaledRay& ray, Vec3d centre, double radius) {
  const bool own = ray.leaves(centre, radius);
  constexpr double inf = std::numeric_limits<double>::infinity();
  if (own && !ray.inside) return inf;
  const SphereRoots roots = sphere_roots(ray, centre, radius);
  if (!own && roots.t_near >= ray.t_min && roots.t_near <= ray.t_max) return roots.t_near;
  if (roots.t_far >= ray.t_min && roots.t_far <= ray.t_max) return roots.t_far;
  return inf;
}

}  // namespace bihive
