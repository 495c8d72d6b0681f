// Powers of two, without a call of the C library.
#pragma once

#include <cstdint>
#include <cstring>

namespace bihive {

/// 2^exponent, for the exponents of normal numbers: -1022 to 1023.
inline double power_of_two(int exponent) {
  const std::uint64_t bits = static_cast<std::uint64_t>(1023 + exponent) << 52;
  double power = 0;
  std::memcpy(&power, &bits, sizeof power);
  return power;
}

}  // namespace bihive
