// A picture of 8-bit RGB, row by row from the top.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/fnv.h"

namespace bihive {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  ///< 3 x width x height
};

/// 64-bit FNV-1a over size and pixels: equal pictures, equal hash.
std::uint64_t picture_hash(const Image& image);

/// The same of a picture that comes in pieces: all its bytes, in their order.
class PictureHash {
 public:
  PictureHash(int width, int height);
  void add(const std::vector<std::uint8_t>& bytes);
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = fnv1a("");
};

}  // namespace bihive
