// From linear radiance to the bytes of a picture.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>

#include "bihive/math/vec3.h"

namespace bihive {

/// srgb: the sRGB curve [IEC61966-2-1]. none: the value as it is.
enum class Transfer { srgb, none };

/// The sRGB curve and its inverse on [0, 1], built on the library's own pow (same bits everywhere).
double srgb_from_linear(double linear);
double linear_from_srgb(double srgb);

/// Clamps to [0, 1] (NaN gives 0), applies the curve, and rounds to the nearest of 0 ... 255.
std::uint8_t byte_from_radiance(double radiance, Transfer transfer);

/// byte_from_radiance() without a curve for `count` numbers, on vectors.
void bytes_from_radiance(const float* radiance, std::int64_t count, std::uint8_t* bytes);

/// byte_from_radiance() for numbers of binary32, some hundred times faster on the sRGB curve.
class ByteTable {
 public:
  explicit ByteTable(Transfer transfer);

  std::uint8_t operator()(float radiance) const {
    if (!(radiance >= least_[1])) return 0;
    if (radiance >= 1) return 255;
    // The bucket's least byte, plus one for each byte that begins at or below the radiance.
    unsigned byte = first_[bucket_of(radiance)];
    while (radiance >= least_[byte + 1]) ++byte;
    return static_cast<std::uint8_t>(byte);
  }

 private:
  // Binary32 numbers from 2^-13 to below 1 by exponent and the first six bits behind the point.
  static constexpr unsigned kFirstBucket = (127 - 13) << 6;
  static constexpr unsigned kBuckets = 13 << 6;
  static unsigned bucket_of(float radiance) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &radiance, sizeof(bits));
    return (bits >> 17) - kFirstBucket;
  }

  std::array<float, 257> least_;  // the least radiance of each byte; beyond 255 infinity
  std::array<std::uint8_t, kBuckets> first_;
};

}  // namespace bihive
