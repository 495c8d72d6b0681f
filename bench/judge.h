// Decides which answer is right if ours and a peer's differ: by the scalar truth (geometry/sphere.h).
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"
#include "ray_sets.h"

namespace bihive::bench {

/// Our answers to a ray set: hits, or occlusion (any hit).
struct Answers {
  HitBatch hits;
  std::vector<std::uint8_t> hidden;
};

struct Verdict {
  std::int64_t compared = 0;    ///< rays
  std::int64_t differ = 0;      ///< rays with different answers
  std::int64_t ours_wrong = 0;  ///< a nearer sphere (or any sphere) was missed, or a bit of the distance is wrong
  std::int64_t peer_wrong = 0;
};

/// Our hits alone: does each distance have the bits of the truth for the named sphere?
Verdict judge_alone(const SphereSet& spheres, const RaySet& set, const Answers& ours);

/// `peer` as EmbreeRays::answers() returns it. `name_peers_hit`: the sphere that the peer names for one ray.
Verdict judge(const SphereSet& spheres, const WideTree& tree, const RaySet& set, const Answers& ours,
              const std::vector<std::int64_t>& peer, const std::function<std::int64_t(const Ray&)>& name_peers_hit);

}  // namespace bihive::bench
