// Any hit of a block of 64 neighbouring rays, or all hits, or the sums of their optical depths. It is made for shadow
// rays towards a light: the traversal starts at the far ends of the rays, rays that are surely occluded drop out of the
// beam, and the occluders of the last blocks are tried first. For all hits, no ray drops out, and binary64 decides
// every sphere that a ray may meet; for sums, which need no t, only where binary32 cannot.

#if defined(BIHIVE_WIDE_TRACE_OCCLUSION_BEAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_OCCLUSION_BEAM_INL_H_
#undef BIHIVE_WIDE_TRACE_OCCLUSION_BEAM_INL_H_
#else
#define BIHIVE_WIDE_TRACE_OCCLUSION_BEAM_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/optical_depths.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/beam_rays-inl.h"
#include "bihive/wide/trace/beam_spheres-inl.h"
#include "bihive/wide/trace/beam_walk-inl.h"
#include "bihive/wide/trace/exact_decision-inl.h"
#include "bihive/wide/trace/frustum-inl.h"
#include "bihive/wide/trace/remaining_rays.h"
#include "bihive/wide/trace/tuning.h"
#include "bihive/wide/trace/undecided_pairs.h"
#include "bihive/wide/tree/duplicates.h"
#include "bihive/wide/tree/leaf_extent.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The latest occluders first. One vector of them is tried: narrow targets try fewer than are kept.
class Occluders {
 public:
  static constexpr int kMost = 8;
  int count() const { return count_; }
  std::uint32_t slot(int i) const { return slots_[i]; }

  void note(std::uint32_t slot) {
    int place = 0;
    while (place < count_ && slots_[place] != slot) ++place;
    if (place == count_) {
      if (count_ < kMost) ++count_;
      place = count_ - 1;
    }
    for (; place > 0; --place) slots_[place] = slots_[place - 1];
    slots_[0] = slot;
  }

 private:
  std::uint32_t slots_[kMost] = {};
  int count_ = 0;
};

/// What a call asks of its rays.
enum class Sought { any_hit, all_hits, depths };

/// The answers, of which a call needs one: a byte for each ray; all hits, in no order; sums, which were set to 0.
struct OcclusionAnswer {
  std::uint8_t* hidden = nullptr;
  std::vector<RayHit>* found = nullptr;
  const SphereDepths* depths = nullptr;
  DepthSums sums{};
};

/// Answers the blocks of one call.
template <Sought kSought>
class OcclusionBeam {
  static constexpr bool kAllHits = kSought != Sought::any_hit;

 public:
  /// sorted: neighbours may start on any surfaces; for depths, every ray is answered, singly if necessary.
  OcclusionBeam(const WideTree& tree, const RaySpan& span, bool sorted, const OcclusionAnswer& answer)
      : tree_(tree), span_(span), answer_(answer), leave_spheres_(span.leaves != nullptr), sorted_(sorted) {
    width_limit_ = (kSought == Sought::depths ? kWidestForDepthsInLeaves : 1.0F) * leaf_extent(tree);
    run_width_limit_ = sorted ? width_limit_ : kWidestRunInLeaves * width_limit_;
  }

  /// The rays of the next block: to be filled by set_up_beam() before block().
  BeamRays rays;

  /// Answers the block, except pairs that wait for decide(), and runs of sixteen rays that are too wide for a beam:
  /// those are added to `remaining`.
  HWY_INLINE void block(std::int64_t first_ray, RemainingRays& remaining) {
    first_ray_ = first_ray;
    if (!kAllHits) std::fill_n(answer_.hidden + first_ray, rays.count, std::uint8_t{0});
    if (kSought == Sought::depths) sums_ = {};
    trace_block(remaining);
    if (kSought == Sought::depths) add_sums();
  }

  /// The rays of the pairs must have been answered, by block(), before.
  void decide() {
    decide_pairs(tree_, span_, pairs_, [&](std::int64_t ray, double t, std::uint32_t slot) HWY_ATTR {
      if constexpr (kSought == Sought::any_hit) answer_.hidden[ray] = 1;
      if constexpr (kSought == Sought::all_hits) answer_.found->push_back({ray, t, tree_.spheres.id(slot)});
      if constexpr (kSought == Sought::depths) answer_.sums.add(ray, depths_of(slot), answer_.depths->columns);
    });
  }

  /// Spheres tested against beams, each times the rays of the beam.
  std::int64_t met() const { return met_; }

 private:
  HWY_INLINE void trace_block(RemainingRays& remaining) {
    find_open_vectors();
    Frustum frustum;
    if (!make_frustum<kBeamRays>(tree_, rays, 0, frustum)) return;

    // Try the last occluders.
    if (!kAllHits && occluders_.count() > 0 && try_occluders(frustum)) {
      if (done<kBeamRays>(0)) {
        note_hidden(done_lanes());
        return;
      }
      if (!make_frustum<kBeamRays>(tree_, rays, 0, frustum)) return note_hidden(done_lanes());
    }
    if (frustum.width > width_limit_) {
      if (leave_spheres_ && (kAllHits || !sorted_)) {
        trace_groups(remaining);
      } else {
        trace_runs(remaining);
      }
      return;
    }
    trace<kBeamRays>(0, frustum);
    note_hidden(done_lanes());
  }

  // Traces runs of sixteen neighbours, each by itself.
  HWY_INLINE void trace_runs(RemainingRays& remaining) {
    Frustum frustum;
    for (int begin = 0; begin < rays.count; begin += kRunRays) {
      if (done<kRunRays>(begin) || !make_frustum<kRunRays>(tree_, rays, begin, frustum)) continue;
      if (frustum.width <= run_width_limit_) {
        trace<kRunRays>(begin, frustum);
      } else if (kAllHits && sorted_) {
        trace_alone(open_lanes() & ((std::uint64_t{1} << kRunRays) - 1) << begin);
      } else {
        remaining.add(first_ray_ + begin, std::min(kRunRays, rays.count - begin));
      }
    }
    note_hidden(done_lanes());
  }

  // Traces each group of rays that start on the same sphere by itself, with the lanes of all others closed: such rays
  // start close together.
  HWY_INLINE void trace_groups(RemainingRays& remaining) {
    const FloatTag d;
    alignas(64) float segment[kBeamRays];
    std::copy_n(rays.s_best, kBeamRays, segment);
    std::uint64_t hidden = done_lanes();
    std::uint64_t group = 0;
    int small_groups = 0;
    for (std::uint64_t pending = ~hidden; pending != 0; pending &= ~group) {
      const std::uint32_t id = rays.left_id[__builtin_ctzll(pending)];
      group = 0;
      for (int lane = 0; lane < kBeamRays; lane += kFloatLanes) {
        const auto s = hn::Load(d, segment + lane);
        const auto same = hn::RebindMask(d, hn::Eq(hn::Load(WordTag(), rays.left_id + lane), hn::Set(WordTag(), id)));
        const auto in_group = hn::And(same, hn::Ge(s, hn::Zero(d)));
        hn::Store(hn::IfThenElse(in_group, s, hn::Set(d, -1.0F)), d, rays.s_best + lane);
        group |= std::uint64_t{mask_bits(in_group)} << lane;
      }
      find_open_vectors();
      const bool small = !(kAllHits && sorted_) && __builtin_popcountll(group) < kFewestOfGroup;
      if (small && ++small_groups == kMostSmallGroups) group = pending;
      Frustum frustum;
      if (small || !make_frustum<kBeamRays>(tree_, rays, 0, frustum) || frustum.width > run_width_limit_) {
        if (kAllHits && sorted_) {
          trace_alone(group);
          continue;
        }
        for (std::uint64_t bits = group; bits != 0; bits &= bits - 1) {
          const int ray = __builtin_ctzll(bits);
          if (ray < rays.count) remaining.add(first_ray_ + ray, 1);
        }
        continue;
      }
      trace<kBeamRays>(0, frustum);
      hidden |= group & done_lanes();
    }
    note_hidden(hidden);
  }

  // Traces these rays one by one; all rays are as before afterwards.
  HWY_INLINE void trace_alone(std::uint64_t lanes) {
    alignas(64) float segment[kBeamRays];
    std::copy_n(rays.s_best, kBeamRays, segment);
    for (; lanes != 0; lanes &= lanes - 1) {
      const int ray = __builtin_ctzll(lanes);
      std::fill_n(rays.s_best, kBeamRays, -1.0F);
      rays.s_best[ray] = segment[ray];
      find_open_vectors();
      Frustum frustum;
      if (make_frustum<kBeamRays>(tree_, rays, 0, frustum)) trace<kBeamRays>(0, frustum);
    }
    std::copy_n(segment, kBeamRays, rays.s_best);
    find_open_vectors();
  }

  const WideTree& tree_;
  const RaySpan& span_;
  OcclusionAnswer answer_;
  bool leave_spheres_;  ///< some rays may start on a sphere
  bool sorted_;
  std::int64_t first_ray_ = 0;
  std::int64_t met_ = 0;
  std::uint64_t open_vectors_ = 0;  ///< a bit for each vector with rays that are not yet occluded
  float width_limit_, run_width_limit_;
  UndecidedPairs<512> pairs_;
  Occluders occluders_;

  // Of the block's rays, as far as binary32 knows.
  struct alignas(64) Sums {
    OpticalDepth columns[3][kBeamRays];
  };
  Sums sums_;
  OpticalDepth with_duplicates_[3];

  HWY_INLINE void add_sums() {
    for (int c = 0; c < answer_.depths->columns; ++c) {
      OpticalDepth* const to = answer_.sums.columns[c] + first_ray_;
      for (int i = 0; i < rays.count; ++i) to[i] = sum_of_depths(to[i], sums_.columns[c][i]);
    }
  }

  // Of the sphere and those that coincide with it. Holds until the next call.
  HWY_INLINE const OpticalDepth* depths_of(std::uint32_t slot) {
    const std::int64_t id = tree_.spheres.id(slot);
    const OpticalDepth* const row = answer_.depths->row(id);
    if (HWY_LIKELY(tree_.piles.empty())) return row;
    const int columns = answer_.depths->columns;
    std::copy_n(row, columns, with_duplicates_);
    for_duplicates(tree_, id, [&](std::int64_t other) {
      for (int c = 0; c < columns; ++c)
        with_duplicates_[c] = sum_of_depths(with_duplicates_[c], answer_.depths->row(other)[c]);
    });
    return with_duplicates_;
  }

  HWY_INLINE void add_depths(const OpticalDepth* depths, FloatMask to, int lane) {
    const WordTag w;
    const auto lanes = hn::RebindMask(w, to);
    for (int c = 0; c < answer_.depths->columns; ++c) {
      OpticalDepth* const sums = sums_.columns[c] + lane;
      const auto before = hn::Load(w, sums);
      const auto added = hn::Min(hn::Add(before, hn::Set(w, depths[c])), hn::Set(w, kDeepest));
      hn::Store(hn::IfThenElse(lanes, added, before), w, sums);
    }
  }

  // The lanes whose rays have no segment any more.
  HWY_INLINE std::uint64_t done_lanes() const {
    const FloatTag d;
    std::uint64_t bits = 0;
    for (int lane = 0; lane < kBeamRays; lane += kFloatLanes)
      bits |= std::uint64_t{mask_bits(hn::Lt(hn::Load(d, rays.s_best + lane), hn::Zero(d)))} << lane;
    return bits;
  }

  HWY_INLINE std::uint64_t open_lanes() const { return ~done_lanes(); }

  HWY_INLINE void note_hidden(std::uint64_t lanes) {
    if (kAllHits || lanes == 0) return;
    for (int i = 0; i < rays.count; ++i) answer_.hidden[first_ray_ + i] |= static_cast<std::uint8_t>(lanes >> i & 1);
  }

  HWY_INLINE void find_open_vectors() {
    const FloatTag d;
    open_vectors_ = 0;
    for (int lane = 0; lane < kBeamRays; lane += kFloatLanes)
      if (!hn::AllTrue(d, hn::Lt(hn::Load(d, rays.s_best + lane), hn::Zero(d))))
        open_vectors_ |= std::uint64_t{1} << (lane / kFloatLanes);
  }

  // The open vectors among kRays rays from lane `begin` on.
  template <int kRays>
  HWY_INLINE std::uint64_t open_vectors(int begin) const {
    constexpr std::uint64_t kVectors = ~std::uint64_t{0} >> (64 - kRays / kFloatLanes);
    return open_vectors_ & kVectors << (begin / kFloatLanes);
  }
  template <int kRays>
  HWY_INLINE bool done(int begin) const {
    return open_vectors<kRays>(begin) == 0;
  }

  // Does the sphere occlude any more rays?
  template <int kRays>
  HWY_INLINE bool meet_sphere(int begin, std::uint32_t slot) {
    const FloatTag d;
    const float padded = static_cast<float>(tree_.spheres.radius(slot)) + rays.e;
    const beam::Candidate sphere{slot,
                                 leave_spheres_ ? left_id_of(tree_, rays, slot) : 0,
                                 {tree_.spheres.x[slot], tree_.spheres.y[slot], tree_.spheres.z[slot]},
                                 padded,
                                 padded * padded};
    const beam::RootBounds bounds(rays, sphere);
    const OpticalDepth* depths = nullptr;
    if (HWY_UNLIKELY(!pairs_.has_room(kBeamRays))) decide();
    met_ += kRays;
    bool any = false;
    for (std::uint64_t vectors = open_vectors<kRays>(begin); vectors != 0; vectors &= vectors - 1) {
      const int lane = __builtin_ctzll(vectors) * kFloatLanes;
      // Which rays are not yet occluded, and come near the sphere, but do not start on it?
      const auto best = hn::Load(d, rays.s_best + lane);
      const Meeting met = beam::meet_rays<false>(rays, sphere, lane);
      auto near = leave_spheres_ ? beam::near_enough<true>(rays, sphere, met, lane)
                                 : beam::near_enough<false>(rays, sphere, met, lane);
      near = hn::And(near, hn::Ge(best, hn::Zero(d)));
      if (hn::AllFalse(d, near)) continue;

      constexpr bool kFarToo = kSought == Sought::depths;
      const beam::Roots roots = bounds.template of<kFarToo>(met, near, best, hn::Load(d, rays.s_sure + lane));
      if constexpr (kSought == Sought::all_hits) {
        add_pairs(mask_bits(roots.candidate), lane, slot);
        continue;
      }
      if constexpr (kSought == Sought::depths) {
        if (depths == nullptr) depths = depths_of(slot);
        add_depths(depths, roots.sure, lane);
        add_pairs(mask_bits(hn::AndNot(roots.sure, roots.candidate)), lane, slot);
        continue;
      }
      const auto rest = hn::IfThenElse(roots.sure, hn::Set(d, -1.0F), best);
      hn::Store(rest, d, rays.s_best + lane);
      if (!hn::AllFalse(d, roots.sure)) {
        any = true;
        if (hn::AllTrue(d, hn::Lt(rest, hn::Zero(d)))) open_vectors_ &= ~(std::uint64_t{1} << (lane / kFloatLanes));
      }
      add_pairs(mask_bits(hn::AndNot(roots.sure, roots.candidate)), lane, slot);
    }
    return any;
  }

  HWY_INLINE void add_pairs(std::uint32_t bits, int lane, std::uint32_t slot) {
    for (; bits != 0; bits &= bits - 1) {
      const int ray = lane + __builtin_ctz(bits);
      if (ray < rays.count) pairs_.add(first_ray_ + ray, slot);
    }
  }

  // Do the last occluders occlude any ray?
  HWY_INLINE bool try_occluders(const Frustum& frustum) {
    const FloatTag d;
    alignas(64) float places[4][kFloatLanes] = {};
    const int n = std::min(occluders_.count(), kFloatLanes);
    for (int i = 0; i < n; ++i) {
      const std::uint32_t slot = occluders_.slot(i);
      places[0][i] = tree_.spheres.x[slot];
      places[1][i] = tree_.spheres.y[slot];
      places[2][i] = tree_.spheres.z[slot];
      places[3][i] = static_cast<float>(tree_.spheres.radius(slot)) + rays.e;
    }
    const hn::VFromD<FloatTag> centre[3] = {hn::Load(d, places[0]), hn::Load(d, places[1]), hn::Load(d, places[2])};
    const auto exist = hn::FirstN(d, static_cast<std::size_t>(n));
    std::uint32_t bits = mask_bits(hn::And(exist, spheres_in(frustum, centre, hn::Load(d, places[3]))));
    bool any = false;
    for (; bits != 0; bits &= bits - 1) any |= meet_sphere<kBeamRays>(0, occluders_.slot(__builtin_ctz(bits)));
    return any;
  }

  // True: all rays are occluded.
  template <int kRays>
  HWY_INLINE bool meet_leaf(int begin, const Frustum& frustum, std::int64_t first_slot, std::int64_t count) {
    bool any = false;
    spheres_of_leaf(tree_, frustum, rays.e, first_slot, count, [&](const SpheresInBeam& some) HWY_ATTR {
      for (std::uint32_t bits = some.bits; bits != 0; bits &= bits - 1) {
        const auto sphere = static_cast<std::uint32_t>(some.slot + __builtin_ctz(bits));
        if (!meet_sphere<kRays>(begin, sphere)) continue;
        occluders_.note(sphere);
        any = true;
      }
    });
    return any && done<kRays>(begin);
  }

  // The traversal starts at the rays' far ends; docs/decisions/0013-any-hit-from-the-far-end.md explains why.
  template <int kRays>
  HWY_INLINE void trace(int begin, const Frustum& frustum) {
    walk_beam(tree_, frustum, 7 - frustum.octant, [&](std::int64_t slot, std::int64_t count) HWY_ATTR {
      return meet_leaf<kRays>(begin, frustum, slot, count);
    });
  }
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_OCCLUSION_BEAM_INL_H_
