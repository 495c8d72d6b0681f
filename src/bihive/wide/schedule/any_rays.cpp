#include "bihive/wide/schedule/any_rays.h"

#include "bihive/wide/schedule/cell_order.h"
#include "bihive/wide/schedule/light_order.h"
#include "bihive/wide/trace/lists.h"

namespace bihive::kernels {

void closest_hits_any(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  if (scattered(tree, rays)) {
    closest_hits_scattered(tree, rays, hits);
  } else {
    closest_hits_lists(tree, rays, hits);
  }
}

void occluded_any(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  if (converge(rays)) {
    occluded_converging(tree, rays, hidden);
  } else if (scattered(tree, rays)) {
    occluded_scattered(tree, rays, hidden);
  } else {
    occluded_lists(tree, rays, hidden);
  }
}

}  // namespace bihive::kernels
