#include "bihive/image/png.h"

#include <png.h>

#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <cstring>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/base/write_file.h"

namespace bihive {
namespace {

// A fast level: higher levels compress rendered pictures little more.
constexpr int kCompressionLevel = 1;

// Nearly sRGB, for programs that do not know it: 1 / 2.2 in steps of 1e-5, as the specification says.
constexpr png_fixed_point kGammaOfSrgb = 45455;

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

// The form of a picture as libpng's functions take it: plain data only.
struct PngHead {
  png_uint_32 width, height;
  int bits, colour_type;
  png_uint_32 pixels_per_metre;  // 0: not said
  bool is_srgb;
};

// The parts between setjmp and longjmp: plain pointers only. False on an error.
bool write_head(png_structp png, png_infop info, PngState* state, const PngHead* head, png_text* text, int texts) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_write_fn(png, state, append_bytes, flush_nothing);
  png_set_compression_level(png, kCompressionLevel);
  png_set_IHDR(png, info, head->width, head->height, head->bits, head->colour_type, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (head->is_srgb) {
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_gAMA_fixed(png, info, kGammaOfSrgb);
  }
  if (head->pixels_per_metre > 0)
    png_set_pHYs(png, info, head->pixels_per_metre, head->pixels_per_metre, PNG_RESOLUTION_METER);
  if (texts > 0) png_set_text(png, info, text, texts);
  png_write_info(png, info);
  return true;
}

bool write_rows(png_structp png, const std::uint8_t* rows, int count, std::size_t row_bytes) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  for (int y = 0; y < count; ++y) png_write_row(png, rows + static_cast<std::size_t>(y) * row_bytes);
  return true;
}

bool write_end(png_structp png, png_infop info, png_text* text, int texts) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  if (texts > 0) png_set_text(png, info, text, texts);
  png_write_end(png, info);
  return true;
}

bool read_header(png_structp png, png_infop info, PngState* state, bool as_rgb8) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_read_fn(png, state, take_bytes);
  png_read_info(png, info);
  if (!as_rgb8) return true;
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

png_uint_32 pixels_per_metre(double dots_per_inch) {
  constexpr double kMetresPerInch = 0.0254;
  return static_cast<png_uint_32>(std::floor(dots_per_inch / kMetresPerInch + 0.5));
}

}  // namespace

class PngEncoder::Implementation {
 public:
  explicit Implementation(std::size_t row_bytes) : row_bytes_(row_bytes) {
    png_ = png_create_write_struct(PNG_LIBPNG_VER_STRING, &state_, on_error, on_warning);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
  }
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() { png_destroy_write_struct(&png_, &info_); }

  Status begin(const PngHead& head, const PngText& text) {
    std::vector<png_text> chunks = chunks_of(text);
    return status_of(info_ != nullptr &&
                     write_head(png_, info_, &state_, &head, chunks.data(), static_cast<int>(chunks.size())));
  }
  Status add(const std::uint8_t* rows, int count) { return status_of(write_rows(png_, rows, count, row_bytes_)); }
  Status finish(const PngText& text) {
    std::vector<png_text> chunks = chunks_of(text);
    return status_of(write_end(png_, info_, chunks.data(), static_cast<int>(chunks.size())));
  }
  std::string take_bytes() { return std::exchange(state_.bytes, std::string()); }
  std::size_t row_bytes() const { return row_bytes_; }

 private:
  // Valid as long as the text.
  static std::vector<png_text> chunks_of(const PngText& text) {
    std::vector<png_text> chunks(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
      chunks[i].compression = PNG_TEXT_COMPRESSION_NONE;
      chunks[i].key = const_cast<png_charp>(text[i].first.c_str());    // NOLINT: libpng reads it only
      chunks[i].text = const_cast<png_charp>(text[i].second.c_str());  // NOLINT: libpng reads it only
      chunks[i].text_length = text[i].second.size();
    }
    return chunks;
  }

  Status status_of(bool good) const {
    if (!good && png_ == nullptr) return Error{"PNG: there is not enough memory", "", 0, 0, ""};
    if (!good) return Error{std::string("PNG: ") + state_.message, "", 0, 0, ""};
    return Done{};
  }

  std::size_t row_bytes_;
  PngState state_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

PngEncoder::PngEncoder(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
PngEncoder::PngEncoder(PngEncoder&& other) noexcept = default;
PngEncoder& PngEncoder::operator=(PngEncoder&& other) noexcept = default;
PngEncoder::~PngEncoder() = default;

Result<PngEncoder> PngEncoder::begin(int width, int height, int channels, int bits, const PngText& text,
                                     double dots_per_inch, bool is_srgb) {
  BIHIVE_CHECK(channels == 3 || channels == 4);
  BIHIVE_CHECK(bits == 8 || bits == 16);
  const PngPixels form{width, height, channels, bits, {}};
  auto implementation = std::make_unique<Implementation>(form.row_bytes());
  const PngHead head{static_cast<png_uint_32>(width),
                     static_cast<png_uint_32>(height),
                     bits,
                     channels == 4 ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB,
                     pixels_per_metre(dots_per_inch),
                     is_srgb};
  if (Status status = implementation->begin(head, text); !status) return status.error();
  return PngEncoder(std::move(implementation));
}

Status PngEncoder::add(const PngPixels& rows) {
  BIHIVE_CHECK_EQ(rows.row_bytes(), implementation_->row_bytes());
  BIHIVE_CHECK_EQ(rows.bytes.size(), rows.row_bytes() * static_cast<std::size_t>(rows.height));
  return add(rows.bytes.data(), rows.height);
}
Status PngEncoder::add(const std::uint8_t* rows, int count) {
  return implementation_->add(rows, count);
}
Status PngEncoder::finish(const PngText& text) {
  return implementation_->finish(text);
}
std::string PngEncoder::take_bytes() {
  return implementation_->take_bytes();
}

namespace {

Result<std::string> encode_rows(const std::uint8_t* rows, int width, int height, int channels, int bits,
                                const PngText& text, double dots_per_inch, bool is_srgb) {
  PngText before, after;
  for (const auto& chunk : text) (chunk.first == kLateKeyword ? after : before).push_back(chunk);
  Result<PngEncoder> encoder = PngEncoder::begin(width, height, channels, bits, before, dots_per_inch, is_srgb);
  if (!encoder) return encoder.error();
  if (Status status = encoder->add(rows, height); !status) return status.error();
  if (Status status = encoder->finish(after); !status) return status.error();
  return encoder->take_bytes();
}

}  // namespace

Result<std::string> encode_png(const Image& image, const PngText& text) {
  BIHIVE_CHECK_EQ(image.rgb.size(), 3 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
  return encode_rows(image.rgb.data(), image.width, image.height, 3, 8, text, 0, false);
}

Result<std::string> encode_png(const PngPixels& pixels, const PngText& text, double dots_per_inch) {
  BIHIVE_CHECK_EQ(pixels.bytes.size(), pixels.row_bytes() * static_cast<std::size_t>(pixels.height));
  return encode_rows(pixels.bytes.data(), pixels.width, pixels.height, pixels.channels, pixels.bits, text,
                     dots_per_inch, pixels.is_srgb);
}

Status write_png(const std::string& path, const Image& image, const PngText& text) {
  const Result<std::string> bytes = encode_png(image, text);
  if (!bytes) return bytes.error();
  return write_file(path, *bytes);
}

namespace {

// Reads size and form first; place(png, info) gives the memory of the rows, or null for a form that is not wanted.
template <class Place>
Status read_png_with(const std::string& path, bool as_rgb8, const Place& place, PngText& text) {
  Result<std::string> bytes = read_file(path);
  if (!bytes) return bytes.error();
  PngState state;
  state.bytes = std::move(*bytes);
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &state, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool good = info != nullptr && read_header(png, info, &state, as_rgb8);
  bool known = true;
  if (good) {
    std::uint8_t* const memory = place(png, info);
    known = memory != nullptr;
    std::vector<png_bytep> rows(known ? png_get_image_height(png, info) : 0);
    for (std::size_t y = 0; y < rows.size(); ++y) rows[y] = memory + y * png_get_rowbytes(png, info);
    if (known) good = read_rows(png, info, rows.data());
  }
  if (good && known) {
    png_textp chunks = nullptr;
    int count = 0;
    png_get_text(png, info, &chunks, &count);
    for (int i = 0; i < count; ++i) text.emplace_back(chunks[i].key, chunks[i].text);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  if (!good) return Error{std::string("is not a readable PNG: ") + state.message, path, 0, 0, ""};
  if (!known) return Error{"is not a PNG as bihive writes them: RGB or RGBA of 8 or 16 bits", path, 0, 0, ""};
  return Done{};
}

}  // namespace

Result<PngFile> read_png(const std::string& path) {
  PngFile file;
  const auto place = [&file](png_structp png, png_infop info) {
    file.image.width = static_cast<int>(png_get_image_width(png, info));
    file.image.height = static_cast<int>(png_get_image_height(png, info));
    file.image.rgb.resize(3 * static_cast<std::size_t>(file.image.width) * static_cast<std::size_t>(file.image.height));
    return file.image.rgb.data();
  };
  if (Status status = read_png_with(path, /*as_rgb8=*/true, place, file.text); !status) return status.error();
  return file;
}

Result<PngFileOfPixels> read_png_pixels(const std::string& path) {
  PngFileOfPixels file;
  PngPixels& pixels = file.pixels;
  const auto place = [&pixels](png_structp png, png_infop info) -> std::uint8_t* {
    const int colours = png_get_color_type(png, info);
    pixels.bits = png_get_bit_depth(png, info);
    if ((colours != PNG_COLOR_TYPE_RGB && colours != PNG_COLOR_TYPE_RGB_ALPHA) || pixels.bits < 8 ||
        png_get_interlace_type(png, info) != PNG_INTERLACE_NONE)
      return nullptr;
    pixels.width = static_cast<int>(png_get_image_width(png, info));
    pixels.height = static_cast<int>(png_get_image_height(png, info));
    pixels.channels = colours == PNG_COLOR_TYPE_RGB ? 3 : 4;
    pixels.bytes.resize(pixels.row_bytes() * static_cast<std::size_t>(pixels.height));
    return pixels.bytes.data();
  };
  if (Status status = read_png_with(path, /*as_rgb8=*/false, place, file.text); !status) return status.error();
  return file;
}

}  // namespace bihive
