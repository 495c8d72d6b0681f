// One sphere against neighbouring rays of a beam: which come near to it, and bounds of the near root.

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
#include "bihive/wide/trace/sphere_filter-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A block is also taken in runs of this many neighbours.
constexpr int kRunRays = 16;
constexpr int kRuns = kBeamRays / kRunRays;
constexpr int kRunVectors = kRunRays / kFloatLanes;
static_assert(kRuns * kRunRays == kBeamRays && kRunVectors * kFloatLanes == kRunRays);

namespace beam {

/// One sphere, ready to meet the rays.
struct Candidate {
  std::uint32_t slot;
  std::uint32_t id;
  float centre[3];  ///< with kCommonOrigin from there
  float padded;     ///< r + e
  float padded_squared;
};

/// The position of the rays from `lane` on relative to a sphere.
template <bool kCommonOrigin>
HWY_INLINE Meeting meet_rays(const BeamRays& rays, const Candidate& sphere, int lane) {
  const FloatTag d;
  auto cx = hn::Set(d, sphere.centre[0]);
  auto cy = hn::Set(d, sphere.centre[1]);
  auto cz = hn::Set(d, sphere.centre[2]);
  if (!kCommonOrigin) {
    cx = hn::Sub(cx, hn::Load(d, rays.origin[0] + lane));
    cy = hn::Sub(cy, hn::Load(d, rays.origin[1] + lane));
    cz = hn::Sub(cz, hn::Load(d, rays.origin[2] + lane));
  }
  return meet(cx, cy, cz, hn::Load(d, rays.direction[0] + lane), hn::Load(d, rays.direction[1] + lane),
              hn::Load(d, rays.direction[2] + lane), hn::Set(d, sphere.padded_squared));
}

/// The rays of a vector that come near enough to a sphere to hit it. With kSkipOwn a ray does not hit the sphere that
/// it exits.
template <bool kSkipOwn>
HWY_INLINE FloatMask near_enough(const BeamRays& rays, const Candidate& sphere, const Meeting& m, int lane) {
  const FloatTag d;
  const auto near = hn::Ge(m.dp, hn::Zero(d));
  if constexpr (!kSkipOwn) return near;
  const auto own = hn::Eq(hn::Load(WordTag(), rays.left_id + lane), hn::Set(WordTag(), sphere.id));
  return hn::AndNot(hn::RebindMask(d, own), near);
}

/// Bounds of the near roots: `lower` to `upper`.
struct Roots {
  Floats lower, upper;
  FloatMask candidate;  ///< may be a hit before `best`
  FloatMask sure;       ///< is one, and before `sure_end`
};

/// Bounds the roots of one sphere and the rays of a beam (wide/trace/beam_bounds.h).
class RootBounds {
 public:
  HWY_INLINE RootBounds(const BeamRays& rays, const Candidate& sphere)
      : e_(rays.e), sure_above_(kSureShare * rays.e * sphere.padded), spread_(kWidthShare * rays.e * sphere.padded) {}

  /// With kFarToo a far root that surely lies before sure_end makes a hit sure as well: if the near root lies in the
  /// segment, it is the hit, and else the ray starts inside.
  template <bool kFarToo = false>
  HWY_INLINE Roots of(const Meeting& m, FloatMask near, Floats best, Floats sure_end) const {
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
    auto in_segment = hn::And(hn::Gt(roots.lower, zero), hn::Lt(roots.upper, sure_end));
    if constexpr (kFarToo)
      in_segment = hn::Or(in_segment, hn::And(hn::Gt(hn::Sub(far_upper, width), zero), hn::Lt(far_upper, sure_end)));
    roots.sure = hn::And(hn::And(roots.candidate, hn::Gt(m.dp, hn::Set(d, sure_above_))), in_segment);
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
