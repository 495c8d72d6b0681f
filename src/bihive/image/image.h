// A picture of 8-bit RGB, row by row from the top.
#pragma once

#include <cstdint>
#include <vector>

namespace bihive {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 x width x height
};

/// 64-bit FNV-1a over size and pixels: equal pictures, equal hash.
std::uint64_t picture_hash(const Image& image);

}  // namespace bihive
