// From a film to the pixels of a PNG: with or without opacity, of 8 or 16 bits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/image/film.h"
#include "bihive/image/transfer.h"

namespace bihive {

/// Row by row from the top. Red, green, blue and, of four channels, opacity; of 16 bits the higher byte comes first.
struct PngPixels {
  int width = 0;
  int height = 0;
  int channels = 3;  ///< 3 or 4
  int bits = 8;      ///< 8 or 16
  std::vector<std::uint8_t> bytes;
  bool is_srgb = false;  ///< colours of a screen, and not numbers that stand for something else

  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels) * static_cast<std::size_t>(bits / 8);
  }
};

/// Clamps light to [0, 1], applies the curve, and rounds to the nearest of 2^bits numbers. A film with coverage has
/// four channels: the opacity is the coverage without a curve, and the colour is not multiplied by it. With 8 bits and
/// without coverage, the bytes are those of image_from_film(). `threads` 0: all.
PngPixels png_pixels_from_film(const Film& film, Transfer curve, int bits, int threads = 0);

/// The same of a film with coverage, for a page of one colour (linear, 0 to 1), in front of which programs show the
/// picture by mixing values of the screen. If they round to the nearest number, they show, bit for bit, the pixels of
/// the film with this colour behind it under the curve. So a pixel's opacity is at least its coverage, and its colour
/// is the one that gives the right mixture; without coverage it is that of the page.
PngPixels matted_pixels_from_film(const Film& film, Transfer curve, int bits, Vec3d page, int threads = 0);

/// SHA-256 of the bytes, in hexadecimal digits.
std::string sha256_of(const PngPixels& pixels);

/// As picture_hash() of an image; equal for equal bytes.
std::uint64_t picture_hash(const PngPixels& pixels);

}  // namespace bihive
