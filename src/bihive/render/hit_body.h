// The body that a ray of Tracer hit: a sphere or a stick, and where on it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/geometry/stick_set.h"

namespace bihive {

enum class BodyKind : std::uint8_t { nothing, sphere, stick, plane };

struct HitBody {
  BodyKind kind = BodyKind::nothing;
  std::int64_t id = kNothing;  ///< of the sphere; of a stick its number in the set, copies counted; else kNothing
  double along = 0;  ///< of a stick: the position of the hit along its axis, 0 at its first end, 1 at its second
};

/// `hit`: of this ray, local (geometry/sphere_set.h), as Tracer::closest_hit() gave it for these spheres and sticks. On
/// the side of a stick, `along` is that of the ball whose surface is hit; on the cap of a cut one, that of the point.
inline HitBody body_of_hit(const SphereSet& spheres, const StickSet& sticks, const Ray& ray, const Hit& hit) {
  if (hit.sphere_id == kPlane) return {BodyKind::plane, kNothing, 0};
  if (!hit.found()) return {};
  const std::int64_t half = hit.sphere_id - spheres.total_size();
  if (half < 0) return {BodyKind::sphere, hit.sphere_id, 0};
  const Stick stick = sticks.stored(spheres, half / 2);
  const ScaledRay scaled(ray, spheres.scale());
  const StickRoots roots = stick_roots(scaled, stick);
  if (hit.t == roots.t_near) return {BodyKind::stick, half / 2, roots.s_near};
  if (hit.t == roots.t_far) return {BodyKind::stick, half / 2, roots.s_far};
  const Vec3d axis = stick.b - stick.a, point = scaled.origin + hit.t * scaled.direction;
  return {BodyKind::stick, half / 2, std::clamp(dot(point - stick.a, axis) / dot(axis, axis), 0.0, 1.0)};
}

}  // namespace bihive
