#include "commands/render_steps.h"

#include <fmt/format.h>

#include <utility>

#include "bihive/base/timer.h"
#include "bihive/job/choose_look.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/methods_text.h"
#include "bihive/job/picture_record.h"
#include "bihive/job/prepare_picture.h"
#include "bihive/job/scene_request.h"
#include "bihive/simd/target.h"
#include "commands/names.h"
#include "film/film_plan.h"
#include "support/communicator.h"
#include "support/outputs.h"
#include "support/peak_memory.h"
#include "support/request_files.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

void check_output(const RenderOptions& options) {
  check_picture_name(options.output);
  check_outputs(outputs_of(options), inputs_of(options));
  if (options.json && on_standard_output({options.output}))
    fail_usage("--json prints where -o " + options.output + " writes the picture", "write the picture into a file");
}

ordered_json report_json(const RenderOptions& options, const FinishedPicture& finished) {
  const Scene& scene = finished.prepared.input.scene;
  const RenderEngine engine = finished.prepared.engine;
  const Tile pixels = drawn_pixels(finished.prepared.settings);
  ordered_json json = ordered_json::object();
  json["output"] = options.output;
  json["scene"] = scene.name;
  json["seed"] = scene.seed ? ordered_json(*scene.seed) : ordered_json();
  json["size"] = fmt::format("{}x{}", pixels.width(), pixels.height());
  json["view"] = name_of(kViews, finished.prepared.settings.view);
  json["engine"] = is_gpu(engine) ? name_of(kRenderEngines, engine) : name_of(kEngines, finished.engine);
  json["target"] = finished.engine == Engine::wide ? ordered_json(active_target()) : ordered_json();
  if (is_gpu(engine)) json["gpu"] = finished.drawn.gpu;
  json["spheres"] = finished.spheres;
  return json;
}

// The picture in words, for a paper.
std::string methods_of(const RenderOptions& options, const PreparedPicture& prepared) {
  return methods_text(options, prepared.described, prepared.input.scene, record_of(options, ""));
}

}  // namespace

RenderOptions with_film(const RenderOptions& asked) {
  RenderOptions options = asked;
  if (asked.film.empty())
    take_saved_request(options);
  else
    take_film(options, read_film_plan(asked.film));
  return options;
}

PreparedPicture prepare_render(const RenderOptions& options, const LoadPicture& load) {
  const RenderEngine engine = choose_engine(options);
  if (leads()) check_output(options);

  // Load the scene and apply the user's options to it.
  const bool named = !options.style.name.empty();
  const Timer reading;
  Style style = choose_style(options.style);
  if (options.fixed) fix_range(style, options.fixed->range_of_style);
  LoadedPicture loaded =
      load ? load(style) : LoadedPicture{load_input(options.input, LooksOfFile::keep, &style, /*asked_for=*/named)};
  Input& input = loaded.input;
  const WholeSet* const whole = loaded.whole ? &*loaded.whole : nullptr;
  if (leads()) check_outputs(outputs_of(options), input.files);
  RenderSettings settings = prepare_picture(options, engine, input, whole);
  std::vector<Layer> layers = choose_layers(options, input.scene, settings);
  ordered_json described = settings_json(options, settings, input.scene, layers);
  if (whole != nullptr) described["spheres"] = whole->count;
  const bool can_share = !is_gpu(engine) && !is_drawn_whole(settings) && (layers.empty() || has_radiance(layers));
  return {engine, std::move(input), settings, std::move(layers), std::move(described), can_share, reading.elapsed_ms()};
}

void report_render(const RenderOptions& options, const FinishedPicture& finished) {
  const Drawn& drawn = finished.drawn;
  const Scene& scene = finished.prepared.input.scene;
  const double mray_per_s = drawn.render_ms > 0 ? static_cast<double>(drawn.all_rays) / drawn.render_ms / 1000 : 0;
  if (!options.json) {
    const Tile pixels = drawn_pixels(finished.prepared.settings);
    const std::string copies = scene.spheres.has_images()
                                   ? fmt::format(" in {} copies", grouped(scene.spheres.images().count()))
                                   : std::string();
    print_report(fmt::format("{}: {} x {}, {} spheres{}; tree {}, picture {} ({:.3g} Mray/s of all kinds)\n",
                             escaped(options.output), pixels.width(), pixels.height(), grouped(finished.spheres),
                             copies, readable_ms(finished.build_ms), readable_ms(drawn.render_ms), mray_per_s),
                 {options.output});
    if (options.methods) print_report("\n" + methods_of(options, finished.prepared), {options.output});
    return;
  }
  ordered_json json = report_json(options, finished);
  json["settings"] = finished.prepared.described;
  json["rays"] = drawn.rays;
  if (!drawn.exchange.is_null()) json["exchange"] = drawn.exchange;
  json["read_ms"] = finished.prepared.read_ms;
  json["build_ms"] = finished.build_ms;
  json["render_ms"] = drawn.render_ms;
  json["write_ms"] = finished.write_ms;
  json["mray_per_s"] = mray_per_s;
  json["peak_memory_bytes"] = peak_memory_bytes();
  if (const auto hash = finished.file.hash()) json["picture_hash"] = fmt::format("{:016x}", *hash);
  json["warnings"] = finished.prepared.input.warnings;
  if (options.methods) json["methods"] = methods_of(options, finished.prepared);
  print(as_text(json, 2) + "\n");
}

}  // namespace bihive::cli
