#include "bihive/job/figure.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <utility>

#include "bihive/base/path_parts.h"
#include "bihive/base/version.h"
#include "bihive/image/image_diff.h"
#include "bihive/image/png.h"
#include "bihive/image/tiff.h"
#include "bihive/io/packed.h"
#include "bihive/job/failure.h"

namespace bihive {
namespace {

enum class FigureKind { png, tiff, exr, other };

FigureKind kind_of(const std::string& path) {
  const Result<std::string> head = read_head(path);
  const auto begins = [&head](std::string_view bytes) { return head && head->starts_with(bytes); };
  if (begins("\x89PNG")) return FigureKind::png;
  if (begins(std::string_view("II*\0", 4)) || begins(std::string_view("II+\0", 4))) return FigureKind::tiff;
  return begins("\x76\x2f\x31\x01") ? FigureKind::exr : FigureKind::other;
}

// The text of the record; empty: there is none.
std::string read_pixels(const std::string& path, FigurePixels& pixels) {
  const auto text_of = [](const PngText& all) {
    const auto text = std::find_if(all.begin(), all.end(), [](const auto& one) { return one.first == kLateKeyword; });
    return text == all.end() ? std::string() : text->second;
  };
  switch (kind_of(path)) {
    case FigureKind::tiff: {
      TiffFile file = value_or_fail(read_tiff(path));
      pixels.pixels = std::move(file.pixels);
      return file.description.starts_with("{\"record\"") ? file.description : "";
    }
    case FigureKind::exr:
      pixels.exr = value_or_fail(read_exr(path));
      return text_of(pixels.exr->text);
    default: {
      PngFileOfPixels file = value_or_fail(read_png_pixels(path));
      pixels.pixels = std::move(file.pixels);
      return text_of(file.text);
    }
  }
}

// The higher bytes of red, green and blue.
Image image_of(const PngPixels& pixels) {
  Image image{pixels.width, pixels.height, {}};
  const auto size = static_cast<std::size_t>(pixels.bits / 8);
  const std::size_t pixel_bytes = size * static_cast<std::size_t>(pixels.channels);
  for (std::size_t i = 0; i < pixels.bytes.size(); i += pixel_bytes)
    for (std::size_t channel = 0; channel < 3; ++channel) image.rgb.push_back(pixels.bytes[i + channel * size]);
  return image;
}

}  // namespace

bool has_name_of_figure(const std::string& path) {
  const std::string ending = ending_of(path);
  return ending == ".png" || ending == ".tif" || ending == ".tiff" || ending == ".exr";
}

bool looks_like_figure(const std::string& path) {
  return kind_of(path) != FigureKind::other;
}

Figure read_figure(const std::string& path) {
  Figure figure;
  const std::string text = read_pixels(path, figure.pixels);
  if (text.empty())
    fail({kSaysNothing, path, 0, 0, "bihive render writes that into every picture, unless it is told not to"});
  Result<PictureRecord> record = picture_record_from(text);
  if (!record) fail({record.error().message, path, 0, 0, record.error().hint});
  if (!record->film.empty()) fail({"is a film, and one of its pictures is wanted", path, 0, 0, ""});
  figure.record = std::move(*record);
  return figure;
}

PictureRequest request_again(const Figure& figure, const std::string& path, const std::string& input,
                             const std::vector<GivenSetting>& changes) {
  return request_again(figure.record, folder_of(path), input, changes);
}

Verdict verify_figure(const std::string& path, const std::string& input, const std::string& difference,
                      const DrawFigure& draw) {
  Verdict verdict;
  verdict.figure = path;
  try {
    const Figure figure = read_figure(path);
    verdict.drawn_by = version_with_commit(figure.record.version, figure.record.commit);
    verdict.built_in = figure.record.built_in;
    const PictureRequest request = request_again(figure, path, input, {});
    verdict.changed_files = changed_files(figure.record, request);
    const FigurePixels again = draw(request, figure.record.layers);
    compare(figure.pixels, again, verdict);
    verdict.edited = sha256_of(figure.pixels) != figure.record.pixels_sha256;
    if (!difference.empty() && verdict.same_form) {
      if (again.exr) fail({"has numbers, and a picture of differences is one of pixels", path, 0, 0, ""});
      const Image there = image_of(figure.pixels.pixels), now = image_of(again.pixels);
      value_or_fail(write_png(difference, difference_of(there, now).picture, {}));
    }
  } catch (const Failure& failure) {
    note_failure(failure, verdict);
  }
  return verdict;
}

}  // namespace bihive
