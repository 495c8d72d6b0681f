#include "bihive/wide/trace/beams.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/wide/trace/beams.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "bihive/base/watch.h"
#include "bihive/simd/dispatch.h"
#include "bihive/wide/trace/closest_beam-inl.h"
#include "bihive/wide/trace/occlusion_beam-inl.h"
#include "bihive/wide/trace/tuning.h"
#include "bihive/wide/tree/leaf_extent.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

int block_size(const RaySpan& rays, std::int64_t first) {
  return static_cast<int>(std::min<std::int64_t>(kBeamRays, rays.count - first));
}

// Every few blocks: is the call cancelled?
void look_after(std::int64_t first) {
  if (first % (16 * kBeamRays) == 0) stop_chunk_if_cancelled();
}

void closest_block(ClosestBeams& call, std::int64_t first, float widest_whole) {
  const bool by_runs = call.frustum.width > widest_whole;
  const auto run = [&](auto common_origin, auto skip_own) {
    if (by_runs)
      ClosestBeam<common_origin, skip_own, true>(call, first).run();
    else
      ClosestBeam<common_origin, skip_own, false>(call, first).run();
  };
  if (call.span.leaves != nullptr)
    run(std::false_type(), std::true_type());
  else if (call.rays.common_origin)
    run(std::true_type(), std::false_type());
  else
    run(std::false_type(), std::false_type());
}

RemainingRays closest_hits_by_beams_on_target(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  RemainingRays remaining;
  ClosestBeams call(tree, rays, hits);
  const float widest_whole = kWidestWholeInLeaves * leaf_extent(tree);
  for (std::int64_t first = 0; first < rays.count; first += kBeamRays) {
    look_after(first);
    const int count = block_size(rays, first);
    if (!set_up_beam(tree, rays, first, count, call.rays)) {
      remaining.add(first, count);
    } else if (!make_frustum<kBeamRays>(tree, call.rays, 0, call.frustum)) {
      write_misses(hits, first, count);
    } else {
      closest_block(call, first, widest_whole);
    }
  }
  call.decide();
  return remaining;
}

template <Sought kSought>
void occluded_block(const WideTree& tree, const RaySpan& rays, std::int64_t first, OcclusionBeam<kSought>& beam,
                    RemainingRays& remaining) {
  look_after(first);
  const int count = block_size(rays, first);
  if (set_up_beam(tree, rays, first, count, beam.rays)) {
    beam.block(first, remaining);
  } else {
    remaining.add(first, count);
  }
}

RemainingRays occluded_by_beams_on_target(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  RemainingRays remaining;
  OcclusionBeam<Sought::any_hit> beam(tree, rays, false, {.hidden = hidden});
  for (std::int64_t first = 0; first < rays.count; first += kBeamRays) {
    // If beams return most of their rays, the lists do better with all of them in their original order.
    if (first == kTrialBlocks * kBeamRays && remaining.count() > first / 3) {
      remaining.add(first, rays.count - first);
      break;
    }
    occluded_block(tree, rays, first, beam, remaining);
  }
  beam.decide();
  return remaining;
}

RemainingRays all_hits_by_beams_on_target(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& found) {
  RemainingRays remaining;
  OcclusionBeam<Sought::all_hits> beam(tree, rays, false, {.found = &found});
  for (std::int64_t first = 0; first < rays.count; first += kBeamRays) {
    if (first == kTrialBlocks * kBeamRays && remaining.count() > first / 3) {
      remaining.add(first, rays.count - first);
      break;
    }
    occluded_block(tree, rays, first, beam, remaining);
  }
  beam.decide();
  return remaining;
}

RemainingRays depths_by_beams_on_target(const WideTree& tree, const RaySpan& rays, bool sorted,
                                        const SphereDepths& depths, const DepthSums& sums) {
  RemainingRays remaining;
  OcclusionBeam<Sought::depths> beam(tree, rays, sorted, {.depths = &depths, .sums = sums});
  for (std::int64_t first = 0; first < rays.count; first += kBeamRays)
    occluded_block(tree, rays, first, beam, remaining);
  beam.decide();
  return remaining;
}

wide::SortedBeams occluded_by_sorted_beams_on_target(const WideTree& tree, const RaySpan& rays,
                                                     const wide::BlockChoice& blocks, std::uint8_t* hidden) {
  wide::SortedBeams done;
  OcclusionBeam<Sought::any_hit> beam(tree, rays, true, {.hidden = hidden});
  for (std::int64_t first = 0; first < rays.count; first += kBeamRays)
    if ((first / kBeamRays % blocks.step == 0) != blocks.others)
      occluded_block(tree, rays, first, beam, done.remaining);
  beam.decide();
  done.spheres_met = beam.met();
  return done;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(closest_hits_by_beams_on_target);
HWY_EXPORT(occluded_by_beams_on_target);
HWY_EXPORT(occluded_by_sorted_beams_on_target);
HWY_EXPORT(all_hits_by_beams_on_target);
HWY_EXPORT(depths_by_beams_on_target);

namespace wide {

// Ray numbers are 32-bit in pairs.
bool beams_take(const WideTree& tree, const RaySpan& rays) {
  return tree.node_count > 0 && rays.count <= std::numeric_limits<std::uint32_t>::max();
}

RemainingRays closest_hits_by_beams(const WideTree& tree, const RaySpan& rays, const HitSpan& hits) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(closest_hits_by_beams_on_target)(tree, rays, hits);
}

RemainingRays occluded_by_beams(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(occluded_by_beams_on_target)(tree, rays, hidden);
}

RemainingRays all_hits_by_beams(const WideTree& tree, const RaySpan& rays, std::vector<RayHit>& found) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(all_hits_by_beams_on_target)(tree, rays, found);
}

RemainingRays depths_by_beams(const WideTree& tree, const RaySpan& rays, bool sorted, const SphereDepths& depths,
                              const DepthSums& sums) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(depths_by_beams_on_target)(tree, rays, sorted, depths, sums);
}

SortedBeams occluded_by_sorted_beams(const WideTree& tree, const RaySpan& rays, const BlockChoice& blocks,
                                     std::uint8_t* hidden) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(occluded_by_sorted_beams_on_target)(tree, rays, blocks, hidden);
}

}  // namespace wide
}  // namespace bihive
#endif
