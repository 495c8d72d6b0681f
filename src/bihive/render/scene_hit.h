// The closest hit of a ray in a scene: on a sphere or on the plane.
#pragma once

#include <cstdint>
#include <limits>

#include "bihive/geometry/plane.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// `id` is a sphere's id, kPlane or kNothing.
struct SceneHit {
  double t = std::numeric_limits<double>::infinity();
  std::int64_t id = kNothing;

  bool found() const { return id != kNothing; }
};

/// Given the closest hit on a sphere. If the ray meets a sphere and the plane at the same t, it hits the sphere.
inline SceneHit scene_hit(const Scene& scene, const Hit& sphere, const Ray& ray) {
  SceneHit hit{sphere.t, sphere.sphere_id};
  if (scene.plane && is_valid(ray)) {
    const double t = plane_hit(ray, local_plane(scene));
    if (t < hit.t) hit = {t, kPlane};
  }
  return hit;
}

inline SceneHit scene_hit(const Scene& scene, const Tracer& tracer, const Ray& ray) {
  return scene_hit(scene, tracer.closest_hit(ray), ray);
}

}  // namespace bihive
