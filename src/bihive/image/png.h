// Reads and writes PNG (libpng).
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/image/image.h"
#include "bihive/image/png_pixels.h"

namespace bihive {

/// Keyword and text of the file's tEXt chunks (Latin-1 keyword of 1 to 79 characters).
using PngText = std::vector<std::pair<std::string, std::string>>;

/// The keyword of a text about the pixels, which comes after them.
inline const std::string kLateKeyword = "bihive";

/// The whole file in memory.
Result<std::string> encode_png(const Image& image, const PngText& text);

/// `dots_per_inch`: the size at which the picture is printed; 0 says nothing about it. Pixels that are sRGB are said to
/// be (sRGB and gAMA).
Result<std::string> encode_png(const PngPixels& pixels, const PngText& text, double dots_per_inch = 0);

/// A PNG that grows by rows, for pictures that are larger than the memory. The bytes are those of encode_png().
class PngEncoder {
 public:
  /// The size of the whole picture; channels, bits and is_srgb as in PngPixels.
  static Result<PngEncoder> begin(int width, int height, int channels, int bits, const PngText& text,
                                  double dots_per_inch = 0, bool is_srgb = false);
  PngEncoder(PngEncoder&& other) noexcept;
  PngEncoder& operator=(PngEncoder&& other) noexcept;
  ~PngEncoder();

  /// The next rows, of the width and form of begin().
  Status add(const PngPixels& rows);
  Status add(const std::uint8_t* rows, int count);
  /// After the last row. `text`: more of it, for what is known only now.
  Status finish(const PngText& text = {});
  /// The bytes of the file since the last call, to be written behind the earlier ones.
  std::string take_bytes();

 private:
  class Implementation;
  explicit PngEncoder(std::unique_ptr<Implementation> implementation);
  std::unique_ptr<Implementation> implementation_;
};

/// Writes a new file and renames it (base/write_file.h): after a failure no partial file is left.
Status write_png(const std::string& path, const Image& image, const PngText& text);

/// 8-bit RGB of any PNG (alpha dropped, grey and palette expanded), and its text chunks.
struct PngFile {
  Image image;
  PngText text;
};
Result<PngFile> read_png(const std::string& path);

/// The pixels of a PNG that write_png() or PngEncoder made, as they are, and its text chunks. Error: it has another
/// form.
struct PngFileOfPixels {
  PngPixels pixels;
  PngText text;
};
Result<PngFileOfPixels> read_png_pixels(const std::string& path);

}  // namespace bihive
