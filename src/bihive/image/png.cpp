#include "bihive/image/png.h"

#include <png.h>

#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstring>

#include "bihive/base/check.h"
#include "bihive/base/write_file.h"

namespace bihive {
namespace {

// A fast level: higher levels compress rendered pictures little more.
constexpr int kCompressionLevel = 1;

// The data that libpng's callbacks use. libpng reports errors by longjmp, so the frames that it skips hold nothing with
// a destructor.
struct PngState {
  std::string bytes;         // written so far, or the whole file to read
  std::size_t position = 0;  // read so far
  char message[256] = "";    // libpng's error
};

void on_error(png_structp png, png_const_charp message) {
  auto* state = static_cast<PngState*>(png_get_error_ptr(png));
  std::strncpy(state->message, message, sizeof(state->message) - 1);
  std::longjmp(png_jmpbuf(png), 1);
}

void on_warning(png_structp, png_const_charp) {}

void append_bytes(png_structp png, png_bytep data, png_size_t count) {
  static_cast<PngState*>(png_get_io_ptr(png))->bytes.append(reinterpret_cast<const char*>(data), count);
}

void flush_nothing(png_structp) {}

void take_bytes(png_structp png, png_bytep data, png_size_t count) {
  auto* state = static_cast<PngState*>(png_get_io_ptr(png));
  if (count > state->bytes.size() - state->position) png_error(png, "the file ends too early");
  std::memcpy(data, state->bytes.data() + state->position, count);
  state->position += count;
}

// The picture as libpng's functions take it: plain data only.
struct PngRows {
  png_uint_32 width, height;
  int bits, colour_type;
  const std::uint8_t* bytes;
  std::size_t row_bytes;
  png_uint_32 pixels_per_metre;  // 0: not said
};

// The part between setjmp and longjmp: plain pointers only. False on an error.
bool write_picture(png_structp png, png_infop info, PngState* state, const PngRows* rows, png_text* text, int texts) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, state, append_bytes, flush_nothing);
  png_set_compression_level(png, kCompressionLevel);
  png_set_IHDR(png, info, rows->width, rows->height, rows->bits, rows->colour_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (rows->pixels_per_metre > 0)
    png_set_pHYs(png, info, rows->pixels_per_metre, rows->pixels_per_metre, PNG_RESOLUTION_METER);
  if (texts > 0) png_set_text(png, info, text, texts);
  png_write_info(png, info);
  for (png_uint_32 y = 0; y < rows->height; ++y)
    png_write_row(png, rows->bytes + static_cast<std::size_t>(y) * rows->row_bytes);
  png_write_end(png, info);
  return true;
}

bool read_header(png_structp png, png_infop info, PngState* state) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, state, take_bytes);
  png_read_info(png, info);
  png_set_expand(png);
  png_set_strip_16(png);
  png_set_strip_alpha(png);
  png_set_gray_to_rgb(png);
  png_read_update_info(png, info);
  return true;
}

bool read_rows(png_structp png, png_infop info, png_bytepp rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_image(png, rows);
  png_read_end(png, info);
  return true;
}

Result<std::string> encode_rows(const PngRows& rows, const PngText& text) {
  PngState state;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  std::vector<png_text> chunks(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    chunks[i].compression = PNG_TEXT_COMPRESSION_NONE;
    chunks[i].key = const_cast<png_charp>(text[i].first.c_str());    // NOLINT: libpng reads it only
    chunks[i].text = const_cast<png_charp>(text[i].second.c_str());  // NOLINT: libpng reads it only
    chunks[i].text_length = text[i].second.size();
  }
  const bool written =
      info != nullptr && write_picture(png, info, &state, &rows, chunks.data(), static_cast<int>(chunks.size()));
  png_destroy_write_struct(&png, &info);
  if (!written) return Error{std::string("PNG: ") + state.message, "", 0, 0, ""};
  return std::move(state.bytes);
}

}  // namespace

Result<std::string> encode_png(const Image& image, const PngText& text) {
  const std::size_t row_bytes = 3 * static_cast<std::size_t>(image.width);
  BIHIVE_CHECK_EQ(image.rgb.size(), row_bytes * static_cast<std::size_t>(image.height));
  return encode_rows({static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height), 8,
                      PNG_COLOR_TYPE_RGB, image.rgb.data(), row_bytes, 0},
                     text);
}

Result<std::string> encode_png(const PngPixels& pixels, const PngText& text, double dots_per_inch) {
  BIHIVE_CHECK(pixels.channels == 3 || pixels.channels == 4);
  BIHIVE_CHECK(pixels.bits == 8 || pixels.bits == 16);
  BIHIVE_CHECK_EQ(pixels.bytes.size(), pixels.row_bytes() * static_cast<std::size_t>(pixels.height));
  constexpr double kMetresPerInch = 0.0254;
  return encode_rows({static_cast<png_uint_32>(pixels.width), static_cast<png_uint_32>(pixels.height), pixels.bits,
                      pixels.channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, pixels.bytes.data(),
                      pixels.row_bytes(), static_cast<png_uint_32>(std::floor(dots_per_inch / kMetresPerInch + 0.5))},
                     text);
}

Status write_png(const std::string& path, const Image& image, const PngText& text) {
  const Result<std::string> bytes = encode_png(image, text);
  if (!bytes) return bytes.error();
  return write_file(path, *bytes);
}

Result<PngFile> read_png(const std::string& path) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  PngState state;
  state.bytes = std::move(*bytes);

  // Read size and form first, then the rows into memory of our own.
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool good = info != nullptr && read_header(png, info, &state);
  PngFile file;
  if (good) {
    file.image.width = static_cast<int>(png_get_image_width(png, info));
    file.image.height = static_cast<int>(png_get_image_height(png, info));
    const std::size_t row_bytes = 3 * static_cast<std::size_t>(file.image.width);
    file.image.rgb.resize(row_bytes * static_cast<std::size_t>(file.image.height));
    std::vector<png_bytep> rows(static_cast<std::size_t>(file.image.height));
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = file.image.rgb.data() + y * row_bytes;
    good = read_rows(png, info, rows.data());
  }
  if (good) {
    png_textp chunks = nullptr;
    int count = 0;
    png_get_text(png, info, &chunks, &count);
    for (int i = 0; i < count; ++i) file.text.emplace_back(chunks[i].key, chunks[i].text);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (!good) return Error{std::string("is not a readable PNG: ") + state.message, path, 0, 0, ""};
  return file;
}

}  // namespace bihive
