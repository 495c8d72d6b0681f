// A ray: a half-line, the segment of it that counts, and the surface on which it starts.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "bihive/math/vec3.h"

namespace bihive {

/// Ids that are not a sphere's position in its set.
constexpr std::int64_t kNothing = -1;
constexpr std::int64_t kPlane = -2;

/// Points origin + t direction with t_min <= t <= t_max, both inclusive.
///
/// `direction` may have any finite length above 0; t counts in lengths of it. Units are the sphere set's own (world)
/// units, and the origin counts from SphereSet::origin(), which is 0 for most sets. `leaves` names the surface on which
/// the ray starts: kNothing, kPlane or a sphere's id. Spheres are convex. So a ray that leaves sphere k outward
/// (`inside` false) never meets k again, and a ray that goes into it (`inside` true) meets it at the far root alone.
/// This rule replaces every epsilon: there is no offset and nothing to tune.
struct Ray {
  Vec3f origin;
  Vec3f direction;
  double t_min = 0;
  double t_max = std::numeric_limits<double>::infinity();
  std::int64_t leaves = kNothing;
  bool inside = false;
};

/// False for an invalid ray, which hits nothing: NaN anywhere, an infinite origin or direction, a zero direction, or
/// t_min > t_max.
inline bool is_valid(const Ray& ray) {
  const bool nonzero = ray.direction.x != 0 || ray.direction.y != 0 || ray.direction.z != 0;
  return is_finite(ray.origin) && is_finite(ray.direction) && nonzero && ray.t_min <= ray.t_max;
}

}  // namespace bihive
