// Beams: blocks of 64 neighbouring rays against the wide tree on the active target; public callers use
// wide/queries.h.
#pragma once

#include <cstdint>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::kernels {

/// Could beams take these rays at all? If not, lists answer.
bool beams_take(const WideTree& tree, const RaySpan& rays);

/// Any rays may come; only blocks (counted from the first ray) that are close in origin and direction are fast.
void closest_hits_beams(const WideTree& tree, const RaySpan& rays, const HitSpan& hits);
void occluded_beams(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden);
/// Of rays in the order of wide/schedule/light_order.h. False: nothing is answered, since they are not for beams, or,
/// if asked to `judge`, since some of them have shown that ray lists are faster.
bool occluded_sorted_beams(const WideTree& tree, const RaySpan& rays, bool judge, std::uint8_t* hidden);

}  // namespace bihive::kernels
