// Reads and writes PNG (libpng).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/image/image.h"
#include "bihive/image/png_pixels.h"

namespace bihive {

/// Keyword and text of the file's tEXt chunks (Latin-1 keyword of 1 to 79 characters).
using PngText = std::vector<std::pair<std::string, std::string>>;

/// The whole file in memory.
Result<std::string> encode_png(const Image& image, const PngText& text);

/// `dots_per_inch`: the size at which the picture is printed; 0 says nothing about it.
Result<std::string> encode_png(const PngPixels& pixels, const PngText& text, double dots_per_inch = 0);

/// Writes a new file and renames it (base/write_file.h): after a failure no partial file is left.
Status write_png(const std::string& path, const Image& image, const PngText& text);

/// 8-bit RGB of any PNG (alpha dropped, grey and palette expanded), and its text chunks.
struct PngFile {
  Image image;
  PngText text;
};
Result<PngFile> read_png(const std::string& path);

}  // namespace bihive
