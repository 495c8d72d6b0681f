// Numbers as bytes in either order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace bihive {

/// std::bit_cast, which libc++ 13 lacks.
template <class To, class From>
To same_bits(const From& from) {
  static_assert(sizeof(To) == sizeof(From));
  To to;
  std::memcpy(&to, &from, sizeof(to));
  return to;
}

/// One number type of a file.
struct NumberType {
  char kind = 'f';       ///< f, i (with a sign), u
  std::size_t size = 4;  ///< bytes: f 4 or 8, else 1, 2, 4 or 8
  bool big_endian = false;
};

/// The bits of a number of up to 8 bytes.
inline std::uint64_t bits_at(const char* bytes, std::size_t size, bool big_endian) {
  std::uint64_t bits = 0;
  for (std::size_t i = 0; i < size; ++i)
    bits = bits << 8 | static_cast<unsigned char>(bytes[big_endian ? i : size - 1 - i]);
  return bits;
}

/// The number, whose bytes must be there, in binary64; whole numbers beyond 2^53 are rounded.
inline double number_at(const char* bytes, const NumberType& type) {
  const std::uint64_t bits = bits_at(bytes, type.size, type.big_endian);
  if (type.kind == 'f') {
    if (type.size == 8) return same_bits<double>(bits);
    return double(same_bits<float>(static_cast<std::uint32_t>(bits)));
  }
  if (type.kind == 'u') return static_cast<double>(bits);
  // Extend the sign.
  const int unused_bits = static_cast<int>(64 - 8 * type.size);
  return static_cast<double>(static_cast<std::int64_t>(bits << unused_bits) >> unused_bits);
}

}  // namespace bihive
