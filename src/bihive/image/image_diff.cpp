#include "bihive/image/image_diff.h"

#include <algorithm>
#include <cstdlib>

namespace bihive {

ImageDifference difference_of(const Image& a, const Image& b) {
  ImageDifference difference;
  if (a.width != b.width || a.height != b.height) {
    difference.same_size = false;
    return difference;
  }
  difference.picture = Image{a.width, a.height, std::vector<std::uint8_t>(a.rgb.size())};
  for (std::size_t i = 0; i < a.rgb.size(); i += 3) {
    int pixel = 0;
    for (std::size_t k = i; k < i + 3; ++k) {
      const int channel = std::abs(int{a.rgb[k]} - int{b.rgb[k]});
      difference.picture.rgb[k] = static_cast<std::uint8_t>(channel);
      pixel = std::max(pixel, channel);
    }
    if (pixel > 0) ++difference.pixels;
    difference.largest = std::max(difference.largest, pixel);
  }

  // Brighten, so that a difference of one step can be seen.
  if (difference.largest > 0)
    for (std::uint8_t& channel : difference.picture.rgb)
      channel = static_cast<std::uint8_t>(channel * 255 / difference.largest);
  return difference;
}

}  // namespace bihive
