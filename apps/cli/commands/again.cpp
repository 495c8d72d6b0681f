// bihive again and bihive verify: pictures drawn once more, by what their files say of how they were made.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "bihive/base/version.h"
#include "bihive/image/png.h"
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
#include "support/interrupt.h"
#include "support/outputs.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

bool is_png(const std::string& path) {
  return fs::path(path).extension() == ".png";
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
      request_again(figure, options.figure, options.changes.input.input, options.changes.given);
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
    const Verdict verdict = verify_figure(figure, options.input, options.difference, drawn_again);
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
