// Rays that lead to one point, as shadow rays to a light do. Whichever surfaces they leave, those that are neighbours
// seen from that point stay close together on their whole way: sorted so, they make narrow beams.
#pragma once

#include <cstdint>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::kernels {

/// Do all rays lead to one point at t = 1, nearly? False for few rays, with which sorting does not pay.
bool converge(const RaySpan& rays);

/// occluded() of rays that converge: sorted, and as beams. False if for some of them lists were chosen.
bool occluded_converging(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden);

}  // namespace bihive::kernels
