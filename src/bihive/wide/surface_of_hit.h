// The surface at a hit of a query, in world units.
#pragma once

#include <cstdint>
#include <optional>

#include "bihive/geometry/hit.h"
#include "bihive/geometry/hit_surface.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/periodic_images.h"

namespace bihive {

/// Of the hit at `t` on sphere `id`, or on one of its images, that a query of this ray gave. `spheres`: the set of the
/// tree. `images`: null, or those that the query knew. Nothing: the hit is not that of the ray, or there is no such
/// sphere.
inline std::optional<HitSurface> surface_of_hit(const SphereSet& spheres, const PeriodicImages* images, const Ray& ray,
                                                double t, std::int64_t id) {
  if (id < 0 || id >= spheres.total_size()) return std::nullopt;
  const ScaledRay scaled(ray, spheres.scale());
  std::optional<Vec3d> centre = spheres.stored_centre(id);
  if (images != nullptr) centre = images->image_of_hit(scaled, t, id);
  if (!centre) return std::nullopt;
  std::optional<HitSurface> surface = hit_surface(scaled, t, *centre, spheres.stored_radius(id));
  if (surface) surface->position = spheres.in_world(surface->position * spheres.inverse_scale());
  return surface;
}

/// Of a hit on a sphere of the set itself. Nothing where the ray hit nothing.
inline std::optional<HitSurface> surface_of_hit(const SphereSet& spheres, const Ray& ray, const Hit& hit) {
  return surface_of_hit(spheres, nullptr, ray, hit.t, hit.sphere_id);
}

}  // namespace bihive
