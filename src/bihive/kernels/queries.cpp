#include "bihive/kernels/queries.h"

#include "bihive/kernels/lists.h"
#include "bihive/kernels/single.h"

namespace bihive {

Hit closest_hit(const WideTree& tree, const Ray& ray) {
  return kernels::closest_hit_single(tree, ray);
}

bool occluded(const WideTree& tree, const Ray& ray) {
  return kernels::occluded_single(tree, ray);
}

void closest_hits(const WideTree& tree, const RaySpan& rays, RayOrder /*order*/, const HitSpan& hits) {
  kernels::closest_hits_lists(tree, rays, hits);
}

void occluded(const WideTree& tree, const RaySpan& rays, RayOrder /*order*/, std::uint8_t* hidden) {
  kernels::occluded_lists(tree, rays, hidden);
}

}  // namespace bihive
