#include "judge.h"

#include <cmath>
#include <limits>

#include "bihive/geometry/sphere.h"
#include "bihive/wide/queries.h"

namespace bihive::bench {
namespace {

// The true t of one ray and one sphere: +inf if it is not hit, or if there is no such sphere.
double true_t(const SphereSet& spheres, const Ray& ray, std::int64_t id) {
  if (id < 0 || !is_valid(ray)) return std::numeric_limits<double>::infinity();
  return sphere_hit(ScaledRay(ray, spheres), spheres.stored_centre(id), spheres.stored_radius(id));
}

}  // namespace

Verdict judge_alone(const SphereSet& spheres, const RaySet& set, const Answers& ours) {
  Verdict verdict;
  if (set.facts.any_hit) return verdict;
  const RaySpan rays = set.rays.span();
  verdict.compared = rays.count;
  for (std::int64_t i = 0; i < rays.count; ++i) {
    const Hit hit = ours.hits.at(i);
    if (!(hit.t == true_t(spheres, rays.at(i), hit.sphere_id))) ++verdict.ours_wrong;
  }
  return verdict;
}

Verdict judge(const SphereSet& spheres, const WideTree& tree, const RaySet& set, const Answers& ours,
              const std::vector<std::int64_t>& peer, const std::function<std::int64_t(const Ray&)>& name_peers_hit) {
  Verdict verdict = judge_alone(spheres, set, ours);
  const RaySpan rays = set.rays.span();
  verdict.compared = rays.count;
  for (std::int64_t i = 0; i < rays.count; ++i) {
    const Ray ray = rays.at(i);
    const std::int64_t theirs = peer[static_cast<std::size_t>(i)];
    if (set.facts.any_hit) {
      // An answer "occluded" must name a sphere that the ray meets.
      const bool hidden = ours.hidden[static_cast<std::size_t>(i)] != 0;
      if (hidden == (theirs != 0)) continue;
      ++verdict.differ;
      const std::int64_t named = hidden ? closest_hit(tree, ray).sphere_id : name_peers_hit(ray);
      const bool is_hit = std::isfinite(true_t(spheres, ray, named));
      ++(is_hit == hidden ? verdict.peer_wrong : verdict.ours_wrong);
      continue;
    }
    // The nearer of both spheres is right; of equal distance the smaller id.
    const Hit hit = ours.hits.at(i);
    if (hit.sphere_id == theirs) continue;
    ++verdict.differ;
    const double their_t = true_t(spheres, ray, theirs);
    const bool nearer = their_t < hit.t || (their_t == hit.t && theirs >= 0 && theirs < hit.sphere_id);
    ++(nearer ? verdict.ours_wrong : verdict.peer_wrong);
  }
  return verdict;
}

}  // namespace bihive::bench
