#include "bihive/wide/trace/beams.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/wide/trace/beams.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "bihive/simd/dispatch.h"
#include "bihive/wide/schedule/leftover_rays.h"
#include "bihive/wide/trace/closest_beam-inl.h"
#include "bihive/wide/trace/lists.h"
#include "bihive/wide/trace/occlusion_beam-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// Beams that are wider than so many leaves meet spheres in parts. Measured from 0.1 to 0.7: on a million spheres of two
// pixels all the same, on a hundred thousand of ten 0.15 loses a fifth.
constexpr float kWidestWholeInLeaves = 0.25F;

void closest_hits_beams_on_target(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  Rivals rivals(tree, rays, hits);
  LeftoverRays leftover(rays);
  Winners winners;
  const float part_width = kWidestWholeInLeaves * leaf_extent(tree);
  BeamRays beam;
  Frustum frustum;
  for (std::int64_t first = 0; first < rays.count; first += kBeamRays) {
    const int count = static_cast<int>(std::min<std::int64_t>(kBeamRays, rays.count - first));
    if (!set_up_beam(tree, rays, first, count, beam)) {
      leftover.add(first, count);
      continue;
    }
    if (!make_frustum<kBeamRays>(tree, beam, 0, frustum)) {
      write_misses(hits, first, count);
      continue;
    }
    const bool parts = frustum.width > part_width;
    const auto closest = [&](auto common_origin, auto leaves) {
      if (parts)
        ClosestBeam<common_origin, leaves, true>(tree, beam, frustum, rays, first, hits, winners, rivals).run();
      else
        ClosestBeam<common_origin, leaves, false>(tree, beam, frustum, rays, first, hits, winners, rivals).run();
    };
    if (rays.leaves != nullptr)
      closest(std::false_type(), std::true_type());
    else if (beam.common_origin)
      closest(std::true_type(), std::false_type());
    else
      closest(std::false_type(), std::false_type());
  }
  rivals.flush();
  leftover.closest_hits(tree, hits);
}

// Blocks by which the beams of a call are judged, and of sorted rays at most this share of all, one in so many.
constexpr std::int64_t kTrialBlocks = 16;
constexpr std::int64_t kBlocksPerTrial = 8;

// Sorted rays of which beams meet more spheres than this are faster as lists. Measured with limits of 40, 60 and 80: a
// grid of 4,096 spheres has 8, a million uniform ones have 36, 125 molecules side by side 160.
constexpr std::int64_t kMostSpheresMet = 80;

void answer_block(const WideTree& tree, const RaySpan& rays, std::int64_t first, OcclusionBeam& beam,
                  LeftoverRays& leftover) {
  const int count = static_cast<int>(std::min<std::int64_t>(kBeamRays, rays.count - first));
  if (set_up_beam(tree, rays, first, count, beam.rays)) {
    beam.block(first, leftover);
  } else {
    leftover.add(first, count);
  }
}

void occluded_beams_on_target(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  OcclusionBeam beam(tree, rays, false, hidden);
  LeftoverRays leftover(rays);
  for (std::int64_t first = 0; first < rays.count; first += kBeamRays) {
    // Where beams give most of their rays back, the lists do better with all of them in their order.
    if (first == kTrialBlocks * kBeamRays && leftover.count() > first / 3) {
      leftover.add(first, rays.count - first);
      break;
    }
    answer_block(tree, rays, first, beam, leftover);
  }
  beam.flush();
  leftover.occluded(tree, false, hidden);
}

bool occluded_sorted_beams_on_target(const WideTree& tree, const RaySpan& rays, bool judge, std::uint8_t* hidden) {
  OcclusionBeam beam(tree, rays, true, hidden);
  LeftoverRays leftover(rays);

  // Judge by some blocks from everywhere, without what they give back.
  const std::int64_t blocks = (rays.count + kBeamRays - 1) / kBeamRays;
  const std::int64_t step = std::max(kBlocksPerTrial, blocks / kTrialBlocks);
  for (std::int64_t block = 0; block < blocks; block += step)
    answer_block(tree, rays, block * kBeamRays, beam, leftover);
  const std::int64_t tried = (blocks + step - 1) / step * kBeamRays;
  const std::int64_t given_back = leftover.count();
  if (judge && (given_back > tried / 2 || beam.met() > (tried - given_back) * kMostSpheresMet)) return false;

  for (std::int64_t block = 0; block < blocks; ++block)
    if (block % step != 0) answer_block(tree, rays, block * kBeamRays, beam, leftover);
  beam.flush();
  leftover.occluded(tree, true, hidden);
  return true;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(closest_hits_beams_on_target);
HWY_EXPORT(occluded_beams_on_target);
HWY_EXPORT(occluded_sorted_beams_on_target);

namespace kernels {

// Ray numbers are 32-bit in pairs. Where spheres coincide, ids do not tell which ones a ray leaves.
bool beams_take(const WideTree& tree, const RaySpan& rays) {
  return tree.node_count > 0 && (rays.leaves == nullptr || tree.repeated.empty()) &&
         rays.count <= std::numeric_limits<std::uint32_t>::max();
}

void closest_hits_beams(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  ensure_target();
  if (beams_take(tree, rays)) {
    HWY_DYNAMIC_DISPATCH(closest_hits_beams_on_target)(tree, rays, hits);
  } else {
    closest_hits_lists(tree, rays, hits);
  }
}

void occluded_beams(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  ensure_target();
  if (beams_take(tree, rays)) {
    HWY_DYNAMIC_DISPATCH(occluded_beams_on_target)(tree, rays, hidden);
  } else {
    occluded_lists(tree, rays, hidden);
  }
}

bool occluded_sorted_beams(const WideTree& tree, const RaySpan& rays, bool judge, std::uint8_t* hidden) {
  ensure_target();
  return beams_take(tree, rays) && HWY_DYNAMIC_DISPATCH(occluded_sorted_beams_on_target)(tree, rays, judge, hidden);
}

}  // namespace kernels
}  // namespace bihive
#endif
