#include "bihive/image/overlay.h"

#include <algorithm>
#include <cmath>

#include "bihive/base/check.h"

namespace bihive {
namespace {

// The numbers of one pixel, 0 to 1, of 8 or 16 bits each.
class PixelNumbers {
 public:
  PixelNumbers(std::uint8_t* at, int bits) : at_(at), bits_(bits), most_(bits == 8 ? 255 : 65535) {}

  double get(int channel) const {
    if (bits_ == 8) return at_[channel] / most_;
    return (at_[2 * channel] * 256 + at_[2 * channel + 1]) / most_;
  }
  void set(int channel, double share) {
    const auto number = static_cast<unsigned>(std::floor(std::clamp(share, 0.0, 1.0) * most_ + 0.5));
    if (bits_ == 8) {
      at_[channel] = static_cast<std::uint8_t>(number);
      return;
    }
    at_[2 * channel] = static_cast<std::uint8_t>(number >> 8);
    at_[2 * channel + 1] = static_cast<std::uint8_t>(number & 0xFF);
  }

 private:
  std::uint8_t* at_;
  int bits_;
  double most_;
};

// A layer of this opacity above the pixel.
void cover(PixelNumbers pixel, bool with_opacity, Vec3d colour, double opacity) {
  const double below = with_opacity ? pixel.get(3) * (1 - opacity) : 1 - opacity;
  const double together = opacity + below;
  for (int channel = 0; channel < 3; ++channel)
    pixel.set(channel, (colour[channel] * opacity + pixel.get(channel) * below) / together);
  if (with_opacity) pixel.set(3, together);
}

}  // namespace

void blend(PngPixels& pixels, const Tile& part, const CoverageMask& mask, Vec3d colour, double opacity) {
  BIHIVE_CHECK(pixels.width == part.width() && pixels.height == part.height());
  const auto pixel_bytes = static_cast<std::size_t>(pixels.channels) * static_cast<std::size_t>(pixels.bits / 8);
  const int x_end = std::min(mask.pixels.x1, part.x1);
  const int y_end = std::min(mask.pixels.y1, part.y1);
  for (int y = std::max(mask.pixels.y0, part.y0); y < y_end; ++y)
    for (int x = std::max(mask.pixels.x0, part.x0); x < x_end; ++x) {
      const double share = opacity * double(mask.at(x, y));
      if (!(share > 0)) continue;
      std::uint8_t* const at = pixels.bytes.data() + static_cast<std::size_t>(y - part.y0) * pixels.row_bytes() +
                               static_cast<std::size_t>(x - part.x0) * pixel_bytes;
      cover(PixelNumbers(at, pixels.bits), pixels.channels == 4, colour, share);
    }
}

}  // namespace bihive
