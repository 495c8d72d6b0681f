// Numbers of the shape that most text files have, fast and with the bits of parse_double().
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace bihive {

/// Takes decimal digits, behind those before them: digits * 10^(their number) + their value, modulo 2^64. Returns their
/// number.
inline std::int64_t take_digits(const char*& at, const char* end, std::uint64_t& digits) {
  const char* const first = at;
  // Eight bytes at a time.
  while (std::endian::native == std::endian::little && end - at >= 8) {
    constexpr std::uint64_t kPowers[] = {1, 10, 100, 1000, 10000, 100000, 1000000, 10000000, 100000000};
    std::uint64_t bytes = 0;
    std::memcpy(&bytes, at, sizeof bytes);
    bytes ^= 0x3030303030303030;  // a digit becomes its value
    const std::uint64_t others = (bytes | (bytes + 0x7676767676767676)) & 0x8080808080808080;
    const int count = others == 0 ? 8 : std::countr_zero(others) / 8;
    if (count == 0) return at - first;
    // Zeros before the digits, then pairs, fours and eight of them.
    bytes <<= 8 * (8 - count);
    bytes = 10 * bytes + (bytes >> 8);
    constexpr std::uint64_t kPairs = 0x000000FF000000FF;
    const std::uint64_t value =
        ((bytes & kPairs) * 0x000F424000000064 + ((bytes >> 16) & kPairs) * 0x0000271000000001) >> 32;
    digits = digits * kPowers[count] + value;
    at += count;
    if (count < 8) return at - first;
  }
  for (; at != end; ++at) {
    const auto digit = static_cast<unsigned char>(*at - '0');
    if (digit > 9) break;
    digits = 10 * digits + digit;
  }
  return at - first;
}

/// Takes a number [-]digits[.digits] from the text at `at`, if its digits without the point are a whole number up to
/// 2^53: then it and the power of ten are exact in binary64, so that their quotient is rounded once. False, and `at`
/// stays, for all others; parse_double() reads those.
inline bool take_plain_number(const char*& at, const char* end, double& value) {
  constexpr double kPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8, 1e9,
                                1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18};
  constexpr std::int64_t kMostDigits = 18;  // they fit 64 bits
  const char* p = at;
  const bool negative = p != end && *p == '-';
  if (negative) ++p;
  std::uint64_t digits = 0;  // wraps beyond kMostDigits, and is not used then
  std::int64_t count = take_digits(p, end, digits), decimals = 0;
  if (p != end && *p == '.') {
    ++p;
    decimals = take_digits(p, end, digits);
    count += decimals;
  }
  if (count == 0 || count > kMostDigits || digits > (std::uint64_t{1} << 53)) return false;
  const double size = static_cast<double>(digits) / kPowers[decimals];
  value = negative ? -size : size;
  at = p;
  return true;
}

}  // namespace bihive
