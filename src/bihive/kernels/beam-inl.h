// The closest hits of a block of 64 neighbouring rays: its frustum against sixteen boxes or spheres at a time, and the
// spheres that lie in it against all rays.

#if defined(BIHIVE_KERNELS_BEAM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_KERNELS_BEAM_INL_H_
#undef BIHIVE_KERNELS_BEAM_INL_H_
#else
#define BIHIVE_KERNELS_BEAM_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "bihive/kernels/beam_rays-inl.h"
#include "bihive/kernels/frustum-inl.h"
#include "bihive/kernels/lanes-inl.h"
#include "bihive/kernels/rivals-inl.h"
#include "bihive/kernels/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A block is also taken in runs of this many neighbours.
constexpr int kPartRays = 16;
static_assert(kBeamRays == 4 * kPartRays);

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

// One sphere, ready to meet the rays.
struct Candidate {
  std::uint32_t slot;
  std::uint32_t id;
  float centre[3];
  float padded;  // r + e
  float padded_squared;
};

// How rays lie to a sphere, in units of distance along them.
struct Meeting {
  hn::VFromD<FloatTag> b, dp;
};

template <bool kCommonOrigin>
HWY_INLINE Meeting meet(const BeamRays& rays, const Candidate& sphere, int lane) {
  const FloatTag d;
  auto cx = hn::Set(d, sphere.centre[0]);
  auto cy = hn::Set(d, sphere.centre[1]);
  auto cz = hn::Set(d, sphere.centre[2]);
  if (!kCommonOrigin) {
    cx = hn::Sub(cx, hn::Load(d, rays.origin[0] + lane));
    cy = hn::Sub(cy, hn::Load(d, rays.origin[1] + lane));
    cz = hn::Sub(cz, hn::Load(d, rays.origin[2] + lane));
  }
  const auto nx = hn::Load(d, rays.direction[0] + lane);
  const auto ny = hn::Load(d, rays.direction[1] + lane);
  const auto nz = hn::Load(d, rays.direction[2] + lane);
  const auto b = hn::MulAdd(cz, nz, hn::MulAdd(cy, ny, hn::Mul(cx, nx)));
  const auto px = hn::NegMulAdd(b, nx, cx);
  const auto py = hn::NegMulAdd(b, ny, cy);
  const auto pz = hn::NegMulAdd(b, nz, cz);
  const auto pp = hn::MulAdd(pz, pz, hn::MulAdd(py, py, hn::Mul(px, px)));
  return {b, hn::Sub(hn::Set(d, sphere.padded_squared), pp)};
}

// kRays rays from lane `begin` on against one sphere. True if a winner changed.
template <bool kCommonOrigin, bool kLeaves, int kRays>
HWY_INLINE bool meet_sphere(BeamRays& rays, int begin, std::int64_t first_ray, const Candidate& sphere,
                            const WideSpheres& spheres, Winners& winners, Rivals& rivals) {
  const FloatTag d;
  const auto zero = hn::Zero(d);
  const auto e = hn::Set(d, rays.e);
  const auto sure_above = hn::Set(d, kSureShare * rays.e * sphere.padded);
  const auto spread = hn::Set(d, kWidthShare * rays.e * sphere.padded);
  const auto number = hn::Set(WordTag(), winners.next());
  std::uint32_t won = 0;
  for (int lane = begin; lane < begin + kRays; lane += kFloatLanes) {
    const Meeting m = meet<kCommonOrigin>(rays, sphere, lane);
    auto near_enough = hn::Ge(m.dp, zero);
    if (kLeaves) {
      const auto own = hn::Eq(hn::Load(WordTag(), rays.leaves + lane), hn::Set(WordTag(), sphere.id));
      near_enough = hn::AndNot(hn::RebindMask(d, own), near_enough);
    }
    if (hn::AllFalse(d, near_enough)) continue;

    // Bounds of the roots.
    const auto chord = hn::Sqrt(hn::Max(m.dp, zero));
    const auto lower = hn::Sub(hn::Sub(m.b, e), chord);
    const auto far_upper = hn::Add(hn::Add(m.b, e), chord);
    const auto best = hn::Load(d, rays.s_best + lane);
    const auto candidate = hn::And(near_enough, hn::And(hn::Le(lower, best), hn::Ge(far_upper, zero)));
    const auto width = hn::MulAdd(spread, hn::ApproximateReciprocalSqrt(m.dp), hn::Add(e, e));
    const auto upper = hn::Add(lower, width);
    const auto sure_end = hn::Load(d, rays.s_sure + lane);
    const auto winner =
        hn::And(hn::And(candidate, hn::Gt(m.dp, sure_above)), hn::And(hn::Gt(lower, zero), hn::Lt(upper, sure_end)));
    hn::Store(hn::IfThenElse(winner, upper, best), d, rays.s_best + lane);
    hn::Store(hn::IfThenElse(winner, lower, sure_end), d, rays.s_sure + lane);
    const auto others = hn::Load(WordTag(), rays.winner + lane);
    hn::Store(hn::IfThenElse(hn::RebindMask(WordTag(), winner), number, others), WordTag(), rays.winner + lane);
    won |= mask_bits(winner);
    for (std::uint32_t bits = mask_bits(hn::AndNot(winner, candidate)); bits != 0; bits &= bits - 1) {
      const int ray = lane + __builtin_ctz(bits);
      if (ray < rays.count) rivals.add(first_ray + ray, sphere.slot);
    }
  }
  if (won == 0) return false;
  winners.add(spheres, sphere.slot);
  return true;
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

/// One block, set up in `rays`, whose hits are written. Where spheres are small to the beam, kParts lets each meet only
/// those runs of kPartRays rays in whose own frustum it lies.
template <bool kCommonOrigin, bool kLeaves, bool kParts>
HWY_INLINE void closest_hits_in_beam(const WideTree& tree, BeamRays& rays, Frustum& frustum, const RaySpan& span,
                                     std::int64_t first_ray, const HitSpan& hits, Winners& winners, Rivals& rivals) {
  const FloatTag d;
  winners.clear();
  const auto e = hn::Set(d, rays.e);
  for (int lane = 0; lane < kBeamRays; lane += kFloatLanes)
    hn::Store(hn::Set(WordTag(), kNoWinner), WordTag(), rays.winner + lane);
  bool flushed = false;

  // Frustums of the runs. One that meets nothing ends before it begins.
  Frustum parts[kBeamRays / kPartRays];
  if (kParts)
    for (int i = 0; i < kBeamRays / kPartRays; ++i)
      if (!make_frustum<kPartRays>(tree, rays, i * kPartRays, parts[i])) parts[i].w_end = -2 * kFarthestEnd;

  const auto make_room = [&]() HWY_ATTR {
    if (HWY_UNLIKELY(rivals.full())) {
      if (!flushed) write_misses(hits, first_ray, rays.count);
      flushed = true;
      rivals.flush();
    }
    winners.make_room(rays);
  };

  const auto meet_leaf = [&](std::int64_t begin, std::int64_t count) HWY_ATTR {
    bool won = false;
    for (std::int64_t first = 0; first < count; first += kFloatLanes) {
      const std::int64_t slot = begin + first;
      const hn::VFromD<FloatTag> centre[3] = {hn::LoadU(d, tree.spheres.x + slot), hn::LoadU(d, tree.spheres.y + slot),
                                              hn::LoadU(d, tree.spheres.z + slot)};
      const auto padded = hn::Add(beam::radii_at(tree.spheres, slot), e);
      std::uint32_t bits = spheres_in(frustum, centre, padded);
      if (count - first < kFloatLanes) bits &= (1U << (count - first)) - 1;
      if (bits == 0) continue;
      alignas(64) float centres[3][kFloatLanes];
      alignas(64) float radii[kFloatLanes];
      for (int axis = 0; axis < 3; ++axis) {
        auto c = centre[axis];
        if (kCommonOrigin) c = hn::Sub(c, hn::Set(d, rays.origin[axis][0]));
        hn::Store(c, d, centres[axis]);
      }
      hn::Store(padded, d, radii);
      const auto sphere_at = [&](int k) HWY_ATTR {
        return beam::Candidate{static_cast<std::uint32_t>(slot + k),
                               kLeaves ? static_cast<std::uint32_t>(tree.spheres.id(slot + k)) : 0,
                               {centres[0][k], centres[1][k], centres[2][k]},
                               radii[k],
                               radii[k] * radii[k]};
      };
      if (kParts) {
        for (int i = 0; i < kBeamRays / kPartRays; ++i) {
          bool part_won = false;
          for (std::uint32_t left = bits & spheres_in(parts[i], centre, padded); left != 0; left &= left - 1) {
            make_room();
            part_won |= beam::meet_sphere<kCommonOrigin, kLeaves, kPartRays>(
                rays, i * kPartRays, first_ray, sphere_at(__builtin_ctz(left)), tree.spheres, winners, rivals);
          }
          if (part_won) parts[i].w_end = std::min(parts[i].w_end, beam::end_of<kPartRays>(rays, i * kPartRays));
          won |= part_won;
        }
        continue;
      }
      for (; bits != 0; bits &= bits - 1) {
        make_room();
        won |= beam::meet_sphere<kCommonOrigin, kLeaves, kBeamRays>(rays, 0, first_ray, sphere_at(__builtin_ctz(bits)),
                                                                    tree.spheres, winners, rivals);
      }
    }
    if (!won) return;
    if (kParts) {
      frustum.w_end = std::max(std::max(parts[0].w_end, parts[1].w_end), std::max(parts[2].w_end, parts[3].w_end));
    } else {
      frustum.w_end = std::min(frustum.w_end, beam::end_of<kBeamRays>(rays, 0));
    }
  };

  // Each level leaves at most fifteen children waiting.
  beam::Waiting waiting[kMostLevels * kWidth];
  int waiting_count = 0;
  waiting[waiting_count++] = {0, 0, frustum.w_begin};
  alignas(64) float w_near[kWidth];
  while (waiting_count > 0) {
    const beam::Waiting top = waiting[--waiting_count];
    if (top.w_near > frustum.w_end) continue;
    if (top.count != 0) {
      meet_leaf(top.node, top.count);
      continue;
    }

    // Let the children that rays may enter wait, the nearest on top.
    const WideNode& node = tree.nodes[top.node];
    const std::uint32_t bits = boxes_in(node, frustum, w_near);
    if (bits == 0) continue;
    std::uint64_t order = 0;
    for (std::uint32_t places = near_to_far(node, frustum.octant, bits, order); places != 0;) {
      const int place = 31 - __builtin_clz(places);
      places ^= 1U << place;
      const int slot = static_cast<int>(order >> (4 * place) & 15);
      waiting[waiting_count++] = beam::child_of(node, slot, w_near[slot]);
    }
  }

  if (winners.none() && !flushed) {
    write_misses(hits, first_ray, rays.count);
    return;
  }
  if (HWY_LIKELY(!flushed)) {
    write_winners(tree, span, first_ray, rays, winners, hits);
    return;
  }
  // Rivals have been decided already: the winners must be nearer.
  for (int i = 0; i < rays.count; ++i) {
    if (rays.winner[i] == kNoWinner) continue;
    if (rivals.full()) rivals.flush();
    rivals.add(first_ray + i, winners.slot(rays.winner[i]));
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_KERNELS_BEAM_INL_H_
