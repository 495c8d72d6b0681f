// The winners of a tile of rays, confirmed in binary64.

#if defined(BIHIVE_WIDE_TRACE_LIST_WINNERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_LIST_WINNERS_INL_H_
#undef BIHIVE_WIDE_TRACE_LIST_WINNERS_INL_H_
#else
#define BIHIVE_WIDE_TRACE_LIST_WINNERS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <limits>

#include "bihive/simd/lanes-inl.h"
#include "bihive/simd/wasm_float64-inl.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/exact_decision-inl.h"
#include "bihive/wide/trace/list_rays-inl.h"
#include "bihive/wide/trace/list_tile.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace list_winners {

using Doubles = hn::CappedTag<double, 8>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Doubles()));
using Singles = hn::Rebind<float, Doubles>;
using Words32 = hn::Rebind<std::uint32_t, Doubles>;
using Ints32 = hn::Rebind<std::int32_t, Doubles>;
using Words64 = hn::Rebind<std::uint64_t, Doubles>;
using Ints64 = hn::Rebind<std::int64_t, Doubles>;

// The t of rays i to i + kLanes - 1 and their winners, and the winners' ids. Lanes without a winner are undefined.
HWY_INLINE hn::Vec<Doubles> exact_t(const WideTree& tree, const RaySpan& rays, const ListTile& tile, bool inward_some,
                                    std::int64_t i, hn::Vec<Words32>& id) {
  const Doubles d;
  const Singles h;
  const Words32 words;
  const Ints32 ints;
  const Words64 wide;
  const WideSpheres& spheres = tree.spheres;
  const auto winner = hn::LoadU(words, tile.winner + i);
  const auto none = hn::Eq(winner, hn::Set(words, kNoSlot));
  const auto slot = hn::BitCast(ints, hn::AndNot(hn::VecFromMask(words, none), winner));
  const auto word =
      hn::BitCast(words, hn::GatherIndex(ints, reinterpret_cast<const std::int32_t*>(spheres.word), slot));
  id = hn::And(word, hn::Set(words, spheres.id_mask()));

  ExactLanes<Doubles> lanes;
  const auto scale = hn::Set(d, tree.scale);
  const float* const centres[3] = {spheres.x, spheres.y, spheres.z};
  for (int axis = 0; axis < 3; ++axis) {
    lanes.origin[axis] = hn::Mul(hn::PromoteTo(d, hn::LoadU(h, rays.origin[axis] + i)), scale);
    lanes.direction[axis] = hn::Mul(hn::PromoteTo(d, hn::LoadU(h, rays.direction[axis] + i)), scale);
    lanes.centre[axis] = hn::PromoteTo(d, hn::GatherIndex(h, centres[axis], slot));
    // WideTree::centre().
    if (HWY_UNLIKELY(tree.is_image))
      lanes.centre[axis] = hn::PromoteTo(d, hn::DemoteTo(h, hn::Add(lanes.centre[axis], hn::Set(d, tree.shift[axis]))));
  }
  const auto radius_place = spheres.has_palette ? hn::BitCast(ints, hn::ShiftRight<WideSpheres::kIdBits>(word)) : slot;
  const float* const radii = spheres.has_palette ? spheres.palette.data() : spheres.r;
  lanes.radius = hn::PromoteTo(d, hn::GatherIndex(h, radii, radius_place));
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  lanes.t_min = rays.t_min != nullptr ? hn::LoadU(d, rays.t_min + i) : hn::Zero(d);
  lanes.t_max = rays.t_max != nullptr ? hn::LoadU(d, rays.t_max + i) : infinity;
  // A winner on which the ray starts is one that it goes into.
  lanes.own = hn::MaskFromVec(hn::Zero(d));
  if (inward_some)
    lanes.own =
        hn::RebindMask(d, hn::Eq(hn::PromoteTo(wide, id), hn::PromoteTo(wide, hn::LoadU(words, tile.inward_id + i))));
  lanes.inside = lanes.own;
  return sphere_hit_lanes(d, lanes);
}

}  // namespace list_winners

/// Writes the hits of all winners of a tile. With `decided_early` the hits of some undecided pairs are already written,
/// and the nearer one stays.
HWY_INLINE void confirm_winners(const WideTree& tree, const RaySpan& rays, const ListTile& tile, bool inward_some,
                                bool decided_early, const HitSpan& hits) {
  using list_winners::kLanes;
  const list_winners::Doubles d;
  const list_winners::Words32 words;
  const list_winners::Words64 wide;
  const list_winners::Ints64 longs;
  const std::int64_t whole = rays.count / kLanes * kLanes;
  for (std::int64_t i = 0; i < whole; i += kLanes) {
    const auto winner = hn::LoadU(words, tile.winner + i);
    if (hn::AllTrue(words, hn::Eq(winner, hn::Set(words, kNoSlot)))) continue;
    hn::Vec<list_winners::Words32> id;
    const auto t = list_winners::exact_t(tree, rays, tile, inward_some, i, id);
    if (!decided_early) {
      const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
      const auto nobody =
          hn::RebindMask(longs, hn::Eq(hn::PromoteTo(wide, winner), hn::Set(wide, std::uint64_t{kNoSlot})));
      hn::StoreU(hn::IfThenElse(hn::RebindMask(d, nobody), infinity, t), d, hits.t + i);
      hn::StoreU(hn::IfThenElse(nobody, hn::Set(longs, kNothing), hn::BitCast(longs, hn::PromoteTo(wide, id))), longs,
                 hits.sphere_id + i);
      continue;
    }
    alignas(64) double exact[kLanes];
    alignas(64) std::uint32_t ids[kLanes];
    hn::Store(t, d, exact);
    hn::Store(id, words, ids);
    for (int k = 0; k < kLanes; ++k)
      if (tile.winner[i + k] != kNoSlot) keep_nearer(hits, i + k, exact[k], ids[k]);
  }
  double t[kExactPairs];
  for (std::int64_t i = whole; i < rays.count; ++i) {
    if (tile.winner[i] == kNoSlot) continue;
    const Pair pair{static_cast<std::uint32_t>(i), tile.winner[i]};
    exact_hits(tree, rays, &pair, 1, t);
    keep_nearer(hits, i, t[0], tree.spheres.id(pair.slot));
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_LIST_WINNERS_INL_H_
