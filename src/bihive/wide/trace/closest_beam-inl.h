// The closest hits of a block of 64 neighbouring rays: its frustum against sixteen boxes or spheres at a time, and the
// spheres that lie in it against all rays, or against the runs of sixteen rays in whose own frusta they lie.

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
#include "bihive/wide/trace/beam_winners-inl.h"
#include "bihive/wide/trace/frustum-inl.h"
#include "bihive/wide/trace/waiting_spheres-inl.h"
#include "bihive/wide/tree/radii-inl.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace beam {

// A child that waits, with the least w at which a ray may enter it.
struct Waiting {
  std::uint32_t node;   // number of a wide node, or of its first sphere
  std::uint32_t count;  // spheres; 0: a node
  float w_near;
};

HWY_INLINE Waiting child_of(const WideNode& node, int slot, float w_near) {
  if (!node.is_leaf(slot)) return {static_cast<std::uint32_t>(node.child_node(slot)), 0, w_near};
  return {static_cast<std::uint32_t>(node.sphere_begin(slot)), static_cast<std::uint32_t>(node.sphere_count(slot)),
          w_near};
}

// Radii of all, where there is only one; otherwise loaded.
HWY_INLINE hn::VFromD<FloatTag> radii_at(const WideSpheres& spheres, std::int64_t slot) {
  if (spheres.has_palette && spheres.palette_size == 1) return hn::Set(FloatTag(), spheres.palette[0]);
  return load_radii(spheres, slot);
}

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

/// One block, set up in `rays`, whose hits are written. Where spheres are small to the beam, kInParts lets each meet
/// only those runs of kPartRays rays in whose own frustum it lies.
template <bool kCommonOrigin, bool kLeaves, bool kInParts>
class ClosestBeam {
 public:
  ClosestBeam(const WideTree& tree, BeamRays& rays, Frustum& frustum, const RaySpan& span, std::int64_t first_ray,
              const HitSpan& hits, Winners& winners, Rivals& rivals)
      : tree_(tree),
        rays_(rays),
        frustum_(frustum),
        span_(span),
        first_ray_(first_ray),
        hits_(hits),
        winners_(winners),
        rivals_(rivals) {}

  HWY_INLINE void run() {
    winners_.clear();
    for (int lane = 0; lane < kBeamRays; lane += kFloatLanes)
      hn::Store(hn::Set(WordTag(), kNoWinner), WordTag(), rays_.winner + lane);
    // A run that meets nothing ends before it begins.
    if (kInParts)
      for (int i = 0; i < kParts; ++i)
        if (!make_frustum<kPartRays>(tree_, rays_, i * kPartRays, parts_[i])) parts_[i].w_end = -2 * kFarthestEnd;
    walk();
    if (kInParts && !spheres_.empty()) meet_waiting();
    write();
  }

 private:
  HWY_INLINE void walk() {
    // Each level leaves at most fifteen children waiting.
    beam::Waiting waiting[kMostLevels * kWidth];
    int waiting_count = 0;
    waiting[waiting_count++] = {0, 0, frustum_.w_begin};
    alignas(64) float w_near[kWidth];
    while (waiting_count > 0) {
      const beam::Waiting top = waiting[--waiting_count];
      if (top.w_near > frustum_.w_end) continue;
      if (top.count != 0) {
        meet_leaf(top.node, top.count);
        continue;
      }

      // Let the children that rays may enter wait, the nearest on top.
      const WideNode& node = tree_.nodes[top.node];
      const std::uint32_t bits = boxes_in(node, frustum_, w_near);
      if (bits == 0) continue;
      std::uint64_t order = 0;
      for (std::uint32_t places = near_to_far(node, frustum_.octant, bits, order); places != 0;) {
        const int place = 31 - __builtin_clz(places);
        places ^= 1U << place;
        const int slot = static_cast<int>(order >> (4 * place) & 15);
        waiting[waiting_count++] = beam::child_of(node, slot, w_near[slot]);
      }
    }
  }

  void meet_leaf(std::int64_t begin, std::int64_t count) {
    const FloatTag d;
    bool won = false;
    for (std::int64_t first = 0; first < count; first += kFloatLanes) {
      const std::int64_t slot = begin + first;
      const hn::VFromD<FloatTag> centre[3] = {hn::LoadU(d, tree_.spheres.x + slot),
                                              hn::LoadU(d, tree_.spheres.y + slot),
                                              hn::LoadU(d, tree_.spheres.z + slot)};
      const auto padded = hn::Add(beam::radii_at(tree_.spheres, slot), hn::Set(d, rays_.e));
      auto inside = spheres_in(frustum_, centre, padded);
      if (count - first < kFloatLanes) inside = hn::And(inside, hn::FirstN(d, static_cast<std::size_t>(count - first)));
      std::uint32_t bits = mask_bits(inside);
      if (bits == 0) continue;
      if (kInParts) {
        spheres_.add(slot, centre, padded, inside);
        if (spheres_.enough()) meet_waiting();
        continue;
      }
      store_local(centre);
      alignas(64) float radii[kFloatLanes];
      hn::Store(padded, d, radii);
      for (; bits != 0; bits &= bits - 1) {
        const int k = __builtin_ctz(bits);
        won |= meet_sphere<kBeamRays>(0, candidate(k, static_cast<std::uint32_t>(slot + k), radii[k]));
      }
    }
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
    for (int i = 0; i < kParts; ++i)
      pairs |= std::uint64_t{mask_bits(hn::And(exist, spheres_in(parts_[i], centre, padded)))} << (i * kFloatLanes);
    store_local(centre);
    for (; pairs != 0; pairs &= pairs - 1) {
      const int pair = __builtin_ctzll(pairs);
      const int k = pair % kFloatLanes;
      meet_sphere<kPartRays>(pair / kFloatLanes * kPartRays, candidate(k, spheres_.slot(k), spheres_.padded()[k]));
    }
    float end = -2 * kFarthestEnd;
    for (int i = 0; i < kParts; ++i) {
      parts_[i].w_end = std::min(parts_[i].w_end, beam::end_of<kPartRays>(rays_, i * kPartRays));
      end = std::max(end, parts_[i].w_end);
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
            kLeaves ? static_cast<std::uint32_t>(tree_.spheres.id(slot)) : 0,
            {local_centre_[0][k], local_centre_[1][k], local_centre_[2][k]},
            padded,
            padded * padded};
  }

  // kRays rays from lane `begin` on against one sphere, run after run: what one vector needs does not wait for the
  // other, and the only branch is whether any of the run comes near. True if a winner changed.
  template <int kRays>
  HWY_INLINE bool meet_sphere(int begin, const beam::Candidate& sphere) {
    const FloatTag d;
    make_room();
    const beam::RootBounds bounds(rays_, sphere);
    const auto number = hn::Set(WordTag(), winners_.next());
    std::uint32_t won = 0;
    for (int run = begin; run < begin + kRays; run += kPartRays) {
      beam::Meeting met[kPartVectors];
      auto largest = hn::Set(d, -1.0F);
      for (int v = 0; v < kPartVectors; ++v) {
        met[v] = beam::meet<kCommonOrigin>(rays_, sphere, run + v * kFloatLanes);
        largest = hn::Max(largest, met[v].dp);
      }
      // A sphere in a run's own frustum nearly always does.
      if (kRays > kPartRays && hn::AllTrue(d, hn::Lt(largest, hn::Zero(d)))) continue;
      std::uint32_t doubts = 0;
      for (int v = 0; v < kPartVectors; ++v) {
        const int lane = run + v * kFloatLanes;
        const auto near = beam::near_enough<kLeaves>(rays_, sphere, met[v], lane);
        const auto best = hn::Load(d, rays_.s_best + lane);
        const auto sure_end = hn::Load(d, rays_.s_sure + lane);
        const beam::Roots roots = bounds.of(met[v], near, best, sure_end);
        hn::Store(hn::IfThenElse(roots.sure, roots.upper, best), d, rays_.s_best + lane);
        hn::Store(hn::IfThenElse(roots.sure, roots.lower, sure_end), d, rays_.s_sure + lane);
        const auto others = hn::Load(WordTag(), rays_.winner + lane);
        const auto wins = hn::RebindMask(WordTag(), roots.sure);
        hn::Store(hn::IfThenElse(wins, number, others), WordTag(), rays_.winner + lane);
        won |= mask_bits(roots.sure);
        doubts |= mask_bits(hn::AndNot(roots.sure, roots.candidate)) << (v * kFloatLanes);
      }
      for (; HWY_UNLIKELY(doubts != 0); doubts &= doubts - 1) {
        const int ray = run + __builtin_ctz(doubts);
        if (ray < rays_.count) rivals_.add(first_ray_ + ray, sphere.slot);
      }
    }
    winners_.add_if(won != 0, tree_.spheres, sphere.slot);
    return won != 0;
  }

  // For what one sphere may add.
  HWY_INLINE void make_room() {
    if (HWY_UNLIKELY(rivals_.full())) {
      if (!flushed_) write_misses(hits_, first_ray_, rays_.count);
      flushed_ = true;
      rivals_.flush();
    }
    winners_.make_room(rays_);
  }

  HWY_INLINE void write() {
    if (winners_.none() && !flushed_) return write_misses(hits_, first_ray_, rays_.count);
    if (HWY_LIKELY(!flushed_)) return write_winners(tree_, span_, first_ray_, rays_, winners_, hits_);
    // Rivals have been decided already: the winners must be nearer.
    for (int i = 0; i < rays_.count; ++i) {
      if (rays_.winner[i] == kNoWinner) continue;
      if (rivals_.full()) rivals_.flush();
      rivals_.add(first_ray_ + i, winners_.slot(rays_.winner[i]));
    }
  }

  const WideTree& tree_;
  BeamRays& rays_;
  Frustum& frustum_;
  const RaySpan& span_;
  const std::int64_t first_ray_;
  const HitSpan& hits_;
  Winners& winners_;
  Rivals& rivals_;
  bool flushed_ = false;                            // rivals were decided before all were found
  alignas(64) float local_centre_[3][kFloatLanes];  // NOLINT: written before read
  Frustum parts_[kParts];
  WaitingSpheres spheres_;
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_CLOSEST_BEAM_INL_H_
