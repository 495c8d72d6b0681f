#include "bihive/wide/trace/single_ray.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/wide/trace/single_ray.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/simd/dispatch.h"
#include "bihive/wide/trace/ray_walk-inl.h"
#include "bihive/wide/trace/scalar_walk.h"
#include "bihive/wide/tree/left_sphere.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

template <bool kAnyHit>
HWY_INLINE Hit answer_ray(const WideTree& tree, const Ray& world) {
  if (!is_valid(world) || tree.node_count == 0) return {};
  ScaledRay scaled(world, tree.scale);
  const LeftSphere left(tree, world.leaves);
  const double farthest = std::max({std::abs(scaled.origin.x), std::abs(scaled.origin.y), std::abs(scaled.origin.z)});
  if (HWY_UNLIKELY(farthest > kFarthestOrigin)) return walk_scalar<kAnyHit>(tree, scaled, left);
  RayWalk walk;  // NOLINT: written before read
  SingleRay& ray = walk.ray;
  double length = 0;
  double shift = 0;
  if (!set_up_single_ray(world, tree, ray, length, shift)) return {};
  if (world.leaves >= 0 && world.leaves < std::int64_t{kNoSphere}) {
    ray.left_id = static_cast<std::uint32_t>(world.leaves);
    ray.inward = world.inside;
    ray.careful = left.is_repeated();
    if (ray.careful) {
      ray.left_centre[0] = tree.spheres.x[left.repeated()->slot];
      ray.left_centre[1] = tree.spheres.y[left.repeated()->slot];
      ray.left_centre[2] = tree.spheres.z[left.repeated()->slot];
    }
  }

  // Decide what binary32 cannot at once, and the winner at the end.
  Hit best;
  const auto decide = [&](std::uint32_t slot) {
    const Vec3d centre = tree.centre(slot);
    const double radius = tree.spheres.radius(slot);
    scaled.left_centre = centre;
    scaled.left_radius = left.is(tree, slot) ? radius : -1;
    best.keep_nearer(sphere_hit(scaled, centre, radius), tree.spheres.id(slot));
    if (!best.found()) return false;
    if (kAnyHit) return true;
    ray.s_best = std::min(ray.s_best, upper_distance(best.t, length, shift));
    return false;
  };
  walk.begin(0);
  while (walk.step<kAnyHit>(tree, decide)) {
  }
  if (ray.winner != kNoSlot) {
    if (kAnyHit) return {0, tree.spheres.id(ray.winner)};
    decide(ray.winner);
  }
  return best;
}

Hit closest_hit_on_target(const WideTree& tree, const Ray& ray) {
  return answer_ray<false>(tree, ray);
}

bool occluded_on_target(const WideTree& tree, const Ray& ray) {
  return answer_ray<true>(tree, ray).found();
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(closest_hit_on_target);
HWY_EXPORT(occluded_on_target);

namespace wide {

Hit closest_hit_of_ray(const WideTree& tree, const Ray& ray) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(closest_hit_on_target)(tree, ray);
}

bool ray_occluded(const WideTree& tree, const Ray& ray) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(occluded_on_target)(tree, ray);
}

}  // namespace wide
}  // namespace bihive
#endif
