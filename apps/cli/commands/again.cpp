// bihive again and bihive verify: pictures drawn once more, by what their files say of how they were made.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bihive/base/setting_name.h"
#include "bihive/base/version.h"
#include "bihive/image/image_diff.h"
#include "bihive/image/png.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/picture_record.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/job/report_text.h"
#include "bihive/render/memory.h"
#include "commands/commands.h"
#include "commands/draw_picture.h"
#include "commands/picture_file.h"
#include "commands/render_steps.h"
#include "support/interrupt.h"
#include "support/outputs.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

bool is_png(const std::string& path) {
  return fs::path(path).extension() == ".png";
}

std::string folder_of(const std::string& figure) {
  const fs::path folder = fs::path(figure).parent_path();
  return folder.empty() ? "." : folder.string();
}

struct Figure {
  PngPixels pixels;
  PictureRecord record;
};

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

// --- bihive verify ------------------------------------------------------------------------------------------------

struct Verdict {
  std::string figure;
  std::string drawn_by;                    // version and commit
  std::string error;                       // why it could not be drawn; empty: it was
  std::vector<std::string> changed_files;  // options of files with other bytes
  std::int64_t pixels_differ = 0;
  int largest = 0;              // difference of a channel, in its own steps
  std::int64_t x = -1, y = -1;  // the first pixel that differs
  bool edited = false;          // the file's pixels are not those that its record names
  bool same_form = true;        // size, channels and bits

  bool holds() const { return error.empty() && changed_files.empty() && pixels_differ == 0 && same_form && !edited; }
};

// The rows of a picture, in memory.
class RowsInMemory : public PictureFile {
 public:
  RowsInMemory(const RenderOptions& options, const PreparedPicture& prepared)
      : options_(options), prepared_(prepared) {}

  Status add(const Film& film, const Tile& pixels) override {
    PngPixels rows = png_rows(options_, prepared_.input.scene, prepared_.settings, film, pixels);
    const int height = all.height;
    if (height == 0) {
      all = std::move(rows);
      return Done{};
    }
    all.bytes.insert(all.bytes.end(), rows.bytes.begin(), rows.bytes.end());
    all.height = height + rows.height;
    return Done{};
  }
  Status finish() override { return Done{}; }
  double bytes_of_pixel() const override { return 2 * 4 * (static_cast<double>(options_.bits.value_or(8)) / 8); }

  PngPixels all;

 private:
  const RenderOptions& options_;
  const PreparedPicture& prepared_;
};

PngPixels drawn_again(const PictureRequest& request) {
  RenderOptions options;
  static_cast<PictureRequest&>(options) = request;
  options.output = "/dev/null";
  const PreparedPicture prepared = prepare_render(options);
  check_memory_of(prepared.engine, prepared.input, options, prepared.settings);
  const Tile drawn = drawn_pixels(prepared.settings);
  value_or_fail(check_picture_memory(drawn.width(), drawn.height()));
  const Scene& scene = prepared.input.scene;
  const Tracer tracer =
      value_or_fail(Tracer::build(scene, structure_of(prepared.engine), options.tree, prepared.settings.threads));
  RowsInMemory rows(options, prepared);
  const CancellableSection section;
  Progress progress("verifying");
  try {
    draw_picture(scene, tracer, prepared.engine, prepared.settings, prepared.layers, rows,
                 [&](double done) { progress.update(done); });
  } catch (const Interrupted&) {
    CancellableSection::leave_if_cancelled();
    throw;
  }
  return std::move(rows.all);
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

Verdict verdict_on(const std::string& path, const VerifyOptions& options) {
  Verdict verdict;
  verdict.figure = path;
  try {
    const Figure figure = read_figure(path);
    verdict.drawn_by = version_with_commit(figure.record.version, figure.record.commit);
    const PictureRequest request = request_again(figure.record, folder_of(path), options.input, {});
    verdict.changed_files = changed_files(figure.record, request);
    const PngPixels again = drawn_again(request);
    compare(figure.pixels, again, verdict);
    verdict.edited = sha256_of(figure.pixels) != figure.record.pixels_sha256;
    if (!options.difference.empty() && verdict.same_form)
      value_or_fail(write_png(options.difference, difference_of(image_of(figure.pixels), image_of(again)).picture, {}));
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

// Folders stand for the PNG files in them that say how they were drawn, or cannot be read.
std::vector<std::string> figures_of(const std::vector<std::string>& paths) {
  std::vector<std::string> figures;
  for (const std::string& path : paths) {
    std::error_code none;
    if (!fs::is_directory(path, none)) {
      figures.push_back(path);
      continue;
    }
    std::vector<std::string> inside;
    for (const fs::directory_entry& entry : fs::directory_iterator(path, none)) {
      if (!is_png(entry.path().string())) continue;
      const Result<PngFile> file = read_png(entry.path().string());
      if (!file || std::any_of(file->text.begin(), file->text.end(),
                               [](const auto& chunk) { return chunk.first == kLateKeyword; }))
        inside.push_back(entry.path().string());
    }
    if (inside.empty()) fail({"there is no picture in it that says how it was drawn", path, 0, 0, ""});
    std::sort(inside.begin(), inside.end());
    figures.insert(figures.end(), inside.begin(), inside.end());
  }
  return figures;
}

}  // namespace

void run_again(const AgainOptions& options) {
  const Figure figure = read_figure(options.figure);
  RenderOptions again = options.changes;
  static_cast<PictureRequest&>(again) =
      request_again(figure.record, folder_of(options.figure), options.changes.input.input, options.changes.given);
  if (again.output.empty()) again.output = fs::path(options.figure).replace_extension("").string() + "-again.png";
  check_outputs({again.output}, {options.figure});
  run_render(again);
}

bool run_verify(const VerifyOptions& asked) {
  // An input may come last.
  VerifyOptions options = asked;
  std::error_code none;
  if (const std::string& last = asked.figures.back();
      asked.figures.size() > 1 && !is_png(last) && !fs::is_directory(last, none)) {
    options.input = last;
    options.figures.pop_back();
  }
  const std::vector<std::string> figures = figures_of(options.figures);
  if (!options.difference.empty()) {
    if (figures.size() != 1) fail_usage("--difference is of one figure", "verify one at a time");
    check_outputs({options.difference}, {figures.front(), options.input});
  }

  // Each for itself: one that cannot be drawn does not keep the others from it.
  ordered_json verdicts = ordered_json::array();
  std::int64_t good = 0;
  for (const std::string& figure : figures) {
    const Verdict verdict = verdict_on(figure, options);
    good += verdict.holds() ? 1 : 0;
    if (options.json)
      verdicts.push_back(json_of(verdict));
    else
      print(sentence_of(verdict) + "\n");
  }
  const auto count = static_cast<std::int64_t>(figures.size());
  if (options.json)
    print(as_text({{"version", version_with_commit(version(), commit())}, {"figures", verdicts}}, 2) + "\n");
  else if (count > 1)
    print(fmt::format("{} of {} figures have the same bits\n", good, count));
  return good == count;
}

}  // namespace bihive::cli
