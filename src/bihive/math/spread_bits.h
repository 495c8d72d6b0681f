// Bits of several coordinates in turn: the order of the Z-curve [Morton1966].
#pragma once

#include <cstdint>

namespace bihive {

/// Two zero bits after each of the lower 21 bits.
constexpr std::uint64_t spread_bits(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001F00000000FFFF;
  bits = (bits | bits << 16) & 0x001F0000FF0000FF;
  bits = (bits | bits << 8) & 0x100F00F00F00F00F;
  bits = (bits | bits << 4) & 0x10C30C30C30C30C3;
  return (bits | bits << 2) & 0x1249249249249249;
}

}  // namespace bihive
