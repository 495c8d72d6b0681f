// Error bounds of beams: how far binary32 may be wrong when 64 rays are tested at once.
//
// As wide/trace/filter_bounds.h, whose terms are used here, but for rays that are set up in binary32. u = 2^-24, F =
// max |o_k| + 1 over the rays of a beam, L = sqrt(3) F. Only rays whose origins are within kFarOrigin come here, so
// none is moved, and their local origins are exact (a scaling by a power of two; what falls below 2^-126 is off by
// 2^-150).
//
// Directions: n = d / |d| in binary32. |d|^2 is right to 3 u relative, its root and the reciprocal to u each: the
// length of n is right to 3.5 u, and its direction to u (one product a component). Where |d . d - 1| <= 3 u by a sum
// that is itself right to 2 u, d serves as n: its length is right to 2.5 u, its direction exact.
//   b: u L (oc), 3 u L (products and sums), 3.5 u L + u L (n): 8.5 u L = 14.8 u F.
//   p: across n u L (oc) + u L (b n) + u L (n) + 2.5 u p; along n the error of b, twice that of the length of n, and
//   the
//      product b n: below 13 u L, which counts in its square only. (r + e)^2 adds 1.5 u r.
//   So with e = 26 u F = 15 u L the length of p is right to e ((13 u L)^2 + (3 u L)^2 < e^2), and so is b with the
//   three roundings of sums and roots up to 7 F that follow.
//
// A near root lies at s >= lo = b - e - sqrt(dp), where dp = (r + e)^2 - p . p; dp < 0 is a certain miss. With R = r +
// e,
//   0 <= dp - h^2 <= R^2 - r^2 + (p + e)^2 - p^2 <= 4 e R           (h: the true half chord, p <= R)
// so the root exists if dp > 4 e R, and then sqrt(dp) - h <= 4 e R / sqrt(dp). The near root lies in [lo, hi],
//   hi = lo + 2 e + 4 e R / sqrt(dp),
// and the far root in [up - (hi - lo), up] with up = b + e + sqrt(dp).
// kSureShare and kWidthShare are 4 with room for the approximate reciprocal root (relative error below 2e-3 on every
// target). r = 0 is never sure: dp <= e^2 < kSureShare e R.
//
// Frustum: its planes are i = A + B w, with w the coordinate along the major axis, where n_w >= kLeastMajor, so slopes
// n_i / n_w are at most 5. A ray's position at a given w is wrong by 10 u F (slope 2 u, difference and product 2 u), u
// F for o, and 6 u F for the sum; A and the value of a box corner or centre, a fused product and sum up to 13 F, by 13
// u F each; a hit lies up to 2^-25 + 52 2^-53 F = u F beyond its box. All below kFrustumUnits u F = 64 u F. The same
// holds for w = o_w + n_w s.
//
// Images (WideTree::image): the moved origin is rounded (u L), and the true centre is off by 0.87 u < 0.51 u L. b: 10 u
// L = 17.4 u F and 10.5 u F for what follows; p: 4.6 u L across n, 14.6 u L along it, 15.3 u L = 26.6 u F together. So
// e = 30 u F. The frustum's bound has room for 2 u F more.
#pragma once

#include "bihive/wide/trace/filter_bounds.h"

namespace bihive {

constexpr float kBeamUnits = 26;
constexpr float kBeamUnitsOfImage = 30;
constexpr float kFrustumUnits = 64;
constexpr float kSureShare = 4.1F;
constexpr float kWidthShare = 4.1F;
/// The least component of a unit direction along the beam's major axis.
constexpr float kLeastMajor = 0.2F;

/// For a beam whose local origins have no coordinate beyond `farthest_origin`.
struct BeamBounds {
  float e;
  float pad;  ///< of the frustum's planes

  explicit BeamBounds(float farthest_origin, bool of_image = false) {
    const float reach = (farthest_origin + 1) * 1.0001F;
    e = (of_image ? kBeamUnitsOfImage : kBeamUnits) * kUnit * reach;
    pad = kFrustumUnits * kUnit * reach;
  }
};

}  // namespace bihive
