// Compares two pictures.
#pragma once

#include <cstdint>

#include "bihive/image/image.h"

namespace bihive {

struct ImageDifference {
  bool same_size = true;
  std::int64_t pixels = 0;  ///< the number of pixels with a difference in any channel
  int largest = 0;          ///< the largest difference of a channel, 0 to 255
  Image picture;            ///< absolute differences, brightened so that the largest is 255; empty if sizes differ
};

ImageDifference difference_of(const Image& a, const Image& b);

}  // namespace bihive
