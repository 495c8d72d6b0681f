// Tests every sphere, one after the other. The speed of a tree is compared with it. No structure, no box test.
#pragma once

#include <cstdint>

#include "bihive/bih/observer.h"
#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// The same answer as traverse() in bih/traversal.h, bit for bit.
template <bool kAnyHit, class Observer>
Hit test_all_spheres(const SphereSet& spheres, const ScaledRay& ray, Observer& observer) {
  Hit best;
  for (std::int64_t id = 0; id < spheres.total_size(); ++id) {
    observer.sphere_test();
    best.keep_nearer(sphere_hit(ray, spheres.stored_centre(id), spheres.stored_radius(id)), id);
    if (kAnyHit && best.found()) return best;
  }
  return best;
}

inline Hit closest_hit(const SphereSet& spheres, const Ray& ray) {
  if (!is_valid(ray)) return {};
  NoObserver observer;
  return test_all_spheres<false>(spheres, ScaledRay(ray, spheres), observer);
}

inline bool occluded(const SphereSet& spheres, const Ray& ray) {
  if (!is_valid(ray)) return false;
  NoObserver observer;
  return test_all_spheres<true>(spheres, ScaledRay(ray, spheres), observer).found();
}

}  // namespace bihive
