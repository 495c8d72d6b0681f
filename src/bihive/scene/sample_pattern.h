// Sample positions in a pixel: a fixed pattern, the same in every pixel and every picture.
#pragma once

#include <cstdint>

namespace bihive {

/// A position in the unit square of a pixel.
struct SamplePlace {
  double x, y;
};

/// Sample i of n: the Hammersley points, moved by half a step so that one sample lies in the pixel's centre and four
/// make a rotated grid. Both coordinates lie in (0, 1).
inline SamplePlace sample_place(int i, int n) {
  double mirrored = 0;
  double digit = 0.5;
  for (auto bits = static_cast<std::uint32_t>(i); bits != 0; bits >>= 1, digit *= 0.5)
    if ((bits & 1u) != 0) mirrored += digit;
  return {(i + 0.5) / n, mirrored + 0.5 / n};
}

}  // namespace bihive
