// Tables for compress(): the position of each lane when those of a mask move to the front.
#pragma once

#include <array>
#include <cstdint>

namespace bihive {

/// Byte k of entry m: the number of the k-th bit that is set in m, 0 past the last.
inline constexpr std::array<std::uint64_t, 256> kCompressPlaces = [] {
  std::array<std::uint64_t, 256> places{};
  for (unsigned mask = 0; mask < 256; ++mask) {
    int k = 0;
    for (unsigned lane = 0; lane < 8; ++lane)
      if ((mask >> lane & 1) != 0) places[mask] |= std::uint64_t{lane} << (8 * k++);
  }
  return places;
}();

/// The same for four lanes, byte by byte: the source of each of the sixteen bytes.
alignas(16) inline constexpr std::array<std::array<std::uint8_t, 16>, 16> kCompressBytes = [] {
  std::array<std::array<std::uint8_t, 16>, 16> bytes{};
  for (unsigned mask = 0; mask < 16; ++mask)
    for (unsigned byte = 0; byte < 16; ++byte)
      bytes[mask][byte] = static_cast<std::uint8_t>((kCompressPlaces[mask] >> (8 * (byte / 4)) & 0xFF) * 4 + byte % 4);
  return bytes;
}();

}  // namespace bihive
