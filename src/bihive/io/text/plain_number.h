// Numbers of the shape that most text files have, fast and with the bits of parse_double().
#pragma once

#include <cstdint>

namespace bihive {

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
  std::uint64_t digits = 0;
  const auto take_digits = [&] {
    const char* const first = p;
    for (; p != end; ++p) {
      const auto digit = static_cast<unsigned char>(*p - '0');
      if (digit > 9) break;
      digits = 10 * digits + digit;  // wraps beyond kMostDigits, and is not used then
    }
    return p - first;
  };
  std::int64_t count = take_digits(), decimals = 0;
  if (p != end && *p == '.') {
    ++p;
    decimals = take_digits();
    count += decimals;
  }
  if (count == 0 || count > kMostDigits || digits > (std::uint64_t{1} << 53)) return false;
  const double size = static_cast<double>(digits) / kPowers[decimals];
  value = negative ? -size : size;
  at = p;
  return true;
}

}  // namespace bihive
