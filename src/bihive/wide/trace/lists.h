// Ray lists: tiles of many rays traverse the wide tree together, on the active target. For any rays.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::wide {

void closest_hits_by_lists(const WideTree& tree, const RaySpan& rays, const HitSpan& hits);
void occluded_by_lists(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden);
/// Appends every hit of the rays, in no order.
void all_hits_by_lists(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& found);

}  // namespace bihive::wide
