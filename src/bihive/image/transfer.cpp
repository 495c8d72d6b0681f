#include "bihive/image/transfer.h"

#include <cmath>
#include <limits>

#include "bihive/math/elementary.h"

namespace bihive {

double srgb_from_linear(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * portable_pow(linear, 1 / 2.4) - 0.055;
}

double linear_from_srgb(double srgb) {
  return srgb <= 0.04045 ? srgb / 12.92 : portable_pow((srgb + 0.055) / 1.055, 2.4);
}

std::uint8_t byte_from_radiance(double radiance, Transfer transfer) {
  if (!(radiance > 0)) return 0;
  const double clamped = radiance < 1 ? radiance : 1;
  const double displayed = transfer == Transfer::srgb ? srgb_from_linear(clamped) : clamped;
  return static_cast<std::uint8_t>(std::floor(displayed * 255 + 0.5));
}

ByteTable::ByteTable(Transfer transfer) : least_{}, first_{} {
  // Find the first radiance of each byte. Positive numbers are in the order of their bits. From one number of binary32
  // to the next the curve rises by far more than its error, so bytes never fall.
  const auto number = [](std::uint32_t bits) {
    float value = 0;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  };
  constexpr std::uint32_t kOne = 127u << 23;
  for (unsigned byte = 1; byte <= 255; ++byte) {
    std::uint32_t below = 0, at_least = kOne;
    while (at_least - below > 1) {
      const std::uint32_t middle = below + (at_least - below) / 2;
      (byte_from_radiance(double(number(middle)), transfer) >= byte ? at_least : below) = middle;
    }
    least_[byte] = number(at_least);
  }
  least_[256] = std::numeric_limits<float>::infinity();
  for (unsigned bucket = 0; bucket < kBuckets; ++bucket)
    first_[bucket] = byte_from_radiance(double(number((kFirstBucket + bucket) << 17)), transfer);
}

}  // namespace bihive
