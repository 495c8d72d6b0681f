#include "bihive/kernels/any_rays.h"

#include "bihive/kernels/converging_rays.h"
#include "bihive/kernels/lists.h"
#include "bihive/kernels/scattered_rays.h"

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
