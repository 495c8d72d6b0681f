#include "bihive/job/figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/base/version.h"
#include "bihive/image/image_diff.h"
#include "bihive/image/png.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/report_text.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;

std::string folder_of(const std::string& figure) {
  const std::filesystem::path folder = std::filesystem::path(figure).parent_path();
  return folder.empty() ? "." : folder.string();
}

void compare(const PngPixels& a, const PngPixels& b, Verdict& verdict) {
  verdict.same_form = a.width == b.width && a.height == b.height && a.channels == b.channels && a.bits == b.bits;
  if (!verdict.same_form || a.bytes == b.bytes) return;
  const auto size = static_cast<std::size_t>(a.bits / 8);
  const std::size_t pixel_bytes = size * static_cast<std::size_t>(a.channels);
  const auto number = [size](const std::uint8_t* at) { return size == 1 ? at[0] : at[0] << 8 | at[1]; };
  for (std::size_t i = 0; i < a.bytes.size(); i += pixel_bytes) {
    int pixel = 0;
    for (std::size_t k = i; k < i + pixel_bytes; k += size)
      pixel = std::max(pixel, std::abs(number(&a.bytes[k]) - number(&b.bytes[k])));
    if (pixel == 0) continue;
    if (verdict.pixels_differ++ == 0) {
      const auto place = static_cast<std::int64_t>(i / pixel_bytes);
      verdict.x = place % a.width;
      verdict.y = place / a.width;
    }
    verdict.largest = std::max(verdict.largest, pixel);
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

Figure read_figure(const std::string& path) {
  PngFileOfPixels file = value_or_fail(read_png_pixels(path));
  const auto text =
      std::find_if(file.text.begin(), file.text.end(), [](const auto& chunk) { return chunk.first == kLateKeyword; });
  if (text == file.text.end())
    fail({"does not say how it was drawn", path, 0, 0,
          "bihive render writes that into every PNG, unless it is told not to"});
  Result<PictureRecord> record = picture_record_from(text->second);
  if (!record) fail({record.error().message, path, 0, 0, record.error().hint});
  return {std::move(file.pixels), std::move(*record)};
}

PictureRequest request_again(const Figure& figure, const std::string& path, const std::string& input,
                             const std::vector<GivenSetting>& changes) {
  return request_again(figure.record, folder_of(path), input, changes);
}

Verdict verify_figure(const std::string& path, const std::string& input, const std::string& difference,
                      const std::function<PngPixels(const PictureRequest&)>& draw) {
  Verdict verdict;
  verdict.figure = path;
  try {
    const Figure figure = read_figure(path);
    verdict.drawn_by = version_with_commit(figure.record.version, figure.record.commit);
    const PictureRequest request = request_again(figure, path, input, {});
    verdict.changed_files = changed_files(figure.record, request);
    const PngPixels again = draw(request);
    compare(figure.pixels, again, verdict);
    verdict.edited = sha256_of(figure.pixels) != figure.record.pixels_sha256;
    if (!difference.empty() && verdict.same_form)
      value_or_fail(write_png(difference, difference_of(image_of(figure.pixels), image_of(again)).picture, {}));
  } catch (const Failure& failure) {
    if (failure.code == kInterrupted) throw;
    Error error = failure.error;
    if (error.file == path) error.file.clear();
    verdict.error = error.to_string();
  }
  return verdict;
}

std::string sentence_of(const Verdict& verdict) {
  const std::string now = version_with_commit(version(), commit());
  std::string text = escaped(verdict.figure) + ": ";
  if (!verdict.error.empty()) return text + "not drawn: " + verdict.error;
  if (verdict.holds())
    return text + "the same bits" +
           (verdict.drawn_by == now ? "" : ", drawn by " + verdict.drawn_by + ", now by " + now);
  const char* separator = "";
  const auto add = [&](const std::string& reason) {
    text += separator + reason;
    separator = "; ";
  };
  for (const std::string& option : verdict.changed_files)
    add(option == kInputFile ? "the input has other bytes"
                             : "the file of " + setting_name(option) + " has other bytes");
  if (!verdict.same_form) add("the picture has another size or form");
  if (verdict.pixels_differ > 0)
    add(fmt::format("{} pixel{} differ{}, by up to {}, the first at ({}, {})", grouped(verdict.pixels_differ),
                    verdict.pixels_differ == 1 ? "" : "s", verdict.pixels_differ == 1 ? "s" : "", verdict.largest,
                    verdict.x, verdict.y));
  else if (verdict.same_form)
    add("all pixels are the same");
  if (verdict.edited) add("the file's pixels were changed after it was drawn");
  if (verdict.drawn_by != now) add("drawn by " + verdict.drawn_by + ", now by " + now);
  return text;
}

ordered_json json_of(const Verdict& verdict) {
  ordered_json json{{"figure", verdict.figure}, {"verified", verdict.holds()}};
  if (!verdict.error.empty()) {
    json["error"] = verdict.error;
    return json;
  }
  json["drawn_by"] = verdict.drawn_by;
  json["changed_files"] = verdict.changed_files;
  json["same_form"] = verdict.same_form;
  json["pixels_differ"] = verdict.pixels_differ;
  if (verdict.pixels_differ > 0) {
    json["largest_difference"] = verdict.largest;
    json["first_difference"] = {verdict.x, verdict.y};
  }
  json["edited"] = verdict.edited;
  return json;
}

}  // namespace bihive
