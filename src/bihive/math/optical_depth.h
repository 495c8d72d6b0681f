// Optical depth in fixed point: what several layers let through is the sum of their depths, and a sum of integers does
// not depend on the order of the layers.
#pragma once

#include <algorithm>
#include <cstdint>

namespace bihive {

/// In units of 2^-22 halvings of the light.
using OpticalDepth = std::uint32_t;

/// Of one layer at most: 64 halvings.
constexpr OpticalDepth kDeepestLayer = OpticalDepth{64} << 22;
/// Of all layers together at most: 256 halvings, where a sum stays.
constexpr OpticalDepth kDeepest = OpticalDepth{256} << 22;

/// The depth of a layer that lets this share through, 0 to 1; 0 of 1. transmittance() gives the share back to 9e-8,
/// relatively, from 2^-64 up.
OpticalDepth optical_depth(double share);

/// The share that gets through, 2^(-depth / 2^22), to 1e-14 relatively; 1 of depth 0.
double transmittance(OpticalDepth depth);

/// Of two bodies, one behind the other, neither deeper than kDeepest.
inline OpticalDepth sum_of_depths(OpticalDepth a, OpticalDepth b) {
  return std::min(a + b, kDeepest);
}

}  // namespace bihive
