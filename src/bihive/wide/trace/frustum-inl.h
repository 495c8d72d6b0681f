// A beam's frustum, which encloses the segments of its rays, and its tests against boxes and spheres.

#if defined(BIHIVE_WIDE_TRACE_FRUSTUM_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_FRUSTUM_INL_H_
#undef BIHIVE_WIDE_TRACE_FRUSTUM_INL_H_
#else
#define BIHIVE_WIDE_TRACE_FRUSTUM_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/trace/beam_rays-inl.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// In the coordinate w = sign * (coordinate along the major axis) all rays ascend. The beam lies between w_begin and
/// w_end and, along each minor axis i, between the planes i = limit + slope * w of `low` and `high`. Everything is
/// outward by the rays' `pad`.
struct Frustum {
  struct Side {
    float limit;
    float slope;  ///< times sign: to be multiplied with coordinates along the major axis itself
    float norm;   ///< sqrt(1 + slope^2), rounded up
    int corner;   ///< offset in a node's boxes of the bound along the major axis that is farther inside the plane
  };
  int major, minor[2];
  float sign;
  Side low[2], high[2];
  float w_begin, w_end;  ///< w_end comes nearer as hits are found
  int octant;            ///< of the direction in the middle, as WideNode::order numbers them
  float width;           ///< the larger extent across, where the beam is widest inside the set's bounds
};

namespace frustum {

HWY_INLINE float largest(hn::VFromD<FloatTag> v) {
  return hn::GetLane(hn::MaxOfLanes(FloatTag(), v));
}
HWY_INLINE float smallest(hn::VFromD<FloatTag> v) {
  return hn::GetLane(hn::MinOfLanes(FloatTag(), v));
}

// No coordinate of a ray comes near to it.
constexpr float kFarUp = 1e30F;

// Sets w_begin and w_end: between the first start and the last end, inside the set's bounds.
template <int kRays>
HWY_INLINE void bound_along(const WideTree& tree, const BeamRays& rays, int begin, Frustum& out) {
  const FloatTag d;
  const int major = rays.major;
  const auto sign = hn::Set(d, rays.sign);
  const auto far_up = hn::Set(d, kFarUp);
  auto start = far_up;
  auto end = hn::Neg(far_up);
  for (int lane = begin; lane < begin + kRays; lane += kFloatLanes) {
    const auto o = hn::Mul(sign, hn::Load(d, rays.origin[major] + lane));
    const auto n = hn::Mul(sign, hn::Load(d, rays.direction[major] + lane));
    const auto best = hn::Load(d, rays.s_best + lane);
    start = hn::Min(start, hn::IfThenElse(hn::Ge(best, hn::Zero(d)), o, far_up));
    end = hn::Max(end, hn::MulAdd(n, best, o));
  }
  const float lo = tree.aabb.lo[major];
  const float hi = tree.aabb.hi[major];
  out.w_begin = std::max(smallest(start), rays.sign > 0 ? lo : -hi) - rays.pad;
  out.w_end = std::min(largest(end), rays.sign > 0 ? hi : -lo) + rays.pad;
}

// The least and the largest position of any ray along an axis, at the beam's begin and end.
struct Across {
  float low_begin, low_end, high_begin, high_end;
};

template <int kRays>
HWY_INLINE Across bound_across(const BeamRays& rays, int begin, const Frustum& beam, int axis) {
  const FloatTag d;
  const auto sign = hn::Set(d, rays.sign);
  const auto far_up = hn::Set(d, kFarUp);
  const auto far_down = hn::Neg(far_up);
  const auto w0 = hn::Set(d, beam.w_begin);
  const auto w1 = hn::Set(d, beam.w_end);
  auto low0 = far_up;
  auto low1 = far_up;
  auto high0 = far_down;
  auto high1 = far_down;
  for (int lane = begin; lane < begin + kRays; lane += kFloatLanes) {
    const auto ow = hn::Mul(sign, hn::Load(d, rays.origin[rays.major] + lane));
    const auto nw = hn::Mul(sign, hn::Load(d, rays.direction[rays.major] + lane));
    const auto o = hn::Load(d, rays.origin[axis] + lane);
    const auto slope = hn::Div(hn::Load(d, rays.direction[axis] + lane), nw);
    const auto at0 = hn::MulAdd(slope, hn::Sub(w0, ow), o);
    const auto at1 = hn::MulAdd(slope, hn::Sub(w1, ow), o);
    const auto counts = hn::Ge(hn::Load(d, rays.s_best + lane), hn::Zero(d));
    low0 = hn::Min(low0, hn::IfThenElse(counts, at0, far_up));
    high0 = hn::Max(high0, hn::IfThenElse(counts, at0, far_down));
    low1 = hn::Min(low1, hn::IfThenElse(counts, at1, far_up));
    high1 = hn::Max(high1, hn::IfThenElse(counts, at1, far_down));
  }
  return {smallest(low0), smallest(low1), largest(high0), largest(high1)};
}

// The plane on one side. Any slope is right, since both ends of the beam lie inside.
HWY_INLINE Frustum::Side side_through(const BeamRays& rays, const Frustum& beam, float at_begin, float at_end,
                                      bool high) {
  const float inverse_length = 1 / std::max(beam.w_end - beam.w_begin, 1e-3F);
  const float slope = std::clamp((at_end - at_begin) * inverse_length, -8.0F, 8.0F);
  const float limit_begin = at_begin - slope * beam.w_begin;
  const float limit_end = at_end - slope * beam.w_end;
  Frustum::Side side;
  side.limit = high ? std::max(limit_begin, limit_end) + rays.pad : std::min(limit_begin, limit_end) - rays.pad;
  side.slope = slope * rays.sign;
  side.norm = std::sqrt(1 + slope * slope) * 1.00001F;
  const bool take_hi = high ? side.slope > 0 : side.slope < 0;
  side.corner = (take_hi ? 3 * kWidth : 0) + rays.major * kWidth;
  return side;
}

}  // namespace frustum

/// Makes the frustum of the kRays rays from lane `begin` on; those that are done (s_best below 0) do not count. False:
/// no ray meets the bounds of the set.
template <int kRays>
HWY_INLINE bool make_frustum(const WideTree& tree, const BeamRays& rays, int begin, Frustum& out) {
  const int major = rays.major;
  out.major = major;
  out.minor[0] = major == 0 ? 1 : 0;
  out.minor[1] = major == 2 ? 1 : 2;
  out.sign = rays.sign;
  frustum::bound_along<kRays>(tree, rays, begin, out);
  if (!(out.w_begin <= out.w_end)) return false;

  out.width = 0;
  out.octant = rays.sign < 0 ? 1 << major : 0;
  for (int k = 0; k < 2; ++k) {
    const int axis = out.minor[k];
    const frustum::Across at = frustum::bound_across<kRays>(rays, begin, out, axis);
    out.width = std::max(out.width, std::max(at.high_begin - at.low_begin, at.high_end - at.low_end));
    if (at.low_end + at.high_end < at.low_begin + at.high_begin) out.octant |= 1 << axis;
    out.low[k] = frustum::side_through(rays, out, at.low_begin, at.low_end, false);
    out.high[k] = frustum::side_through(rays, out, at.high_begin, at.high_end, true);
  }
  return true;
}

/// The children of a node that some ray may enter before w_end: a bit each, with the least w of each to `w_near`.
HWY_INLINE std::uint32_t boxes_in(const WideNode& node, const Frustum& beam, float w_near[kWidth]) {
  const FloatTag d;
  const float* const boxes = node.lo[0];
  const bool up = beam.sign > 0;
  const float* const near_planes = up ? node.lo[beam.major] : node.hi[beam.major];
  const float* const far_planes = up ? node.hi[beam.major] : node.lo[beam.major];
  const auto sign = hn::Set(d, beam.sign);
  std::uint32_t bits = 0;
  for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
    const auto near_w = hn::Mul(sign, hn::Load(d, near_planes + lane));
    const auto far_w = hn::Mul(sign, hn::Load(d, far_planes + lane));
    auto inside = hn::And(hn::Le(near_w, hn::Set(d, beam.w_end)), hn::Ge(far_w, hn::Set(d, beam.w_begin)));
    for (int k = 0; k < 2; ++k) {
      const Frustum::Side& high = beam.high[k];
      const Frustum::Side& low = beam.low[k];
      const auto box_lo = hn::Load(d, node.lo[beam.minor[k]] + lane);
      const auto box_hi = hn::Load(d, node.hi[beam.minor[k]] + lane);
      const auto under = hn::NegMulAdd(hn::Set(d, high.slope), hn::Load(d, boxes + high.corner + lane), box_lo);
      const auto over = hn::NegMulAdd(hn::Set(d, low.slope), hn::Load(d, boxes + low.corner + lane), box_hi);
      inside = hn::And(inside, hn::Le(under, hn::Set(d, high.limit)));
      inside = hn::And(inside, hn::Ge(over, hn::Set(d, low.limit)));
    }
    hn::Store(near_w, d, w_near + lane);
    bits |= mask_bits(inside) << lane;
  }
  return bits;
}

/// Permutes `bits` of a node's slots into the order from near to far, rank 0 the nearest, and returns that order: the
/// slot of rank p is order >> 4 p & 15.
HWY_INLINE std::uint32_t near_to_far(const WideNode& node, int octant, std::uint32_t bits, std::uint64_t& order) {
  const bool backwards = octant >= 4;
  order = node.order[backwards ? 7 - octant : octant];
  if (backwards) {
    // Reverse the sixteen fields, then drop those of slots without a child.
    std::uint64_t x = order;
    x = (x & 0x0F0F0F0F0F0F0F0FU) << 4 | (x >> 4 & 0x0F0F0F0F0F0F0F0FU);
    x = __builtin_bswap64(x);
    order = x >> (4 * (kWidth - node.child_count));
  }
  std::uint32_t places = 0;
  const WordTag w;
  for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
    const auto number = hn::Iota(w, static_cast<std::uint32_t>(lane));
    const auto low_half = hn::Set(w, static_cast<std::uint32_t>(order));
    const auto high_half = hn::Set(w, static_cast<std::uint32_t>(order >> 32));
    const auto half = hn::IfThenElse(hn::Lt(number, hn::Set(w, 8U)), low_half, high_half);
    const auto slot = hn::And(hn::Shr(half, hn::ShiftLeft<2>(hn::And(number, hn::Set(w, 7U)))), hn::Set(w, 15U));
    const auto bit = hn::And(hn::Shr(hn::Set(w, bits), slot), hn::Set(w, 1U));
    places |= mask_bits(hn::RebindMask(FloatTag(), hn::Ne(bit, hn::Zero(w)))) << lane;
  }
  return places & ((1U << node.child_count) - 1);
}

/// Spheres `slot` to slot + kFloatLanes - 1, of padded radii `radius`, that some ray may hit before w_end.
template <class V>
HWY_INLINE hn::Mask<FloatTag> spheres_in(const Frustum& beam, const V centre[3], V radius) {
  const FloatTag d;
  const auto major = centre[beam.major];
  const auto w = hn::Mul(hn::Set(d, beam.sign), major);
  auto inside =
      hn::And(hn::Le(hn::Sub(w, radius), hn::Set(d, beam.w_end)), hn::Ge(hn::Add(w, radius), hn::Set(d, beam.w_begin)));
  for (int k = 0; k < 2; ++k) {
    const Frustum::Side& high = beam.high[k];
    const Frustum::Side& low = beam.low[k];
    const auto c = centre[beam.minor[k]];
    const auto above = hn::NegMulAdd(hn::Set(d, high.slope), major, c);
    const auto below = hn::NegMulAdd(hn::Set(d, low.slope), major, c);
    inside = hn::And(inside, hn::Le(above, hn::MulAdd(radius, hn::Set(d, high.norm), hn::Set(d, high.limit))));
    inside = hn::And(inside, hn::Ge(below, hn::NegMulAdd(radius, hn::Set(d, low.norm), hn::Set(d, low.limit))));
  }
  return inside;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_FRUSTUM_INL_H_
