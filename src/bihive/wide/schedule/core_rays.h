// Which rays may meet spheres that the outer tree leaves out (WideTree::outer)?
#pragma once

#include <cstdint>

#include "bihive/geometry/ray.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/remaining_rays.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::wide {

/// False: no sphere that the outer tree leaves out is hit at or before t_end. True: one may be. A ray that starts
/// outside of the enclosing spheres ends on their surfaces, above the cores. An invalid ray gives false.
bool may_reach_core(const WideTree& tree, const Ray& ray, double t_end);

/// The rays for which that is true: up to ends[i], or if that is null up to their own ends. Rays with skipped[i] 1 are
/// left out; `skipped` may be null.
RemainingRays rays_to_cores(const WideTree& tree, const RaySpan& rays, const double* ends, const std::uint8_t* skipped);

}  // namespace bihive::wide
