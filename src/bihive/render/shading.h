// Whitted's shading of one surface point [Whitted1980]: its own light, and its secondary rays.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/geometry/ray.h"
#include "bihive/render/surface.h"
#include "bihive/render/transparency.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// The share of its surroundings that a place sees, 0 to 1: the mean over the directions in front of the surface,
/// weighted by their cosine, of what arrives along them from `distance` (LightPaths; nothing through the plane), for
/// each colour. Adds the traced rays to the count.
Vec3d ambient_visibility(const Scene& scene, const LightPaths& paths, const Surface& surface,
                         const std::vector<Vec3f>& directions, double distance, std::int64_t& ambient_rays);

/// How much of a light reaches a place.
struct LightShare {
  Vec3d facing;  ///< N.L; of a light with a radius: the mean over its points, each times what arrives from it
  Vec3d seen;    ///< mean over the light's points of what arrives from them, 0 from behind the surface
};

/// Of a light with a radius. `points`: of the ball of radius 1, at least one. Adds the traced shadow rays to the count.
LightShare soft_light_share(const PointLight& light, const LightPaths& paths, const Surface& surface,
                            const std::vector<Vec3d>& points, std::int64_t& shadow_rays);

/// colour x (glow + ambient x visibility x ambient light + sum of diffuse x light x N.L) + tint of sum of specular x
/// light x (R.V)^power. The sums go over the lights in scene order that are in front of the surface, with `shadows`
/// each times what arrives from it. Adds the traced shadow rays to the count. `light_points`: null if no light has a
/// radius or there are no shadows; else a light with a radius gives the mean of its points to the diffuse term, and its
/// share to its centre's highlight.
Vec3d local_light(const Scene& scene, const LightPaths& paths, const Surface& surface, bool shadows,
                  const std::vector<Vec3d>* light_points, Vec3d visibility, std::int64_t& shadow_rays);

/// What of direct and ambient light arrives at a place, for each colour, of what would if nothing hid it: diffuse terms
/// of the material, 1 where there are none. `seen`: LightShare::seen of each light, read if the light is in front of
/// the surface as a whole; others do not count. `lights`: local.
Vec3d unshadowed_share(const Scene& scene, const std::vector<PointLight>& lights, const Surface& surface,
                       const Vec3d* seen, Vec3d visibility);

/// The light of a plane with ScenePlane::shadows_only; arguments and shadow rays as of local_light().
Vec3d light_of_shadows_only(const Scene& scene, const LightPaths& paths, const Surface& surface, bool shadows,
                            const std::vector<Vec3d>* light_points, Vec3d visibility, std::int64_t& shadow_rays);

/// The mirrored ray.
Ray reflected_ray(const Surface& surface);

/// The refracted ray. With total internal reflection it takes the mirrored direction; at a plane, which is thin, it
/// goes straight on.
Ray transmitted_ray(const Surface& surface);

}  // namespace bihive
