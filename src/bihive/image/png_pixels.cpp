#include "bihive/image/png_pixels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/base/parallel.h"
#include "bihive/base/sha256.h"
#include "bihive/image/image.h"
#include "bihive/image/image_from_film.h"

namespace bihive {
namespace {

// The nearest of 0 ... most; NaN gives 0.
unsigned nearest_step(double share, double most) {
  const double clamped = share > 0 ? std::min(share, 1.0) : 0;
  return static_cast<unsigned>(std::floor(clamped * most + 0.5));
}

// Writes numbers of 8 or 16 bits one after the other.
class NumberWriter {
 public:
  NumberWriter(std::uint8_t* to, int bits) : to_(to), bits_(bits) {}
  void put(double share) {
    const unsigned number = nearest_step(share, bits_ == 8 ? 255 : 65535);
    if (bits_ == 16) *to_++ = static_cast<std::uint8_t>(number >> 8);
    *to_++ = static_cast<std::uint8_t>(number & 0xFF);
  }

 private:
  std::uint8_t* to_;
  int bits_;
};

double displayed(float light, Transfer curve) {
  if (curve == Transfer::none || !(light > 0)) return double(light);
  return srgb_from_linear(std::min(double(light), 1.0));
}

}  // namespace

PngPixels png_pixels_from_film(const Film& film, Transfer curve, int bits, int threads) {
  BIHIVE_CHECK(bits == 8 || bits == 16);
  const bool with_opacity = !film.coverage.empty();
  PngPixels pixels{film.width, film.height, with_opacity ? 4 : 3, bits, {}};
  if (!with_opacity && bits == 8) {
    pixels.bytes = std::move(image_from_film(film, curve, threads).rgb);
    return pixels;
  }
  const std::size_t row_bytes = pixels.row_bytes();
  pixels.bytes.resize(row_bytes * static_cast<std::size_t>(film.height));
  parallel_for(threads, film.height, [&](std::int64_t y) {
    NumberWriter writer(pixels.bytes.data() + static_cast<std::size_t>(y) * row_bytes, bits);
    for (int x = 0; x < film.width; ++x) {
      const Vec3f light = film.at(x, static_cast<int>(y));
      for (int channel = 0; channel < 3; ++channel) writer.put(displayed(light[channel], curve));
      if (with_opacity) writer.put(double(film.coverage[film.number_of(x, static_cast<int>(y))]));
    }
  });
  return pixels;
}

std::string sha256_of(const PngPixels& pixels) {
  Sha256 sha;
  sha.add({reinterpret_cast<const char*>(pixels.bytes.data()), pixels.bytes.size()});
  return sha.digits();
}

std::uint64_t picture_hash(const PngPixels& pixels) {
  return picture_hash(Image{pixels.width, pixels.height, pixels.bytes});
}

}  // namespace bihive
