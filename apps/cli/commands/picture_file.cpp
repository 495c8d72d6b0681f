#include "commands/picture_file.h"

#include <algorithm>
#include <array>

#include "bihive/base/path_parts.h"
#include "bihive/base/setting_name.h"
#include "bihive/base/sha256.h"
#include "bihive/base/write_file.h"
#include "bihive/image/exr.h"
#include "bihive/image/png.h"
#include "bihive/image/tiff.h"
#include "bihive/job/failure.h"
#include "bihive/job/picture_record.h"
#include "bihive/job/report_text.h"
#include "bihive/render/finished_pixels.h"
#include "commands/commands.h"
#include "support/interrupt.h"
#include "support/outputs.h"

namespace bihive::cli {
namespace {

// The settings of a band of the picture.
RenderSettings settings_of(const RenderSettings& settings, const Tile& pixels) {
  RenderSettings of_part = settings;
  of_part.crop = pixels;
  return of_part;
}

// The record of a picture whose pixels come by rows.
class RecordOfRows {
 public:
  explicit RecordOfRows(const RenderOptions& options) {
    if (options.metadata) record_ = record_of(options, "");
  }
  void add(const PngPixels& rows) {
    if (record_) sha_.add({reinterpret_cast<const char*>(rows.bytes.data()), rows.bytes.size()});
  }
  /// After the last row; unset: the file has none.
  std::optional<PictureRecord> finish() {
    if (record_) record_->pixels_sha256 = sha_.digits();
    return std::move(record_);
  }

 private:
  std::optional<PictureRecord> record_;
  Sha256 sha_;
};

class PngFileOfRows : public PictureFile {
 public:
  PngFileOfRows(PictureToWrite picture, PngEncoder encoder)
      : picture_(std::move(picture)),
        encoder_(std::move(encoder)),
        output_(output_path(picture_.options.output)),
        stream_(is_stream(output_)),
        hash_(drawn_pixels(picture_.settings).width(), drawn_pixels(picture_.settings).height()),
        record_(picture_.options) {}

  Status add(const Film& film, const Tile& pixels) override {
    const PngPixels rows = png_rows(picture_.options, picture_.scene, picture_.settings, film, pixels);
    hash_.add(rows.bytes);
    record_.add(rows);
    if (Status status = encoder_.add(rows); !status) return status;
    return write();
  }

  Status finish() override {
    PngText late;
    if (const std::optional<PictureRecord> record = record_.finish()) late.emplace_back(kLateKeyword, to_text(*record));
    if (Status status = encoder_.finish(late); !status) return status;
    if (Status status = write(); !status) return status;
    if (stream_) return file_->finish();
    const WritingSection section;
    return file_->finish();
  }

  std::optional<std::uint64_t> hash() const override { return hash_.value(); }
  // Memory as pixels and, at worst, as bytes of the file.
  double bytes_of_pixel() const override { return (picture_.settings.transparent ? 4 : 3) * (bits() / 8.0) * 2; }

 private:
  int bits() const { return static_cast<int>(picture_.options.bits.value_or(8)); }

  // The file is created with its first rows, so that a small picture is drawn before it exists.
  Status write() {
    const std::string bytes = encoder_.take_bytes();
    const StreamSection nobody_may_read(stream_);
    if (!file_) {
      Result<GrowingFile> file = GrowingFile::begin(output_);
      if (!file) return file.error();
      file_.emplace(std::move(*file));
      removed_.emplace(file_->path_aside());
    }
    return file_->append(bytes);
  }

  PictureToWrite picture_;
  PngEncoder encoder_;
  std::string output_;
  bool stream_;
  std::optional<GrowingFile> file_;
  std::optional<RemovedWhenEnded> removed_;
  PictureHash hash_;
  RecordOfRows record_;
};

class TiffFileOfRows : public PictureFile {
 public:
  explicit TiffFileOfRows(PictureToWrite picture)
      : picture_(std::move(picture)),
        hash_(drawn_pixels(picture_.settings).width(), drawn_pixels(picture_.settings).height()),
        record_(picture_.options) {}

  Status add(const Film& film, const Tile& pixels) override {
    const PngPixels rows = png_rows(picture_.options, picture_.scene, picture_.settings, film, pixels);
    hash_.add(rows.bytes);
    record_.add(rows);
    if (!writer_)
      if (Status status = begin(rows); !status) return status;
    return writer_->add(rows);
  }
  Status finish() override {
    const std::optional<PictureRecord> record = record_.finish();
    const WritingSection section;
    return writer_->finish(record ? to_text_with_settings(*record, text_named("Settings")) : std::string());
  }
  std::optional<std::uint64_t> hash() const override { return hash_.value(); }
  double bytes_of_pixel() const override {
    return (picture_.settings.transparent ? 4 : 3) * (static_cast<double>(picture_.options.bits.value_or(8)) / 8.0);
  }

 private:
  Status begin(const PngPixels& rows) {
    const Tile drawn = drawn_pixels(picture_.settings);
    TiffForm form{drawn.width(), drawn.height(), rows.channels, rows.bits, picture_.options.dots_per_inch, "", ""};
    if (picture_.options.metadata) form.software = text_named("Software");
    Result<TiffWriter> writer = TiffWriter::begin(picture_.options.output, form);
    if (!writer) return writer.error();
    writer_.emplace(std::move(*writer));
    removed_.emplace(writer_->path_aside());
    return Done{};
  }

  std::string text_named(const std::string& wanted) const {
    for (const auto& [name, value] : picture_.text)
      if (name == wanted) return value;
    return "";
  }

  PictureToWrite picture_;
  PictureHash hash_;
  RecordOfRows record_;
  std::optional<TiffWriter> writer_;
  std::optional<RemovedWhenEnded> removed_;
};

class ExrFileOfRows : public PictureFile {
 public:
  explicit ExrFileOfRows(PictureToWrite picture) : picture_(std::move(picture)) {}

  Status add(const Film& film, const Tile& pixels) override {
    if (!writer_)
      if (Status status = begin(); !status) return status;
    const std::vector<Channel> rows =
        draw_layers(picture_.scene, picture_.tracer, settings_of(picture_.settings, pixels), picture_.layers, film,
                    &CancellableSection::token());
    if (picture_.options.metadata) hash_.add(rows, pixels.width());
    return writer_->add(rows);
  }
  Status finish() override {
    if (picture_.options.metadata)
      if (Status status = writer_->replace_text(kUnknownSha256, hash_.digits()); !status) return status;
    const WritingSection section;
    return writer_->finish();
  }
  double bytes_of_pixel() const override {
    constexpr double kBytesOfNumber = 4;
    return kBytesOfNumber * static_cast<double>(channels_of(picture_.layers, picture_.settings.transparent).size());
  }

 private:
  Status begin() {
    const RenderSettings& settings = picture_.settings;
    if (picture_.options.metadata) {
      PictureRecord record = record_of(picture_.options, kUnknownSha256);
      for (const Layer& layer : picture_.layers) record.layers.push_back(name_of_layer(layer));
      picture_.text.emplace_back(kLateKeyword, to_text(record));
    } else {
      picture_.text.clear();
    }
    const ExrForm form{settings.width_px,      settings.height_px,
                       drawn_pixels(settings), channels_of(picture_.layers, settings.transparent),
                       picture_.text,          picture_.options.dots_per_inch};
    Result<ExrWriter> writer = ExrWriter::begin(picture_.options.output, form);
    if (!writer) return writer.error();
    writer_.emplace(std::move(*writer));
    removed_.emplace(writer_->path_aside());
    return Done{};
  }

  // The header comes before the pixels.
  inline static const std::string kUnknownSha256 = std::string(64, '?');

  PictureToWrite picture_;
  ChannelsHash hash_;
  std::optional<ExrWriter> writer_;
  std::optional<RemovedWhenEnded> removed_;
};

bool is_srgb(const PictureToWrite& picture) {
  return picture.settings.view == View::shaded && picture.scene.picture.transfer == Transfer::srgb;
}

}  // namespace

PngPixels png_rows(const PictureRequest& options, const Scene& scene, const RenderSettings& settings, const Film& film,
                   const Tile& pixels) {
  return finished_pixels(film, scene, settings_of(settings, pixels), static_cast<int>(options.bits.value_or(8)));
}

void check_picture_name(const std::string& output) {
  constexpr std::array kOthers{".jpg", ".jpeg", ".jpe", ".jp2",  ".jxl", ".ppm", ".pgm",  ".pbm",
                               ".pnm", ".pam",  ".bmp", ".tga",  ".hdr", ".pfm", ".svg",  ".pdf",
                               ".eps", ".ps",   ".psd", ".webp", ".ico", ".xpm", ".avif", ".heic"};
  constexpr std::array kFilms{".mp4", ".webm", ".gif", ".apng"};
  const std::string ending = ending_of(output);
  if (std::find(kFilms.begin(), kFilms.end(), ending) != kFilms.end())
    fail_usage("bihive render draws one picture, and " + ending + " is a film", "make films by bihive film");
  if (std::find(kOthers.begin(), kOthers.end(), ending) == kOthers.end()) return;
  fail_usage("bihive writes PNG, TIFF and OpenEXR, not " + ending, "let the output end in .png, .tif or .exr");
}

bool is_exr(const std::string& output) {
  return ending_of(output) == ".exr";
}

bool is_tiff(const std::string& output) {
  const std::string ending = ending_of(output);
  return ending == ".tif" || ending == ".tiff";
}

std::vector<Layer> choose_layers(const RenderOptions& options, const Scene& scene, RenderSettings& settings) {
  if (is_tiff(options.output) && !can_write_tiff())
    fail_environment({"this build of bihive has no TIFF", options.output, 0, 0,
                      "install libtiff-dev (scripts/setup demo) and build again, or write a PNG"});
  if (!options.as_exr && !is_exr(options.output)) {
    if (options.layers) fail_setting("layers", " need a file that holds them", "let the output end in .exr");
    return {};
  }
  if (!can_write_exr())
    fail_environment({"this build of bihive has no OpenEXR", options.output, 0, 0,
                      "install libopenexr-dev (scripts/setup demo) and build again, or write a PNG"});
  if (options.bits)
    fail_setting("bits", " is for PNG: OpenEXR gets numbers of 32 bits with a floating point",
                 "leave " + setting_name("bits") + " out");
  if (settings.view != View::shaded)
    fail_usage("OpenEXR holds light and layers of numbers, not the colours of " + setting_name("view"),
               "name layers: " + setting_name("layers") + " normal,depth,id");
  const Overrides& user = options.picture;
  if (settings.stereo.form != StereoForm::none)
    fail_setting("stereo", " joins two pictures for the eye, and OpenEXR has light and layers of one",
                 "draw a PNG, or one picture for each " + setting_name("eye"));
  if (user.has("matte"))
    fail_setting("matte", " is for programs that mix values of the screen, and OpenEXR has light",
                 "leave it out, or write a PNG");
  if (user.is_on("legend") || user.is_on("scale_bar") || user.is_on("axes") || user.has("title"))
    fail_usage("labels are drawn over the pixels of a PNG, and OpenEXR has light instead",
               "leave them out, or write a PNG too");
  settings.labels = {};
  PictureSettings of_user;
  user.apply_to(of_user);
  settings.tone = of_user.tone;  // not the style's
  std::vector<Layer> layers = options.layers.value_or(std::vector<Layer>{Layer{}});
  if (const Status status = check_layers(scene, layers); !status)
    fail_setting("layers", ": " + status.error().message, status.error().hint);
  return layers;
}

std::unique_ptr<PictureFile> open_picture(PictureToWrite picture) {
  const RenderOptions& options = picture.options;
  if (is_exr(options.output)) return std::make_unique<ExrFileOfRows>(std::move(picture));
  if (is_tiff(options.output)) return std::make_unique<TiffFileOfRows>(std::move(picture));
  const Tile drawn = drawn_pixels(picture.settings);
  PngText text;
  if (options.metadata)
    for (const auto& [name, value] : picture.text) text.emplace_back(name, latin1(value));
  PngEncoder encoder = value_or_fail(
      PngEncoder::begin(drawn.width(), drawn.height(), picture.settings.transparent ? 4 : 3,
                        static_cast<int>(options.bits.value_or(8)), text, options.dots_per_inch, is_srgb(picture)));
  return std::make_unique<PngFileOfRows>(std::move(picture), std::move(encoder));
}

}  // namespace bihive::cli
