#include "bihive/wide/queries.h"

#include "bihive/wide/schedule/any_rays.h"
#include "bihive/wide/trace/beams.h"
#include "bihive/wide/trace/single_ray.h"

namespace bihive {

Hit closest_hit(const WideTree& tree, const Ray& ray) {
  return kernels::closest_hit_single(tree, ray);
}

bool occluded(const WideTree& tree, const Ray& ray) {
  return kernels::occluded_single(tree, ray);
}

void closest_hits(const WideTree& tree, const RaySpan& rays, RayOrder order, const HitSpan& hits) {
  if (order == RayOrder::blocks) {
    kernels::closest_hits_beams(tree, rays, hits);
  } else {
    kernels::closest_hits_any(tree, rays, hits);
  }
}

void occluded(const WideTree& tree, const RaySpan& rays, RayOrder order, std::uint8_t* hidden) {
  if (order == RayOrder::blocks) {
    kernels::occluded_beams(tree, rays, hidden);
  } else {
    kernels::occluded_any(tree, rays, hidden);
  }
}

}  // namespace bihive
