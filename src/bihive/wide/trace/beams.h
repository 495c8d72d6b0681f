// Beams: blocks of 64 neighbouring rays traverse the wide tree together, on the active target.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/wide/optical_depths.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/remaining_rays.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::wide {

/// Rays of a block.
constexpr int kBeamRays = 64;

/// Whether beams take these rays at all.
bool beams_take(const WideTree& tree, const RaySpan& rays);

/// Answer the rays except those that they return, which do not suit beams. Any rays that beams take are valid; only
/// blocks of 64 (counted from the first ray) that are close in origin and direction are fast.
RemainingRays closest_hits_by_beams(const WideTree& tree, const RaySpan& rays, const HitSpan& hits);
RemainingRays occluded_by_beams(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden);

/// Appends every hit of the rays that it does not return, in no order.
RemainingRays all_hits_by_beams(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& found);

/// Adds the depths of all hits of the rays that it does not return to their sums. sorted: it returns only rays that
/// binary32 cannot hold, and answers others singly where they make no beam.
RemainingRays depths_by_beams(const WideTree& tree, const RaySpan& rays, bool sorted, const SphereDepths& depths,
                              const DepthSums& sums);

/// Blocks of a span: those whose number is a multiple of `step`, or all others.
struct BlockChoice {
  std::int64_t step = 1;
  bool others = false;
};

struct SortedBeams {
  RemainingRays remaining;
  std::int64_t spheres_met = 0;  ///< by beams, each times the rays of the beam
};

/// Answers the chosen blocks of rays that are in the order of wide/schedule/light_order.h.
SortedBeams occluded_by_sorted_beams(const WideTree& tree, const RaySpan& rays, const BlockChoice& blocks,
                                     std::uint8_t* hidden);

}  // namespace bihive::wide
