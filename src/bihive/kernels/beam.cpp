#include "bihive/kernels/beam.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/kernels/beam.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>

#include "bihive/kernels/beam-inl.h"
#include "bihive/kernels/dispatch.h"
#include "bihive/kernels/leftover_rays.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

void closest_hits_beams_on_target(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  Rivals rivals(tree, rays, hits);
  LeftoverRays leftover(rays);
  BeamRays beam;
  Frustum frustum;
  for (std::int64_t first = 0; first < rays.count; first += kBeamRays) {
    const int count = static_cast<int>(std::min<std::int64_t>(kBeamRays, rays.count - first));
    if (!set_up_beam(tree, rays, first, count, beam)) {
      leftover.add(first, count);
      continue;
    }
    if (!make_frustum(tree, beam, frustum)) {
      write_misses(hits, first, count);
      continue;
    }
    const bool leaves = rays.leaves != nullptr;
    if (beam.common_origin && !leaves)
      closest_hits_in_beam<true, false>(tree, beam, frustum, rays, first, hits, rivals);
    else if (!leaves)
      closest_hits_in_beam<false, false>(tree, beam, frustum, rays, first, hits, rivals);
    else
      closest_hits_in_beam<false, true>(tree, beam, frustum, rays, first, hits, rivals);
  }
  rivals.flush();
  leftover.closest_hits(tree, hits);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(closest_hits_beams_on_target);

namespace kernels {

void closest_hits_beams(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  ensure_target();
  // Where spheres coincide, ids do not tell which ones a ray leaves.
  if (tree.node_count == 0 || (rays.leaves != nullptr && !tree.repeated.empty())) {
    LeftoverRays all(rays);
    all.add(0, rays.count);
    all.closest_hits(tree, hits);
    return;
  }
  HWY_DYNAMIC_DISPATCH(closest_hits_beams_on_target)(tree, rays, hits);
}

void occluded_beams(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  LeftoverRays all(rays);
  all.add(0, rays.count);
  all.occluded(tree, hidden);
}

}  // namespace kernels
}  // namespace bihive
#endif
