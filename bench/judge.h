// Whose answer is right where ours and a peer's differ: the scalar truth decides (geometry/sphere.h).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"
#include "ray_sets.h"

namespace bihive::bench {

/// Our answers to a ray set: hits, or hidden (any hit).
struct Answers {
  HitBatch hits;
  std::vector<std::uint8_t> hidden;
};

struct Verdict {
  std::int64_t compared = 0;    ///< rays
  std::int64_t differ = 0;      ///< rays that were answered differently
  std::int64_t ours_wrong = 0;  ///< a nearer sphere, or any, was missed, or the distance has another bit
  std::int64_t peer_wrong = 0;
};

/// Our hits alone: does each one's distance have the bits of the truth for the sphere that it names?
Verdict judge_alone(const SphereSet& spheres, const RaySet& set, const Answers& ours);

/// `peer` as EmbreeRays::answers() gives it. `name_peers_hit`: the sphere that the peer names for one ray.
Verdict judge(const SphereSet& spheres, const WideTree& tree, const RaySet& set, const Answers& ours,
              const std::vector<std::int64_t>& peer, const std::function<std::int64_t(const Ray&)>& name_peers_hit);

}  // namespace bihive::bench
