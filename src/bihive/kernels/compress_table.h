// Where the lanes of a vector go when those of a mask move to the front.
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

}  // namespace bihive
