// One sphere against neighbouring rays of a beam: how they lie to it, and bounds of the near root.

#if defined(BIHIVE_WIDE_TRACE_BEAM_SPHERES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_BEAM_SPHERES_INL_H_
#undef BIHIVE_WIDE_TRACE_BEAM_SPHERES_INL_H_
#else
#define BIHIVE_WIDE_TRACE_BEAM_SPHERES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/trace/beam_bounds.h"
#include "bihive/wide/trace/beam_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A block is also taken in runs of this many neighbours.
constexpr int kPartRays = 16;
constexpr int kParts = kBeamRays / kPartRays;
constexpr int kPartVectors = kPartRays / kFloatLanes;
static_assert(kParts * kPartRays == kBeamRays && kPartVectors * kFloatLanes == kPartRays);

namespace beam {

/// One sphere, ready to meet the rays.
struct Candidate {
  std::uint32_t slot;
  std::uint32_t id;
  float centre[3];  ///< with kCommonOrigin from there
  float padded;     ///< r + e
  float padded_squared;
};

/// How rays lie to a sphere, in units of distance along them.
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

/// The rays of a vector that come near enough to a sphere to hit it. With kLeaves the one that a ray leaves is none.
template <bool kLeaves>
HWY_INLINE hn::Mask<FloatTag> near_enough(const BeamRays& rays, const Candidate& sphere, const Meeting& m, int lane) {
  const FloatTag d;
  const auto near = hn::Ge(m.dp, hn::Zero(d));
  if constexpr (!kLeaves) return near;
  const auto own = hn::Eq(hn::Load(WordTag(), rays.leaves + lane), hn::Set(WordTag(), sphere.id));
  return hn::AndNot(hn::RebindMask(d, own), near);
}

/// Where the near roots lie: from `lower` to `upper`.
struct Roots {
  hn::VFromD<FloatTag> lower, upper;
  hn::Mask<FloatTag> candidate;  ///< may be a hit before `best`
  hn::Mask<FloatTag> sure;       ///< is one, and before `sure_end`
};

/// Of a sphere and the rays of a beam, by the bounds of wide/trace/beam_bounds.h.
class RootBounds {
 public:
  HWY_INLINE RootBounds(const BeamRays& rays, const Candidate& sphere)
      : e_(rays.e), sure_above_(kSureShare * rays.e * sphere.padded), spread_(kWidthShare * rays.e * sphere.padded) {}

  template <class V, class M>
  HWY_INLINE Roots of(const Meeting& m, M near, V best, V sure_end) const {
    const FloatTag d;
    const auto zero = hn::Zero(d);
    const auto e = hn::Set(d, e_);
    const auto chord = hn::Sqrt(hn::Max(m.dp, zero));
    Roots roots;
    roots.lower = hn::Sub(hn::Sub(m.b, e), chord);
    const auto far_upper = hn::Add(hn::Add(m.b, e), chord);
    roots.candidate = hn::And(near, hn::And(hn::Le(roots.lower, best), hn::Ge(far_upper, zero)));
    const auto width = hn::MulAdd(hn::Set(d, spread_), hn::ApproximateReciprocalSqrt(m.dp), hn::Add(e, e));
    roots.upper = hn::Add(roots.lower, width);
    roots.sure = hn::And(hn::And(roots.candidate, hn::Gt(m.dp, hn::Set(d, sure_above_))),
                         hn::And(hn::Gt(roots.lower, zero), hn::Lt(roots.upper, sure_end)));
    return roots;
  }

 private:
  float e_, sure_above_, spread_;
};

}  // namespace beam

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_BEAM_SPHERES_INL_H_
