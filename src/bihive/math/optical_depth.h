// Optical depth in fixed point. The depths of layers add up, and a sum of integers does not depend on their order, so
// the transmittance of many layers has the same bits in every order.
#pragma once

#include <algorithm>
#include <cstdint>

namespace bihive {

/// In units of 2^-22 halvings of the light.
using OpticalDepth = std::uint32_t;

/// The largest depth of one layer: 64 halvings.
constexpr OpticalDepth kDeepestLayer = OpticalDepth{64} << 22;
/// The largest sum: 256 halvings. Sums are clamped to it.
constexpr OpticalDepth kDeepest = OpticalDepth{256} << 22;

/// The depth of a layer with this transmittance, 0 to 1. transmittance() of it differs by at most 9e-8, relatively, for
/// shares of at least 2^-64.
OpticalDepth optical_depth(double share);

/// 2^(-depth / 2^22), with a relative error of at most 1e-14; exactly 1 for depth 0.
double transmittance(OpticalDepth depth);

/// The depth of both, clamped to kDeepest; each is at most kDeepest.
inline OpticalDepth sum_of_depths(OpticalDepth a, OpticalDepth b) {
  return std::min(a + b, kDeepest);
}

}  // namespace bihive
