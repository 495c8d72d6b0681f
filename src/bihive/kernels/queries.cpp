#include "bihive/kernels/queries.h"

#include "bihive/kernels/single.h"

namespace bihive {

Hit closest_hit(const WideTree& tree, const Ray& ray) {
  return kernels::closest_hit_single(tree, ray);
}

bool occluded(const WideTree& tree, const Ray& ray) {
  return kernels::occluded_single(tree, ray);
}

void closest_hits(const WideTree& tree, const RaySpan& rays, RayOrder /*order*/, const HitSpan& hits) {
  for (std::int64_t i = 0; i < rays.count; ++i) {
    const Hit hit = closest_hit(tree, rays.at(i));
    hits.t[i] = hit.t;
    hits.sphere_id[i] = hit.sphere_id;
  }
}

void occluded(const WideTree& tree, const RaySpan& rays, RayOrder /*order*/, std::uint8_t* hidden) {
  for (std::int64_t i = 0; i < rays.count; ++i) hidden[i] = occluded(tree, rays.at(i)) ? 1 : 0;
}

}  // namespace bihive
