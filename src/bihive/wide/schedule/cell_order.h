// Rays that have nothing in common with their neighbours, as random ones have not. In a large tree each reads parts of
// it that no other ray near it in memory reads. Sorted by where they start and which way they go, those that read the
// same follow each other.
#pragma once

#include <cstdint>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::kernels {

/// Are there so many rays, most of them far from the next, and is the tree so large, that sorting pays?
bool scattered(const WideTree& tree, const RaySpan& rays);

/// Sorted at a time. More is faster: it takes some 60 bytes a ray, which the thread keeps.
constexpr std::int64_t kScatteredAtATime = 1 << 20;

/// closest_hits() of any rays by lists, sorted. at_a_time: 1 to kScatteredAtATime.
void closest_hits_scattered(const WideTree& tree, const RaySpan& rays, const HitSpan& hits,
                            std::int64_t at_a_time = kScatteredAtATime);

/// occluded() of any rays likewise.
void occluded_scattered(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden,
                        std::int64_t at_a_time = kScatteredAtATime);

}  // namespace bihive::kernels
