// Where a ray met a sphere, in full: position, normal, exit, and how they change with the sphere.
#pragma once

#include <optional>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// All in the units of the ray and the sphere that it was made of, binary64.
struct HitSurface {
  Vec3d position;  ///< on the sphere: centre + radius normal
  Vec3d normal;    ///< outward, length 1
  double t_exit;   ///< where the line leaves the sphere; t itself for a hit from inside
};

/// Of a hit at `t`, which a query gave for this ray and sphere. Nothing: `t` is not a root of them, bit for bit, so the
/// ray or the sphere is another one.
inline std::optional<HitSurface> hit_surface(const ScaledRay& ray, double t, Vec3d centre, double radius) {
  const SphereRoots roots = sphere_roots(ray, centre, radius);
  if (!(t == roots.t_near || t == roots.t_far)) return std::nullopt;
  const Vec3d normal = normalized(t * ray.direction - (centre - ray.origin));
  return HitSurface{centre + radius * normal, normal, roots.t_far};
}

/// How a hit changes with the centre c and the radius r of its sphere, the ray being fixed. With the normal n and the
/// direction d, the surface |o + t d - c| = r gives dt = (n . dc + dr) / (n . d), and n = (o + t d - c) / r the rest.
/// At a silhouette n . d is 0, and the derivatives are infinite or NaN.
struct HitDerivatives {
  Vec3d t_by_centre;
  double t_by_radius;
  Vec3d normal_by_centre[3];  ///< row i: component i of the normal
  Vec3d normal_by_radius;
};

/// `direction` and `radius` in one unit, that of the answer; `normal`: of the hit.
inline HitDerivatives hit_derivatives(Vec3d direction, Vec3d normal, double radius) {
  const double towards = dot(normal, direction);
  HitDerivatives made{normal / towards, 1 / towards, {}, (direction / towards - normal) / radius};
  for (int i = 0; i < 3; ++i) {
    Vec3d row = direction[i] * made.t_by_centre;
    row[i] -= 1;
    made.normal_by_centre[i] = row / radius;
  }
  return made;
}

}  // namespace bihive
