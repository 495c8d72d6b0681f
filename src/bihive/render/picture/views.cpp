#include "bihive/render/views.h"

#include <algorithm>

#include "bihive/bih/observer.h"
#include "bihive/bih/traversal.h"
#include "bihive/math/rng.h"
#include "bihive/render/surface.h"

namespace bihive {

Vec3d recursion_colour(int deepest_hit) {
  constexpr Vec3d kColours[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 0}, {1, 0, 1}, {1, 1, 1}};
  return kColours[std::clamp(deepest_hit, 0, 6)];
}

Vec3d traversal_colour(const Tracer& tracer, const Ray& ray) {
  constexpr double kStep = 0.2;
  if (!is_valid(ray)) return {};
  CountingObserver observer;
  traverse<false>(*tracer.tree(), tracer.spheres(), ScaledRay(ray, tracer.spheres()), observer);
  const auto steps = [](std::int64_t count) { return std::min(1.0, kStep * static_cast<double>(count)); };
  return {0, steps(observer.empty_gaps), steps(observer.node_visits + observer.leaf_visits)};
}

Vec3d normal_colour(const Scene& scene, const Ray& ray, const SceneHit& hit, const CutSet* cuts) {
  if (!hit.found()) return {};
  const Vec3d normal = surface_at(scene, ray, hit, cuts).normal;
  return 0.5 * (normal + Vec3d{1, 1, 1});
}

Vec3d id_colour(std::int64_t id) {
  if (id == kNothing) return {};
  const std::uint64_t hash = SplitMix64(static_cast<std::uint64_t>(id)).next();
  const auto channel = [hash](int shift) { return (64 + static_cast<double>(hash >> shift & 0xFF) * 0.75) / 256; };
  return {channel(0), channel(8), channel(16)};
}

double distance_of(const Ray& ray, const SceneHit& hit) {
  return hit.t * length(to_double(ray.direction));
}

Vec3d distance_colour(const Ray& ray, const SceneHit& hit, const DistanceRange& range) {
  if (!hit.found()) return {};
  const double depth = range.farthest - range.nearest;
  const double share = depth > 0 ? (range.farthest - distance_of(ray, hit)) / depth : 1;
  return {share, share, share};
}

}  // namespace bihive
