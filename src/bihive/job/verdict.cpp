#include "bihive/job/verdict.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "bihive/base/setting_name.h"
#include "bihive/base/version.h"
#include "bihive/job/messages.h"
#include "bihive/job/picture_record.h"
#include "bihive/job/report_text.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;

// A pixel that differs by this.
void count(std::int64_t place, int width, double difference, Verdict& verdict) {
  if (verdict.pixels_differ++ == 0) {
    verdict.x = place % width;
    verdict.y = place / width;
  }
  verdict.largest = std::max(verdict.largest, difference);
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
    if (pixel != 0) count(static_cast<std::int64_t>(i / pixel_bytes), a.width, pixel, verdict);
  }
}

// Whether the bits are equal, those of NaN too.
bool same_bits(float a, float b) {
  std::uint32_t bits_a = 0, bits_b = 0;
  std::memcpy(&bits_a, &a, sizeof(a));
  std::memcpy(&bits_b, &b, sizeof(b));
  return bits_a == bits_b;
}

// 0: the same bits.
double difference_at(const Channel& a, const Channel& b, std::size_t i) {
  if (a.of_ids) return std::abs(static_cast<double>(a.ids[i]) - static_cast<double>(b.ids[i]));
  if (same_bits(a.numbers[i], b.numbers[i])) return 0;
  const double difference = std::abs(static_cast<double>(a.numbers[i]) - static_cast<double>(b.numbers[i]));
  return difference > 0 ? difference : std::numeric_limits<double>::infinity();
}

void compare(const ExrForm& a, const ExrForm& b, Verdict& verdict) {
  const auto same_channel = [](const Channel& one, const Channel& other) {
    return one.name == other.name && one.of_ids == other.of_ids && one.numbers.size() == other.numbers.size() &&
           one.ids.size() == other.ids.size();
  };
  const Tile &of_a = a.pixels, &of_b = b.pixels;
  verdict.same_form =
      a.width_px == b.width_px && a.height_px == b.height_px && of_a.x0 == of_b.x0 && of_a.y0 == of_b.y0 &&
      of_a.x1 == of_b.x1 && of_a.y1 == of_b.y1 &&
      std::equal(a.channels.begin(), a.channels.end(), b.channels.begin(), b.channels.end(), same_channel);
  if (!verdict.same_form) return;
  const auto count_of_pixels = static_cast<std::size_t>(of_a.width()) * static_cast<std::size_t>(of_a.height());
  for (std::size_t i = 0; i < count_of_pixels; ++i) {
    double pixel = 0;
    for (std::size_t k = 0; k < a.channels.size(); ++k)
      pixel = std::max(pixel, difference_at(a.channels[k], b.channels[k], i));
    if (pixel != 0) count(static_cast<std::int64_t>(i), of_a.width(), pixel, verdict);
  }
}

}  // namespace

void compare(const FigurePixels& a, const FigurePixels& b, Verdict& verdict) {
  if (a.exr.has_value() != b.exr.has_value())
    verdict.same_form = false;
  else if (a.exr)
    compare(*a.exr, *b.exr, verdict);
  else
    compare(a.pixels, b.pixels, verdict);
}

std::string sha256_of(const FigurePixels& figure) {
  if (!figure.exr) return sha256_of(figure.pixels);
  ChannelsHash hash;
  hash.add(figure.exr->channels, figure.exr->pixels.width());
  return hash.digits();
}

void note_failure(const Failure& failure, Verdict& verdict) {
  if (failure.code == kInterrupted) throw failure;
  Error error = failure.error;
  if (error.file == verdict.figure) error.file.clear();
  verdict.error = error.to_string();
}

std::string sentence_of(const Verdict& verdict) {
  return escaped(verdict.figure) + ": " + judgement_of(verdict);
}

std::string judgement_of(const Verdict& verdict) {
  const std::string now = version_with_commit(version(), commit());
  if (!verdict.error.empty()) return "not drawn: " + verdict.error;
  const bool is_film = verdict.pictures > 0;
  const std::string coded =
      verdict.coded ? " before coding; what the file shows is coded with loss, and not compared" : "";
  if (verdict.holds())
    return "the same bits" + (is_film ? " in all " + grouped(verdict.pictures) + " pictures" + coded : "") +
           (verdict.drawn_by == now ? "" : ", drawn by " + verdict.drawn_by + ", now by " + now);
  std::string text;
  const char* separator = "";
  const auto add = [&](const std::string& reason) {
    text += separator + reason;
    separator = "; ";
  };
  for (const std::string& option : verdict.changed_files)
    if (option != kInputFile)
      add("the file of " + setting_name(option) + " has other bytes");
    else
      add(verdict.built_in.empty() ? "the input has other bytes"
                                   : "the input is not the built-in scene " + verdict.built_in);
  if (!verdict.same_form) add("the picture has another size or form");
  if (verdict.pixels_differ > 0)
    add(fmt::format("{} pixel{} differ{}, by up to {:.6g}, the first at ({}, {})", grouped(verdict.pixels_differ),
                    verdict.pixels_differ == 1 ? "" : "s", verdict.pixels_differ == 1 ? "s" : "", verdict.largest,
                    verdict.x, verdict.y));
  else if (verdict.pictures_differ > 0)
    add(fmt::format("{} of {} pictures differ, the first is number {}", grouped(verdict.pictures_differ),
                    grouped(verdict.pictures), verdict.first_picture));
  else if (is_film)
    add("all pictures are the same" + coded);
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
  if (verdict.pictures > 0) {
    json["pictures"] = verdict.pictures;
    json["pictures_differ"] = verdict.pictures_differ;
    if (verdict.pictures_differ > 0) json["first_different_picture"] = verdict.first_picture;
    json["before_coding"] = verdict.coded;
    json["edited"] = verdict.edited;
    return json;
  }
  json["same_form"] = verdict.same_form;
  json["pixels_differ"] = verdict.pixels_differ;
  if (verdict.pixels_differ > 0) {
    const bool is_whole = verdict.largest == std::floor(verdict.largest) && verdict.largest < 65536;
    json["largest_difference"] =
        is_whole ? ordered_json(static_cast<int>(verdict.largest)) : ordered_json(verdict.largest);
    json["first_difference"] = {verdict.x, verdict.y};
  }
  json["edited"] = verdict.edited;
  return json;
}

}  // namespace bihive
