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
  void put(double share) { put_number(nearest_step(share, most())); }
  double most() const { return bits_ == 8 ? 255 : 65535; }
  void put_number(unsigned number) {
    if (bits_ == 16) *to_++ = static_cast<std::uint8_t>(number >> 8);
    *to_++ = static_cast<std::uint8_t>(number & 0xFF);
  }

 private:
  std::uint8_t* to_;
  int bits_;
};

double displayed(double light, Transfer curve) {
  if (curve == Transfer::none || !(light > 0)) return light;
  return srgb_from_linear(std::min(light, 1.0));
}

// The opacity and colour of one pixel, in steps of 1 / most, that show `wanted` before `page`. `coverage`: 0 to 1.
struct MattedPixel {
  unsigned colour[3];
  unsigned opacity;
};
MattedPixel matted(const unsigned (&wanted)[3], const unsigned (&page)[3], double coverage, double most) {
  // Any opacity will do that leaves all three colours in range: the coverage, or a higher one.
  double opacity = nearest_step(coverage, most);
  for (int channel = 0; channel < 3; ++channel) {
    const double want = wanted[channel], behind = page[channel];
    if (want > behind) opacity = std::max(opacity, std::ceil(most * (want - behind) / (most - behind)));
    if (want < behind) opacity = std::max(opacity, std::ceil(most * (behind - want) / behind));
  }
  MattedPixel pixel{{page[0], page[1], page[2]}, static_cast<unsigned>(opacity)};
  if (opacity == 0) return pixel;
  for (int channel = 0; channel < 3; ++channel) {
    const double want = wanted[channel], behind = page[channel];
    pixel.colour[channel] = nearest_step((want * most - behind * (most - opacity)) / opacity / most, most);
  }
  return pixel;
}

}  // namespace

PngPixels png_pixels_from_film(const Film& film, Transfer curve, int bits, int threads) {
  BIHIVE_CHECK(bits == 8 || bits == 16);
  const bool with_opacity = !film.coverage.empty();
  PngPixels pixels{film.width, film.height, with_opacity ? 4 : 3, bits, {}, curve == Transfer::srgb};
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
      for (int channel = 0; channel < 3; ++channel) writer.put(displayed(double(light[channel]), curve));
      if (with_opacity) writer.put(double(film.coverage[film.number_of(x, static_cast<int>(y))]));
    }
  });
  return pixels;
}

PngPixels matted_pixels_from_film(const Film& film, Transfer curve, int bits, Vec3d page, int threads) {
  BIHIVE_CHECK(bits == 8 || bits == 16);
  BIHIVE_CHECK(!film.coverage.empty());
  PngPixels pixels{film.width, film.height, 4, bits, {}, curve == Transfer::srgb};
  const std::size_t row_bytes = pixels.row_bytes();
  pixels.bytes.resize(row_bytes * static_cast<std::size_t>(film.height));
  const double most = bits == 8 ? 255 : 65535;
  unsigned behind[3];
  for (int channel = 0; channel < 3; ++channel) behind[channel] = nearest_step(displayed(page[channel], curve), most);
  parallel_for(threads, film.height, [&](std::int64_t y) {
    NumberWriter writer(pixels.bytes.data() + static_cast<std::size_t>(y) * row_bytes, bits);
    for (int x = 0; x < film.width; ++x) {
      const Vec3f light = film.at(x, static_cast<int>(y));
      const double coverage = double(film.coverage[film.number_of(x, static_cast<int>(y))]);
      unsigned wanted[3];
      for (int channel = 0; channel < 3; ++channel)
        wanted[channel] =
            nearest_step(displayed(coverage * double(light[channel]) + (1 - coverage) * page[channel], curve), most);
      const MattedPixel pixel = matted(wanted, behind, coverage, most);
      for (const unsigned number : pixel.colour) writer.put_number(number);
      writer.put_number(pixel.opacity);
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
