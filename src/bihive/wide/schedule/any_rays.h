// Rays in any order: a look at them tells which way is made for them. The look changes the speed, never an answer.
#pragma once

#include <cstdint>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::kernels {

/// Sorted if they are scattered (wide/schedule/cell_order.h), else lists.
void closest_hits_any(const WideTree& tree, const RaySpan& rays, const HitSpan& hits);

/// As beams if they lead to one point (wide/schedule/light_order.h); sorted if they are scattered; else lists.
void occluded_any(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden);

}  // namespace bihive::kernels
