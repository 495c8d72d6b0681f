// The sphere test in binary32, a vector at a time: it proves that a ray misses a sphere, or bounds where it hits.
// trace/filter_bounds.h and trace/beam_bounds.h derive how far it may be wrong.

#if defined(BIHIVE_WIDE_TRACE_SPHERE_FILTER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_SPHERE_FILTER_INL_H_
#undef BIHIVE_WIDE_TRACE_SPHERE_FILTER_INL_H_
#else
#define BIHIVE_WIDE_TRACE_SPHERE_FILTER_INL_H_
#endif

#include <hwy/highway.h>

#include "bihive/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The position of rays relative to spheres, lane by lane.
struct Meeting {
  Floats b;   ///< distance along the ray to the point nearest to the centre
  Floats dp;  ///< (r + e)^2 - p^2 with p the distance between line and centre; below 0: a certain miss
};

/// `c`: the centre, seen from the ray's origin. `n`: the ray's unit direction. `r_squared`: (r + e)^2.
HWY_INLINE Meeting meet(Floats cx, Floats cy, Floats cz, Floats nx, Floats ny, Floats nz, Floats r_squared) {
  const auto b = hn::MulAdd(cz, nz, hn::MulAdd(cy, ny, hn::Mul(cx, nx)));
  const auto px = hn::NegMulAdd(b, nx, cx);
  const auto py = hn::NegMulAdd(b, ny, cy);
  const auto pz = hn::NegMulAdd(b, nz, cz);
  return {b, hn::NegMulAdd(px, px, hn::NegMulAdd(py, py, hn::NegMulAdd(pz, pz, r_squared)))};
}

/// Second test of the spheres that the first did not exclude: bounds of the root that counts.
struct Judged {
  Floats start;    ///< the root lies here or beyond; if `sure`, by less than W
  FloatMask keep;  ///< may be a hit before s_best
  FloatMask sure;  ///< surely a hit in the segment
};

/// By the bounds of trace/filter_bounds.h. `own`: the ray exits the sphere; `inward`: into it. met.dp >= 0 in all lanes
/// that matter.
HWY_INLINE Judged judge(const Meeting& met, Floats r_squared, Floats s_best, Floats s_min, Floats sure_min,
                        FloatMask own, FloatMask inward, float e, float width) {
  const FloatTag d;
  const auto chord = hn::Sqrt(met.dp);
  const auto lower = hn::Sub(hn::Sub(met.b, in_all(e)), chord);
  const auto upper = hn::Add(hn::Add(met.b, in_all(e)), chord);
  const auto clear =
      hn::Ge(met.dp, hn::MulAdd(in_all(0.04F), r_squared, hn::Mul(in_all(4 * e), hn::Sqrt(hn::Abs(r_squared)))));

  // If the near root surely lies before the segment, or at the ray's start, the far root counts.
  const auto far_root = hn::And(clear, hn::Or(inward, hn::Lt(hn::Add(lower, hn::Set(d, width)), s_min)));
  Judged judged;
  judged.start = hn::IfThenElse(far_root, hn::Sub(upper, hn::Set(d, width)), lower);
  // Going outward, a ray never meets the sphere that it exits.
  judged.keep = hn::AndNot(hn::AndNot(inward, own), hn::And(hn::Le(judged.start, s_best), hn::Ge(upper, s_min)));
  judged.sure = hn::And(hn::And(clear, hn::Ge(judged.start, sure_min)), hn::Or(far_root, hn::Not(inward)));
  return judged;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_SPHERE_FILTER_INL_H_
