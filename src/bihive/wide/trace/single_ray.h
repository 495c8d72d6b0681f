// One ray at a time on the active target; public callers use wide/queries.h.
#pragma once

#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::kernels {

Hit closest_hit_single(const WideTree& tree, const Ray& ray);
bool occluded_single(const WideTree& tree, const Ray& ray);

}  // namespace bihive::kernels
