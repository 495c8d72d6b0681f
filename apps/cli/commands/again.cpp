// bihive again and bihive verify: pictures drawn once more, by what their files say of how they were made.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "bihive/base/version.h"
#include "bihive/job/failure.h"
#include "bihive/job/figure.h"
#include "bihive/job/messages.h"
#include "bihive/job/methods_text.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/job/report_text.h"
#include "bihive/render/memory.h"
#include "commands/commands.h"
#include "commands/draw_picture.h"
#include "commands/picture_file.h"
#include "commands/render_steps.h"
#include "film/film_record.h"
#include "film/verify_film.h"
#include "support/interrupt.h"
#include "support/outputs.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// Those of a record, which is data from a file.
std::vector<Layer> layers_of(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  const Result<std::vector<Layer>> layers = layers_from_text(text);
  if (!layers) fail({"its record names layers that there are not", "", 0, 0, ""});
  return *layers;
}

// --- bihive verify ------------------------------------------------------------------------------------------------

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

// The rows of channels.
class ChannelsInMemory : public PictureFile {
 public:
  ChannelsInMemory(const PreparedPicture& prepared, const Tracer& tracer) : prepared_(prepared), tracer_(tracer) {
    all.width_px = prepared.settings.width_px;
    all.height_px = prepared.settings.height_px;
    all.pixels = drawn_pixels(prepared.settings);
    all.channels = channels_of(prepared.layers, prepared.settings.transparent);
  }

  Status add(const Film& film, const Tile& pixels) override {
    RenderSettings settings = prepared_.settings;
    settings.crop = pixels;
    const std::vector<Channel> rows =
        draw_layers(prepared_.input.scene, tracer_, settings, prepared_.layers, film, &CancellableSection::token());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Channel& channel = all.channels[i];
      channel.numbers.insert(channel.numbers.end(), rows[i].numbers.begin(), rows[i].numbers.end());
      channel.ids.insert(channel.ids.end(), rows[i].ids.begin(), rows[i].ids.end());
    }
    return Done{};
  }
  Status finish() override {
    std::sort(all.channels.begin(), all.channels.end(),
              [](const Channel& a, const Channel& b) { return a.name < b.name; });
    return Done{};
  }
  double bytes_of_pixel() const override { return 2 * 4 * static_cast<double>(all.channels.size()); }

  ExrForm all;

 private:
  const PreparedPicture& prepared_;
  const Tracer& tracer_;
};

FigurePixels drawn_again(const PictureRequest& request, const std::vector<std::string>& layers) {
  RenderOptions options;
  static_cast<PictureRequest&>(options) = request;
  options.output = "/dev/null";
  options.as_exr = !layers.empty();
  if (options.as_exr) options.layers = layers_of(layers);
  const PreparedPicture prepared = prepare_render(options);
  check_memory_of(prepared.engine, prepared.input, options, prepared.settings);
  const Tile drawn = drawn_pixels(prepared.settings);
  value_or_fail(check_picture_memory(drawn.width(), drawn.height()));
  const Scene& scene = prepared.input.scene;
  const Tracer tracer =
      value_or_fail(Tracer::build(scene, structure_of(prepared.engine), options.tree, prepared.settings.threads));
  RowsInMemory rows(options, prepared);
  std::optional<ChannelsInMemory> channels;
  if (options.as_exr) channels.emplace(prepared, tracer);
  PictureFile& file = channels ? static_cast<PictureFile&>(*channels) : rows;
  const CancellableSection section;
  Progress progress("verifying");
  try {
    draw_picture(scene, tracer, prepared.engine, prepared.settings, prepared.layers, file,
                 [&](double done) { progress.update(done); });
  } catch (const Interrupted&) {
    CancellableSection::leave_if_cancelled();
    throw;
  }
  value_or_fail(file.finish());
  FigurePixels pixels{std::move(rows.all)};
  if (channels) pixels.exr = std::move(channels->all);
  return pixels;
}

std::string name_of_new(const std::string& figure) {
  const fs::path path(figure);
  return fs::path(path).replace_extension("").string() + "-again" + path.extension().string();
}

// Whether it says how it was drawn, or cannot be read.
bool is_figure(const std::string& path) {
  try {
    if (has_name_of_film(path)) return !read_film_record(path).empty();
    read_figure(path);
    return true;
  } catch (const Failure& failure) {
    return failure.error.message != kSaysNothing;
  }
}

// Folders stand for the files in them that say how they were drawn, or cannot be read.
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
      const std::string file = entry.path().string();
      if ((has_name_of_figure(file) || has_name_of_film(file)) && is_figure(file)) inside.push_back(file);
    }
    if (inside.empty()) fail({"there is no picture in it that says how it was drawn", path, 0, 0, ""});
    std::sort(inside.begin(), inside.end());
    figures.insert(figures.end(), inside.begin(), inside.end());
  }
  return figures;
}

}  // namespace

void run_again(const AgainOptions& options) {
  if (has_name_of_film(options.figure)) {
    FilmOptions film = film_again(options.figure, options.changes);
    if (film.picture.output.empty()) film.picture.output = name_of_new(options.figure);
    check_outputs({film.picture.output}, {options.figure});
    run_film(film);
    return;
  }
  const Figure figure = read_figure(options.figure);
  RenderOptions again = options.changes;
  static_cast<PictureRequest&>(again) =
      request_again(figure, options.figure, options.changes.input.input, options.changes.given);
  if (again.output.empty()) again.output = name_of_new(options.figure);
  const std::vector<std::string>& layers = figure.record.layers;
  if (!layers.empty() && is_exr(again.output)) again.layers = layers_of(layers);
  check_outputs({again.output}, {options.figure});
  run_render(again);
}

bool run_verify(const VerifyOptions& asked) {
  // An input may come last.
  VerifyOptions options = asked;
  std::error_code none;
  if (const std::string& last = asked.figures.back(); asked.figures.size() > 1 && !has_name_of_figure(last) &&
                                                      !has_name_of_film(last) && !fs::is_directory(last, none)) {
    options.input = last;
    options.figures.pop_back();
  }
  const std::vector<std::string> figures = figures_of(options.figures);
  if (!options.difference.empty()) {
    if (figures.size() != 1) fail_usage("--difference is of one figure", "verify one at a time");
    check_outputs({options.difference}, {figures.front(), options.input});
  }

  const auto film = std::find_if(figures.begin(), figures.end(), has_name_of_film);
  if (film != figures.end() && (options.methods || !options.difference.empty()))
    fail({options.methods ? "is a film, and --methods is of pictures" : "is a film, and --difference is of pictures",
          *film, 0, 0, ""});
  if (options.methods) {
    for (const std::string& path : figures) {
      const Figure figure = read_figure(path);
      RenderOptions request;
      static_cast<PictureRequest&>(request) = request_again(figure, path, options.input, {});
      request.output = "/dev/null";
      if (!changed_files(figure.record, request).empty())
        fail({"was drawn from files with other bytes than these", path, 0, 0, "bihive verify names them"});
      const PreparedPicture prepared = prepare_render(request);
      print(methods_text(request, prepared.described, prepared.input.scene, figure.record));
    }
    return true;
  }

  // Each for itself: one that cannot be drawn does not keep the others from it.
  ordered_json verdicts = ordered_json::array();
  std::int64_t good = 0;
  for (const std::string& figure : figures) {
    const Verdict verdict = has_name_of_film(figure)
                                ? verify_film(figure, options.input, drawn_again)
                                : verify_figure(figure, options.input, options.difference, drawn_again);
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
