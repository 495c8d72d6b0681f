// Ray lists: many rays walk the wide tree together; public callers use wide/queries.h.
#pragma once

#include <cstdint>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::kernels {

void closest_hits_lists(const WideTree& tree, const RaySpan& rays, const HitSpan& hits);
void occluded_lists(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden);

}  // namespace bihive::kernels
