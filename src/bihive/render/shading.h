// Whitted's shading of one surface point [Whitted1980]: its own light, and its secondary rays.
#pragma once

#include <cstdint>

#include "bihive/geometry/ray.h"
#include "bihive/render/surface.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// colour x (ambient + sum of diffuse x light x N.L) + sum of specular x light x (R.V)^power. The sums go over the
/// lights in scene order that are in front of the surface and, with `shadows`, not hidden by a sphere. Adds the traced
/// shadow rays to the count.
Vec3d local_light(const Scene& scene, const Tracer& tracer, const Surface& surface, bool shadows,
                  std::int64_t& shadow_rays);

/// The mirrored ray.
Ray reflected_ray(const Surface& surface);

/// The refracted ray. With total internal reflection it takes the mirrored direction; at a plane, which is thin, it
/// goes straight on.
Ray transmitted_ray(const Surface& surface);

}  // namespace bihive
