#include "bihive/image/tiff.h"

#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <utility>
#include <vector>

#include "bihive/base/check.h"
#include "bihive/base/write_file.h"

namespace bihive {
namespace {

// Higher levels compress rendered pictures little more.
constexpr int kDeflateLevel = 3;
constexpr std::size_t kStripBytes = 65536;
// Offsets of classic TIFF have 32 bits; Deflate makes nothing much larger.
constexpr double kMostClassicBytes = 4e9;

// libtiff's way to a file that is written aside.
struct TiffStream {
  GrowingFile file;
  std::uint64_t place = 0, size = 0;
  std::optional<Error> fault;  // the first one
};

tmsize_t read_nothing(thandle_t, void*, tmsize_t) {
  return 0;
}

tmsize_t write_bytes(thandle_t handle, void* bytes, tmsize_t count) {
  auto* const stream = static_cast<TiffStream*>(handle);
  if (stream->fault) return 0;
  const auto size = static_cast<std::size_t>(count);
  if (const Status status = stream->file.write_at(stream->place, {static_cast<const char*>(bytes), size}); !status) {
    stream->fault = status.error();
    return 0;
  }
  stream->place += size;
  stream->size = std::max(stream->size, stream->place);
  return count;
}

toff_t seek_to(thandle_t handle, toff_t offset, int whence) {
  auto* const stream = static_cast<TiffStream*>(handle);
  stream->place = whence == SEEK_SET ? offset : whence == SEEK_CUR ? stream->place + offset : stream->size + offset;
  return stream->place;
}

int close_nothing(thandle_t) {
  return 0;
}

toff_t size_of(thandle_t handle) {
  return static_cast<TiffStream*>(handle)->size;
}

// libtiff's message; the first one counts.
int keep_message(TIFF*, void* user, const char*, const char* format, va_list values) {
  auto* const stream = static_cast<TiffStream*>(user);
  char message[256];
  std::vsnprintf(message, sizeof(message), format, values);
  if (!stream->fault) stream->fault = Error{std::string("TIFF: ") + message, "", 0, 0, ""};
  return 1;
}

// From the higher byte first to this machine's order, which libtiff takes, and back.
void exchange_orders(std::vector<std::uint8_t>& row) {
  for (std::size_t i = 0; i + 1 < row.size(); i += 2) {
    const auto number = static_cast<std::uint16_t>(row[i] * 256 + row[i + 1]);
    const auto* const bytes = reinterpret_cast<const std::uint8_t*>(&number);
    row[i] = bytes[0];
    row[i + 1] = bytes[1];
  }
}

int ignore_message(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

}  // namespace

bool can_write_tiff() {
  return true;
}

class TiffWriter::Implementation {
 public:
  Implementation(std::string path, const TiffForm& form, GrowingFile file)
      : path_(std::move(path)), form_(form), stream_{std::move(file), 0, 0, {}} {}
  Implementation(const Implementation&) = delete;
  Implementation& operator=(const Implementation&) = delete;
  ~Implementation() {
    // An unfinished file gets no directory.
    if (tiff_ == nullptr) return;
    if (!stream_.fault) stream_.fault = Error{"TIFF: it was not finished", path_, 0, 0, ""};
    TIFFClose(tiff_);
  }

  Status begin() {
    const double raw = double(form_.width) * form_.height * form_.channels * (form_.bits / 8);
    TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
    TIFFOpenOptionsSetErrorHandlerExtR(options, keep_message, &stream_);
    TIFFOpenOptionsSetWarningHandlerExtR(options, ignore_message, &stream_);
    // The same order of bytes on every machine.
    tiff_ = TIFFClientOpenExt(path_.c_str(), raw > kMostClassicBytes ? "wl8" : "wl", &stream_, read_nothing,
                              write_bytes, seek_to, close_nothing, size_of, nullptr, nullptr, options);
    TIFFOpenOptionsFree(options);
    if (tiff_ == nullptr) return fault();
    const std::size_t row_bytes = row_of_form().row_bytes();
    set(TIFFTAG_IMAGEWIDTH, static_cast<std::uint32_t>(form_.width));
    set(TIFFTAG_IMAGELENGTH, static_cast<std::uint32_t>(form_.height));
    set(TIFFTAG_BITSPERSAMPLE, form_.bits);
    set(TIFFTAG_SAMPLESPERPIXEL, form_.channels);
    set(TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_RGB);
    set(TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
    set(TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
    set(TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
    set(TIFFTAG_ZIPQUALITY, kDeflateLevel);
    set(TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
    set(TIFFTAG_ROWSPERSTRIP, static_cast<std::uint32_t>(std::max<std::size_t>(1, kStripBytes / row_bytes)));
    if (form_.channels == 4) {
      const std::uint16_t straight[] = {EXTRASAMPLE_UNASSALPHA};
      set(TIFFTAG_EXTRASAMPLES, 1, straight);
    }
    if (form_.dots_per_inch > 0) {
      set(TIFFTAG_RESOLUTIONUNIT, RESUNIT_INCH);
      set(TIFFTAG_XRESOLUTION, form_.dots_per_inch);
      set(TIFFTAG_YRESOLUTION, form_.dots_per_inch);
    }
    if (!form_.software.empty()) set(TIFFTAG_SOFTWARE, form_.software.c_str());
    if (!form_.description.empty()) set(TIFFTAG_IMAGEDESCRIPTION, form_.description.c_str());
    return good_ ? Status(Done{}) : fault();
  }

  Status add(const PngPixels& rows) {
    BIHIVE_CHECK_EQ(rows.row_bytes(), row_of_form().row_bytes());
    BIHIVE_CHECK(rows.height <= form_.height - next_y_);
    const std::size_t row_bytes = rows.row_bytes();
    std::vector<std::uint8_t> row(row_bytes);  // the predictor works in it
    for (int y = 0; y < rows.height; ++y) {
      const std::uint8_t* const from = rows.bytes.data() + static_cast<std::size_t>(y) * row_bytes;
      std::copy(from, from + row_bytes, row.begin());
      if (form_.bits == 16) exchange_orders(row);
      if (TIFFWriteScanline(tiff_, row.data(), static_cast<std::uint32_t>(next_y_++), 0) != 1 || stream_.fault)
        return fault();
    }
    return Done{};
  }

  Status finish(const std::string& description) {
    BIHIVE_CHECK_EQ(next_y_, form_.height);
    if (!description.empty()) set(TIFFTAG_IMAGEDESCRIPTION, description.c_str());
    if (!good_) return fault();
    const bool written = TIFFWriteDirectory(tiff_) == 1;
    TIFFClose(tiff_);
    tiff_ = nullptr;
    if (!written || stream_.fault) return fault();
    return stream_.file.finish();
  }

  const GrowingFile& file() const { return stream_.file; }

 private:
  PngPixels row_of_form() const { return {form_.width, 1, form_.channels, form_.bits, {}}; }

  template <class... Values>
  void set(std::uint32_t tag, Values... values) {
    good_ = TIFFSetField(tiff_, tag, values...) == 1 && good_;
  }

  Status fault() const {
    Error error = stream_.fault.value_or(Error{"TIFF: writing failed", "", 0, 0, ""});
    if (error.file.empty()) error.file = path_;
    return error;
  }

  std::string path_;
  TiffForm form_;
  TiffStream stream_;
  TIFF* tiff_ = nullptr;
  bool good_ = true;
  int next_y_ = 0;
};

TiffWriter::TiffWriter(std::unique_ptr<Implementation> implementation) : implementation_(std::move(implementation)) {}
TiffWriter::TiffWriter(TiffWriter&& other) noexcept = default;
TiffWriter& TiffWriter::operator=(TiffWriter&& other) noexcept = default;
TiffWriter::~TiffWriter() = default;

Result<TiffWriter> TiffWriter::begin(const std::string& path, const TiffForm& form) {
  BIHIVE_CHECK(form.channels == 3 || form.channels == 4);
  BIHIVE_CHECK(form.bits == 8 || form.bits == 16);
  Result<GrowingFile> file = GrowingFile::begin(path);
  if (!file) return file.error();
  if (!file->can_go_back()) return Error{"a TIFF file cannot be a pipe or a device", path, 0, 0, ""};
  auto implementation = std::make_unique<Implementation>(path, form, std::move(*file));
  if (Status status = implementation->begin(); !status) return status.error();
  return TiffWriter(std::move(implementation));
}

Status TiffWriter::add(const PngPixels& rows) {
  return implementation_->add(rows);
}
Status TiffWriter::finish(const std::string& description) {
  return implementation_->finish(description);
}
std::string TiffWriter::path_aside() const {
  return implementation_->file().path_aside();
}

Status write_tiff(const std::string& path, const TiffForm& form, const PngPixels& pixels) {
  Result<TiffWriter> writer = TiffWriter::begin(path, form);
  if (!writer) return writer.error();
  if (Status status = writer->add(pixels); !status) return status;
  return writer->finish();
}

namespace {

// libtiff's handle of a file that is read, and its first fault.
struct TiffInput {
  TIFF* tiff = nullptr;
  std::string fault;

  ~TiffInput() {
    if (tiff != nullptr) TIFFClose(tiff);
  }
};

int keep_fault(TIFF*, void* user, const char*, const char* format, va_list values) {
  auto* const input = static_cast<TiffInput*>(user);
  char message[256];
  std::vsnprintf(message, sizeof(message), format, values);
  if (input->fault.empty()) input->fault = message;
  return 1;
}

}  // namespace

Result<TiffFile> read_tiff(const std::string& path) {
  constexpr std::uint32_t kLargestSide = 65535;
  TiffInput input;
  const auto refuse = [&](const std::string& what) {
    return Error{"TIFF: " + (input.fault.empty() ? what : input.fault), path, 0, 0, ""};
  };
  TIFFOpenOptions* const options = TIFFOpenOptionsAlloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options, keep_fault, &input);
  TIFFOpenOptionsSetWarningHandlerExtR(options, ignore_message, &input);
  input.tiff = TIFFOpenExt(path.c_str(), "r", options);
  TIFFOpenOptionsFree(options);
  if (input.tiff == nullptr) return refuse("cannot be read");

  std::uint32_t width = 0, height = 0;
  std::uint16_t bits = 0, channels = 0, colours = 0, planes = 0;
  const char* description = nullptr;
  TIFFGetField(input.tiff, TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(input.tiff, TIFFTAG_IMAGELENGTH, &height);
  TIFFGetFieldDefaulted(input.tiff, TIFFTAG_BITSPERSAMPLE, &bits);
  TIFFGetFieldDefaulted(input.tiff, TIFFTAG_SAMPLESPERPIXEL, &channels);
  TIFFGetField(input.tiff, TIFFTAG_PHOTOMETRIC, &colours);
  TIFFGetFieldDefaulted(input.tiff, TIFFTAG_PLANARCONFIG, &planes);
  const bool is_ours = colours == PHOTOMETRIC_RGB && planes == PLANARCONFIG_CONTIG &&
                       (channels == 3 || channels == 4) && (bits == 8 || bits == 16) && TIFFIsTiled(input.tiff) == 0;
  if (!is_ours || width == 0 || height == 0 || width > kLargestSide || height > kLargestSide)
    return refuse("is not of the form that bihive writes");
  TiffFile file;
  if (TIFFGetField(input.tiff, TIFFTAG_IMAGEDESCRIPTION, &description) == 1) file.description = description;
  file.pixels = {static_cast<int>(width), static_cast<int>(height), channels, bits, {}};
  const std::size_t row_bytes = file.pixels.row_bytes();
  if (static_cast<std::size_t>(TIFFScanlineSize(input.tiff)) != row_bytes) return refuse("has rows of another size");
  std::vector<std::uint8_t> row(row_bytes);
  for (std::uint32_t y = 0; y < height; ++y) {
    if (TIFFReadScanline(input.tiff, row.data(), y, 0) != 1) return refuse("its pixels are damaged");
    if (bits == 16) exchange_orders(row);
    file.pixels.bytes.insert(file.pixels.bytes.end(), row.begin(), row.end());
  }
  return file;
}

}  // namespace bihive
