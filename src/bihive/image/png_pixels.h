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

  std::size_t row_bytes() const {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(channels) * static_cast<std::size_t>(bits / 8);
  }
};

/// Clamps light to [0, 1], applies the curve, and rounds to the nearest of 2^bits numbers. A film with coverage has
/// four channels: the opacity is the coverage without a curve, and the colour is not multiplied by it. With 8 bits and
/// without coverage, the bytes are those of image_from_film(). `threads` 0: all.
PngPixels png_pixels_from_film(const Film& film, Transfer curve, int bits, int threads = 0);

/// SHA-256 of the bytes, in hexadecimal digits.
std::string sha256_of(const PngPixels& pixels);

/// As picture_hash() of an image; equal for equal bytes.
std::uint64_t picture_hash(const PngPixels& pixels);

}  // namespace bihive
