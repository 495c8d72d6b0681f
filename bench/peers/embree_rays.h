// Rays in the layouts of Embree's calls for 1, 4, 8 and 16 rays.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/geometry/ray.h"
#include "peers/embree.h"

namespace bihive::bench {

/// `rays` in the order in which they are packed. Ray k is number order[k] of the set; the answers have the order of the
/// set.
std::unique_ptr<EmbreeRays> make_embree_rays(const std::vector<Ray>& rays, const std::vector<std::uint32_t>& order,
                                             bool any_hit, int width);

}  // namespace bihive::bench
