// The place where a ray hit something, as shading needs it. World units, binary64.
#pragma once

#include <cstdint>

#include "bihive/geometry/ray.h"
#include "bihive/math/vec3.h"
#include "bihive/render/scene_hit.h"
#include "bihive/scene/scene.h"

namespace bihive {

class CutSet;

struct Surface {
  std::int64_t id;    ///< sphere, half a stick or kPlane
  Vec3f origin;       ///< the hit point, rounded to binary32: where the next rays start
  Vec3d incoming;     ///< the ray's direction, length 1
  Vec3d normal;       ///< length 1, turned against the ray
  bool from_inside;   ///< the ray comes from inside the sphere: direction . outward normal > 0
  Material material;  ///< with the checker's colour if there is a checker
};

/// A ray that starts on the surface. `inside`: whether it goes into the sphere or stick; a plane has no inside.
inline Ray ray_from(const Surface& surface, Vec3d direction, bool inside) {
  Ray ray;
  ray.origin = surface.origin;
  ray.direction = to_float(direction);
  ray.leaves = surface.id;
  ray.inside = surface.id != kPlane && inside;
  return ray;
}

/// `hit` must be a hit, not a miss. `cuts`: of the scene (scene/clips.h); null: all spheres are whole.
Surface surface_at(const Scene& scene, const Ray& ray, const SceneHit& hit, const CutSet* cuts);
/// The outward normal, of length 1, at a hit of half a stick.
Vec3d stick_normal(const Scene& scene, const Ray& ray, const SceneHit& hit);
/// The same for a scene whose cuts are not at hand: it makes them for each call if the scene has clips.
Surface surface_at(const Scene& scene, const Ray& ray, const SceneHit& hit);

}  // namespace bihive
