// One ray at a time, on the active target.
#pragma once

#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::wide {

Hit closest_hit_of_ray(const WideTree& tree, const Ray& ray);
bool ray_occluded(const WideTree& tree, const Ray& ray);

}  // namespace bihive::wide
