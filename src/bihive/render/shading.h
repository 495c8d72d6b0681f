// Whitted's shading of one surface point [Whitted1980]: its own light, and its secondary rays.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/geometry/ray.h"
#include "bihive/render/surface.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// The share of its surroundings that a place sees, 0 to 1: the mean over the directions in front of the surface,
/// weighted by their cosine, of 1 where no sphere and no plane is within `distance`, else 0. Adds the traced rays to
/// the count.
double ambient_visibility(const Scene& scene, const Tracer& tracer, const Surface& surface,
                          const std::vector<Vec3f>& directions, double distance, std::int64_t& ambient_rays);

/// colour x (ambient x visibility + sum of diffuse x light x N.L) + sum of specular x light x (R.V)^power. The sums go
/// over the lights in scene order that are in front of the surface and, with `shadows`, not hidden by a sphere. Adds
/// the traced shadow rays to the count.
Vec3d local_light(const Scene& scene, const Tracer& tracer, const Surface& surface, bool shadows, double visibility,
                  std::int64_t& shadow_rays);

/// The mirrored ray.
Ray reflected_ray(const Surface& surface);

/// The refracted ray. With total internal reflection it takes the mirrored direction; at a plane, which is thin, it
/// goes straight on.
Ray transmitted_ray(const Surface& surface);

}  // namespace bihive
