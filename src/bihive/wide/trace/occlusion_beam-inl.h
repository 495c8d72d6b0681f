// Is anything hit by each of a block's 64 neighbouring rays? Made for shadow rays towards a light: the tree is walked
// from their far ends, rays that are surely hidden leave the beam, and spheres that hid the last blocks are tried
// first.

#if defined(BIHIVE_WIDE_TRACE_OCCLUSION_BEAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_OCCLUSION_BEAM_INL_H_
#undef BIHIVE_WIDE_TRACE_OCCLUSION_BEAM_INL_H_
#else
#define BIHIVE_WIDE_TRACE_OCCLUSION_BEAM_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/schedule/leftover_rays.h"
#include "bihive/wide/trace/beam_rays-inl.h"
#include "bihive/wide/trace/beam_spheres-inl.h"
#include "bihive/wide/trace/closest_beam-inl.h"
#include "bihive/wide/trace/exact_decision-inl.h"
#include "bihive/wide/trace/frustum-inl.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Pairs of rays and spheres of which binary32 cannot tell whether they meet. `hidden` must have been written for their
/// rays before a flush.
class Doubts {
 public:
  Doubts(const WideTree& tree, const RaySpan& rays, std::uint8_t* hidden) : tree_(tree), rays_(rays), hidden_(hidden) {}

  bool full() const { return count_ > kRoom - kBeamRays; }
  void add(std::int64_t ray, std::uint32_t slot) { pairs_[count_++] = {static_cast<std::uint32_t>(ray), slot}; }

  void flush() {
    double t[kExactPairs];
    for (int first = 0; first < count_; first += kExactPairs) {
      const int n = std::min(kExactPairs, count_ - first);
      exact_hits(tree_, rays_, pairs_ + first, n, t);
      for (int k = 0; k < n; ++k)
        if (t[k] < std::numeric_limits<double>::infinity()) hidden_[pairs_[first + k].ray] = 1;
    }
    count_ = 0;
  }

 private:
  static constexpr int kRoom = 512;
  const WideTree& tree_;
  const RaySpan rays_;
  std::uint8_t* const hidden_;
  int count_ = 0;
  Pair pairs_[kRoom];
};

/// The spheres that hid rays last, the latest first. A vector of them is tried, so on narrow targets fewer than are
/// kept.
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

/// Beams that are wider than so many leaves are slower than parts of them, or than ray lists. Measured; the first is
/// flat from 0.7 to 4 on small scenes, the second loses above 2 on large ones.
constexpr float kWidestInLeaves = 1;
constexpr float kWidestPartInLeaves = 1.5F;
/// Of sorted rays. Tried from 0.35 to 3: half of this is up to a sixth slower, more is the same on most scenes.
constexpr float kWidestSortedInLeaves = 1;
constexpr float kWidestSortedPartInLeaves = 1;
/// Groups of fewer rays are left to ray lists; after some of them so are all rays.
constexpr int kFewestOfGroup = 4;
constexpr int kMostSmallGroups = 4;

/// Rays of a block and what hides them.
class OcclusionBeam {
 public:
  /// sorted: neighbours start on any surfaces.
  OcclusionBeam(const WideTree& tree, const RaySpan& span, bool sorted, std::uint8_t* hidden)
      : tree_(tree),
        has_leaves_(span.leaves != nullptr),
        sorted_(sorted),
        hidden_(hidden),
        doubts_(tree, span, hidden) {
    const float leaf = leaf_extent(tree);
    width_limit_ = (sorted ? kWidestSortedInLeaves : kWidestInLeaves) * leaf;
    part_width_limit_ = (sorted ? kWidestSortedPartInLeaves : kWidestPartInLeaves) * leaf;
  }

  /// The rays of the next block go here, by set_up_beam(), before block().
  BeamRays rays;

  /// Answers the block, but for doubts, and for runs of sixteen rays that are too wide for beams: those are left over.
  HWY_INLINE void block(std::int64_t first_ray, LeftoverRays& leftover) {
    first_ray_ = first_ray;
    std::fill_n(hidden_ + first_ray, rays.count, std::uint8_t{0});
    trace_block(leftover);
  }

  void flush() { doubts_.flush(); }

  /// Spheres that met beams so far, each times the rays of the beam.
  std::int64_t met() const { return met_; }

 private:
  HWY_INLINE void trace_block(LeftoverRays& leftover) {
    find_open_vectors();
    Frustum frustum;
    if (!make_frustum<kBeamRays>(tree_, rays, 0, frustum)) return;

    // The spheres that hid the last rays.
    if (occluders_.count() > 0 && try_occluders(frustum)) {
      if (done<kBeamRays>(0)) {
        note_hidden(done_lanes());
        return;
      }
      if (!make_frustum<kBeamRays>(tree_, rays, 0, frustum)) return note_hidden(done_lanes());
    }
    if (frustum.width > width_limit_) {
      if (has_leaves_ && !sorted_) {
        trace_groups(leftover);
      } else {
        trace_parts(leftover);
      }
      return;
    }
    trace<kBeamRays>(0, frustum);
    note_hidden(done_lanes());
  }

  // Runs of neighbours, each by itself.
  HWY_INLINE void trace_parts(LeftoverRays& leftover) {
    Frustum frustum;
    for (int begin = 0; begin < rays.count; begin += kPartRays) {
      if (done<kPartRays>(begin) || !make_frustum<kPartRays>(tree_, rays, begin, frustum)) continue;
      if (frustum.width <= part_width_limit_) {
        trace<kPartRays>(begin, frustum);
      } else {
        leftover.add(first_ray_ + begin, std::min(kPartRays, rays.count - begin));
      }
    }
    note_hidden(done_lanes());
  }

  // Rays that leave the same sphere start close together: each such group by itself, the lanes of all others closed.
  HWY_INLINE void trace_groups(LeftoverRays& leftover) {
    const FloatTag d;
    alignas(64) float segment[kBeamRays];
    std::copy_n(rays.s_best, kBeamRays, segment);
    std::uint64_t hidden = done_lanes();
    std::uint64_t group = 0;
    int small_groups = 0;
    for (std::uint64_t pending = ~hidden; pending != 0; pending &= ~group) {
      const std::uint32_t id = rays.leaves[__builtin_ctzll(pending)];
      group = 0;
      for (int lane = 0; lane < kBeamRays; lane += kFloatLanes) {
        const auto s = hn::Load(d, segment + lane);
        const auto same = hn::RebindMask(d, hn::Eq(hn::Load(WordTag(), rays.leaves + lane), hn::Set(WordTag(), id)));
        const auto in_group = hn::And(same, hn::Ge(s, hn::Zero(d)));
        hn::Store(hn::IfThenElse(in_group, s, hn::Set(d, -1.0F)), d, rays.s_best + lane);
        group |= std::uint64_t{mask_bits(in_group)} << lane;
      }
      find_open_vectors();
      const bool small = __builtin_popcountll(group) < kFewestOfGroup;
      if (small && ++small_groups == kMostSmallGroups) group = pending;
      Frustum frustum;
      if (small || !make_frustum<kBeamRays>(tree_, rays, 0, frustum) || frustum.width > part_width_limit_) {
        for (std::uint64_t bits = group; bits != 0; bits &= bits - 1) {
          const int ray = __builtin_ctzll(bits);
          if (ray < rays.count) leftover.add(first_ray_ + ray, 1);
        }
        continue;
      }
      trace<kBeamRays>(0, frustum);
      hidden |= group & done_lanes();
    }
    note_hidden(hidden);
  }

  const WideTree& tree_;
  bool has_leaves_, sorted_;
  std::uint8_t* hidden_;
  std::int64_t first_ray_ = 0;
  std::int64_t met_ = 0;
  std::uint64_t open_vectors_ = 0;  ///< a bit for each vector with rays that are not hidden yet
  float width_limit_, part_width_limit_;
  Doubts doubts_;
  Occluders occluders_;

  // The lanes whose rays have no segment any more.
  HWY_INLINE std::uint64_t done_lanes() const {
    const FloatTag d;
    std::uint64_t bits = 0;
    for (int lane = 0; lane < kBeamRays; lane += kFloatLanes)
      bits |= std::uint64_t{mask_bits(hn::Lt(hn::Load(d, rays.s_best + lane), hn::Zero(d)))} << lane;
    return bits;
  }

  HWY_INLINE void note_hidden(std::uint64_t lanes) {
    if (lanes == 0) return;
    for (int i = 0; i < rays.count; ++i) hidden_[first_ray_ + i] |= static_cast<std::uint8_t>(lanes >> i & 1);
  }

  HWY_INLINE void find_open_vectors() {
    const FloatTag d;
    open_vectors_ = 0;
    for (int lane = 0; lane < kBeamRays; lane += kFloatLanes)
      if (!hn::AllTrue(d, hn::Lt(hn::Load(d, rays.s_best + lane), hn::Zero(d))))
        open_vectors_ |= std::uint64_t{1} << (lane / kFloatLanes);
  }

  // Of kRays rays from lane `begin` on.
  template <int kRays>
  HWY_INLINE std::uint64_t open_vectors(int begin) const {
    constexpr std::uint64_t kVectors = ~std::uint64_t{0} >> (64 - kRays / kFloatLanes);
    return open_vectors_ & kVectors << (begin / kFloatLanes);
  }
  template <int kRays>
  HWY_INLINE bool done(int begin) const {
    return open_vectors<kRays>(begin) == 0;
  }

  // Has the sphere hidden any more rays?
  template <int kRays>
  HWY_INLINE bool meet_sphere(int begin, std::uint32_t slot) {
    const FloatTag d;
    const float padded = static_cast<float>(tree_.spheres.radius(slot)) + rays.e;
    const beam::Candidate sphere{slot,
                                 static_cast<std::uint32_t>(tree_.spheres.id(slot)),
                                 {tree_.spheres.x[slot], tree_.spheres.y[slot], tree_.spheres.z[slot]},
                                 padded,
                                 padded * padded};
    const beam::RootBounds bounds(rays, sphere);
    if (HWY_UNLIKELY(doubts_.full())) doubts_.flush();
    met_ += kRays;
    bool any = false;
    for (std::uint64_t vectors = open_vectors<kRays>(begin); vectors != 0; vectors &= vectors - 1) {
      const int lane = __builtin_ctzll(vectors) * kFloatLanes;
      // Which rays are not hidden yet, and come near to the sphere, but do not leave it?
      const auto best = hn::Load(d, rays.s_best + lane);
      const beam::Meeting met = beam::meet<false>(rays, sphere, lane);
      auto near = has_leaves_ ? beam::near_enough<true>(rays, sphere, met, lane)
                              : beam::near_enough<false>(rays, sphere, met, lane);
      near = hn::And(near, hn::Ge(best, hn::Zero(d)));
      if (hn::AllFalse(d, near)) continue;

      const beam::Roots roots = bounds.of(met, near, best, hn::Load(d, rays.s_sure + lane));
      const auto rest = hn::IfThenElse(roots.sure, hn::Set(d, -1.0F), best);
      hn::Store(rest, d, rays.s_best + lane);
      if (!hn::AllFalse(d, roots.sure)) {
        any = true;
        if (hn::AllTrue(d, hn::Lt(rest, hn::Zero(d)))) open_vectors_ &= ~(std::uint64_t{1} << (lane / kFloatLanes));
      }
      for (std::uint32_t bits = mask_bits(hn::AndNot(roots.sure, roots.candidate)); bits != 0; bits &= bits - 1) {
        const int ray = lane + __builtin_ctz(bits);
        if (ray < rays.count) doubts_.add(first_ray_ + ray, slot);
      }
    }
    return any;
  }

  // Have the last occluders hidden any ray?
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

  // Spheres of a leaf. True: all rays are hidden.
  template <int kRays>
  HWY_INLINE bool meet_leaf(int begin, const Frustum& frustum, std::int64_t first_slot, std::int64_t count) {
    const FloatTag d;
    bool any = false;
    for (std::int64_t first = 0; first < count; first += kFloatLanes) {
      const std::int64_t slot = first_slot + first;
      const hn::VFromD<FloatTag> centre[3] = {hn::LoadU(d, tree_.spheres.x + slot),
                                              hn::LoadU(d, tree_.spheres.y + slot),
                                              hn::LoadU(d, tree_.spheres.z + slot)};
      const auto padded = hn::Add(beam::radii_at(tree_.spheres, slot), hn::Set(d, rays.e));
      std::uint32_t bits = mask_bits(spheres_in(frustum, centre, padded));
      if (count - first < kFloatLanes) bits &= (1U << (count - first)) - 1;
      for (; bits != 0; bits &= bits - 1) {
        const auto sphere = static_cast<std::uint32_t>(slot + __builtin_ctz(bits));
        if (!meet_sphere<kRays>(begin, sphere)) continue;
        occluders_.note(sphere);
        any = true;
      }
    }
    return any && done<kRays>(begin);
  }

  // From the far end: why, says docs/decisions/0013-any-hit-from-the-far-end.md.
  template <int kRays>
  HWY_INLINE void trace(int begin, const Frustum& frustum) {
    beam::Waiting waiting[kMostLevels * kWidth];
    int waiting_count = 0;
    waiting[waiting_count++] = {0, 0, 0};
    alignas(64) float w_near[kWidth];
    while (waiting_count > 0) {
      const beam::Waiting top = waiting[--waiting_count];
      if (top.count != 0) {
        if (meet_leaf<kRays>(begin, frustum, top.node, top.count)) return;
        continue;
      }
      const WideNode& node = tree_.nodes[top.node];
      const std::uint32_t bits = boxes_in(node, frustum, w_near);
      if (bits == 0) continue;
      std::uint64_t order = 0;
      for (std::uint32_t places = near_to_far(node, 7 - frustum.octant, bits, order); places != 0;) {
        const int place = 31 - __builtin_clz(places);
        places ^= 1U << place;
        const int slot = static_cast<int>(order >> (4 * place) & 15);
        waiting[waiting_count++] = beam::child_of(node, slot, w_near[slot]);
      }
    }
  }
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_OCCLUSION_BEAM_INL_H_
