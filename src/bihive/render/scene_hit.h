// The closest thing that a ray meets in a scene: a sphere or the plane.
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

/// Where a sphere and the plane are met at the same t, the sphere is hit.
inline SceneHit scene_hit(const Scene& scene, const Tracer& tracer, const Ray& ray) {
  const Hit sphere = tracer.closest_hit(ray);
  SceneHit hit{sphere.t, sphere.sphere_id};
  if (scene.plane && is_valid(ray)) {
    const double t = plane_hit(ray, scene.plane->plane);
    if (t < hit.t) hit = {t, kPlane};
  }
  return hit;
}

}  // namespace bihive
