// The closest hits of a block of 64 neighbouring rays. The frustum of the block is tested against sixteen boxes or
// spheres at a time. A sphere inside it is tested against all rays, or only against the runs of sixteen rays in whose
// own frusta it lies.

#if defined(BIHIVE_WIDE_TRACE_CLOSEST_BEAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_CLOSEST_BEAM_INL_H_
#undef BIHIVE_WIDE_TRACE_CLOSEST_BEAM_INL_H_
#else
#define BIHIVE_WIDE_TRACE_CLOSEST_BEAM_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/trace/beam_rays-inl.h"
#include "bihive/wide/trace/beam_spheres-inl.h"
#include "bihive/wide/trace/beam_walk-inl.h"
#include "bihive/wide/trace/beam_winners-inl.h"
#include "bihive/wide/trace/exact_decision-inl.h"
#include "bihive/wide/trace/frustum-inl.h"
#include "bihive/wide/trace/undecided_pairs.h"
#include "bihive/wide/trace/waiting_spheres-inl.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace beam {

// The largest w at which the answer of one of kRays rays from lane `begin` on may lie.
template <int kRays>
HWY_INLINE float end_of(const BeamRays& rays, int begin) {
  const FloatTag d;
  const auto sign = hn::Set(d, rays.sign);
  auto end = hn::Set(d, -1e30F);
  for (int lane = begin; lane < begin + kRays; lane += kFloatLanes) {
    const auto o = hn::Load(d, rays.origin[rays.major] + lane);
    const auto n = hn::Load(d, rays.direction[rays.major] + lane);
    end = hn::Max(end, hn::Mul(sign, hn::MulAdd(n, hn::Load(d, rays.s_best + lane), o)));
  }
  return frustum::largest(end) + rays.pad;
}

}  // namespace beam

/// The state that the blocks of one call share. The hits of a pair's ray must have been written, at least as a miss,
/// before decide().
class ClosestBeams {
 public:
  ClosestBeams(const WideTree& of, const RaySpan& traced, const HitSpan& found) : tree(of), span(traced), hits(found) {}

  /// Is there room for the pairs of one sphere with a beam?
  bool has_room() const { return pairs_.has_room(kBeamRays); }
  void add_pair(std::int64_t ray, std::uint32_t slot) { pairs_.add(ray, slot); }
  void decide() {
    decide_pairs(tree, span, pairs_, [&](std::int64_t ray, double t, std::uint32_t slot) HWY_ATTR {
      keep_nearer(hits, ray, t, tree.spheres.id(slot));
    });
  }

  const WideTree& tree;
  const RaySpan& span;
  const HitSpan& hits;
  BeamRays rays;  ///< of the current block, prepared by set_up_beam()
  Frustum frustum;
  Winners winners;

 private:
  UndecidedPairs<512> pairs_;
};

/// One block, whose hits are written. For spheres small compared to the beam, kByRuns tests each only against those
/// runs of kRunRays rays in whose own frustum it lies. kSkipOwn: rays may start on spheres.
template <bool kCommonOrigin, bool kSkipOwn, bool kByRuns>
class ClosestBeam {
 public:
  ClosestBeam(ClosestBeams& call, std::int64_t first_ray)
      : call_(call), tree_(call.tree), rays_(call.rays), frustum_(call.frustum), first_ray_(first_ray) {}

  HWY_INLINE void run() {
    call_.winners.clear();
    for (int lane = 0; lane < kBeamRays; lane += kFloatLanes)
      hn::Store(hn::Set(WordTag(), kNoWinner), WordTag(), rays_.winner_number + lane);
    // A run that meets nothing ends before it begins.
    if (kByRuns)
      for (int i = 0; i < kRuns; ++i)
        if (!make_frustum<kRunRays>(tree_, rays_, i * kRunRays, runs_[i])) runs_[i].w_end = -2 * kFarthestEnd;
    walk_beam(tree_, frustum_, frustum_.octant, [&](std::int64_t slot, std::int64_t count) HWY_ATTR {
      meet_leaf(slot, count);
      return false;
    });
    if (kByRuns && !spheres_.empty()) meet_waiting();
    write();
  }

 private:
  void meet_leaf(std::int64_t begin, std::int64_t count) {
    const FloatTag d;
    bool won = false;
    spheres_of_leaf(tree_, frustum_, rays_.e, begin, count, [&](const SpheresInBeam& some) HWY_ATTR {
      if (kByRuns) {
        spheres_.add(some.slot, some.centre, some.padded, some.inside);
        if (spheres_.enough()) meet_waiting();
        return;
      }
      store_local(some.centre);
      alignas(64) float radii[kFloatLanes];
      hn::Store(some.padded, d, radii);
      for (std::uint32_t bits = some.bits; bits != 0; bits &= bits - 1) {
        const int k = __builtin_ctz(bits);
        won |= meet_sphere<kBeamRays>(0, candidate(k, static_cast<std::uint32_t>(some.slot + k), radii[k]));
      }
    });
    if (won) frustum_.w_end = std::min(frustum_.w_end, beam::end_of<kBeamRays>(rays_, 0));
  }

  // The first of the waiting spheres, each against the runs that it may meet.
  void meet_waiting() {
    const FloatTag d;
    const hn::VFromD<FloatTag> centre[3] = {hn::Load(d, spheres_.centre(0)), hn::Load(d, spheres_.centre(1)),
                                            hn::Load(d, spheres_.centre(2))};
    const auto padded = hn::Load(d, spheres_.padded());
    const auto exist = hn::FirstN(d, static_cast<std::size_t>(spheres_.first_count()));
    std::uint64_t pairs = 0;
    for (int i = 0; i < kRuns; ++i)
      pairs |= std::uint64_t{mask_bits(hn::And(exist, spheres_in(runs_[i], centre, padded)))} << (i * kFloatLanes);
    store_local(centre);
    for (; pairs != 0; pairs &= pairs - 1) {
      const int pair = __builtin_ctzll(pairs);
      const int k = pair % kFloatLanes;
      meet_sphere<kRunRays>(pair / kFloatLanes * kRunRays, candidate(k, spheres_.slot(k), spheres_.padded()[k]));
    }
    float end = -2 * kFarthestEnd;
    for (int i = 0; i < kRuns; ++i) {
      runs_[i].w_end = std::min(runs_[i].w_end, beam::end_of<kRunRays>(rays_, i * kRunRays));
      end = std::max(end, runs_[i].w_end);
    }
    frustum_.w_end = end;
    spheres_.drop_first();
  }

  // Centres from the common origin, if there is one.
  HWY_INLINE void store_local(const hn::VFromD<FloatTag> centre[3]) {
    const FloatTag d;
    for (int axis = 0; axis < 3; ++axis)
      hn::Store(kCommonOrigin ? hn::Sub(centre[axis], hn::Set(d, rays_.origin[axis][0])) : centre[axis], d,
                local_centre_[axis]);
  }
  HWY_INLINE beam::Candidate candidate(int k, std::uint32_t slot, float padded) const {
    return {slot,
            kSkipOwn ? left_id_of(tree_, rays_, slot) : 0,
            {local_centre_[0][k], local_centre_[1][k], local_centre_[2][k]},
            padded,
            padded * padded};
  }

  // Tests kRays rays from lane `begin` on against one sphere, run after run. The vectors of a run do not wait for each
  // other, and the only branch asks whether any ray of the run comes near. True if a winner changed.
  template <int kRays>
  HWY_INLINE bool meet_sphere(int begin, const beam::Candidate& sphere) {
    const FloatTag d;
    make_room();
    const beam::RootBounds bounds(rays_, sphere);
    const auto number = hn::Set(WordTag(), call_.winners.next());
    std::uint32_t won = 0;
    for (int run = begin; run < begin + kRays; run += kRunRays) {
      Meeting met[kRunVectors];
      auto largest = hn::Set(d, -1.0F);
      for (int v = 0; v < kRunVectors; ++v) {
        met[v] = beam::meet_rays<kCommonOrigin>(rays_, sphere, run + v * kFloatLanes);
        largest = hn::Max(largest, met[v].dp);
      }
      // No branch for a sphere in the run's own frustum: nearly always some ray comes near.
      if (kRays > kRunRays && hn::AllTrue(d, hn::Lt(largest, hn::Zero(d)))) continue;
      std::uint32_t undecided = 0;
      for (int v = 0; v < kRunVectors; ++v) {
        const int lane = run + v * kFloatLanes;
        const auto near = beam::near_enough<kSkipOwn>(rays_, sphere, met[v], lane);
        const auto best = hn::Load(d, rays_.s_best + lane);
        const auto sure_end = hn::Load(d, rays_.s_sure + lane);
        const beam::Roots roots = bounds.of(met[v], near, best, sure_end);
        hn::Store(hn::IfThenElse(roots.sure, roots.upper, best), d, rays_.s_best + lane);
        hn::Store(hn::IfThenElse(roots.sure, roots.lower, sure_end), d, rays_.s_sure + lane);
        const auto others = hn::Load(WordTag(), rays_.winner_number + lane);
        const auto wins = hn::RebindMask(WordTag(), roots.sure);
        hn::Store(hn::IfThenElse(wins, number, others), WordTag(), rays_.winner_number + lane);
        won |= mask_bits(roots.sure);
        undecided |= mask_bits(hn::AndNot(roots.sure, roots.candidate)) << (v * kFloatLanes);
      }
      for (; HWY_UNLIKELY(undecided != 0); undecided &= undecided - 1) {
        const int ray = run + __builtin_ctz(undecided);
        if (ray < rays_.count) call_.add_pair(first_ray_ + ray, sphere.slot);
      }
    }
    call_.winners.add_if(won != 0, tree_, sphere.slot);
    return won != 0;
  }

  // Makes room for the pairs and the winner that one sphere may add.
  HWY_INLINE void make_room() {
    if (HWY_UNLIKELY(!call_.has_room())) {
      if (!decided_early_) write_misses(call_.hits, first_ray_, rays_.count);
      decided_early_ = true;
      call_.decide();
    }
    call_.winners.make_room(rays_);
  }

  HWY_INLINE void write() {
    if (call_.winners.none() && !decided_early_) return write_misses(call_.hits, first_ray_, rays_.count);
    if (HWY_LIKELY(!decided_early_))
      return write_winners(tree_, call_.span, first_ray_, rays_, call_.winners, call_.hits);
    // Some of the block's pairs have been decided already: the winners must be nearer.
    for (int i = 0; i < rays_.count; ++i) {
      if (rays_.winner_number[i] == kNoWinner) continue;
      if (!call_.has_room()) call_.decide();
      call_.add_pair(first_ray_ + i, call_.winners.slot(rays_.winner_number[i]));
    }
  }

  ClosestBeams& call_;
  const WideTree& tree_;
  BeamRays& rays_;
  Frustum& frustum_;
  const std::int64_t first_ray_;
  bool decided_early_ = false;                      // some pairs of the block, before all its spheres were found
  alignas(64) float local_centre_[3][kFloatLanes];  // NOLINT: written before read
  Frustum runs_[kRuns] = {};
  WaitingSpheres spheres_;
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_CLOSEST_BEAM_INL_H_
