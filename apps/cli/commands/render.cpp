// bihive render: from an input to a picture.

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "bihive/base/timer.h"
#include "bihive/simd/target.h"
#include "commands/choose_look.h"
#include "commands/commands.h"
#include "commands/draw_picture.h"
#include "commands/draw_with_team.h"
#include "commands/names.h"
#include "commands/picture_file.h"
#include "commands/picture_settings.h"
#include "film/film_plan.h"
#include "support/failure.h"
#include "support/interrupt.h"
#include "support/messages.h"
#include "support/outputs.h"
#include "support/peak_memory.h"
#include "support/team.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

void check_output(const RenderOptions& options) {
  check_picture_name(options.output);
  check_outputs({options.output}, {file_of(options.input), options.style.name, options.looks.element_colours});
  if (options.json && on_standard_output({options.output}))
    fail_usage("--json prints where -o " + options.output + " writes the picture", "write the picture into a file");
}

ordered_json report_json(const RenderOptions& options, const Input& input, const RenderSettings& settings,
                         RenderEngine engine, const Tracer& tracer, const Drawn& drawn) {
  const Scene& scene = input.scene;
  const Tile pixels = drawn_pixels(settings);
  ordered_json json = ordered_json::object();
  json["output"] = options.output;
  json["scene"] = scene.name;
  json["seed"] = scene.seed ? ordered_json(*scene.seed) : ordered_json();
  json["size"] = fmt::format("{}x{}", pixels.width(), pixels.height());
  json["view"] = name_of(kViews, settings.view);
  json["engine"] = is_gpu(engine) ? name_of(kRenderEngines, engine) : name_of(kEngines, tracer.engine());
  json["target"] = tracer.engine() == Engine::wide ? ordered_json(active_target()) : ordered_json();
  if (is_gpu(engine)) json["gpu"] = drawn.gpu;
  json["spheres"] = scene.spheres.size();
  return json;
}

// Other engines, layers and views are drawn by rank 0 alone.
bool can_share(RenderEngine engine, const RenderSettings& settings, const std::vector<Layer>& layers) {
  return !is_gpu(engine) && !is_drawn_whole(settings.view) && (layers.empty() || has_radiance(layers));
}

}  // namespace

void run_render(const RenderOptions& asked) {
  RenderOptions options = asked;
  if (!asked.film.empty()) take_film(options, read_film_plan(asked.film));
  const RenderEngine engine = choose_engine(options);
  if (leads()) check_output(options);

  // Load the scene and apply the user's options to it.
  const bool named = !options.style.name.empty();
  const Timer reading;
  Style style = choose_style(options.style);
  if (options.fixed) fix_range(style, options.fixed->range_of_style);
  Input input = load_input(options.input, LooksOfFile::keep, &style, /*asked_for=*/named);
  if (leads()) check_outputs({options.output}, input.files);
  RenderSettings settings = prepare_picture(options, engine, input);
  const Scene& scene = input.scene;
  const std::vector<Layer> layers = choose_layers(options, scene, settings);
  check_memory_of(engine, input, options, settings);
  const double read_ms = reading.elapsed_ms();

  // Build, render, write.
  const Tracer tracer = value_or_fail(Tracer::build(scene, structure_of(engine), options.tree, settings.threads));
  const Timer drawing;
  const ordered_json described = settings_json(options, settings, scene, layers);
  const std::unique_ptr<PictureFile> file =
      leads() ? open_picture({options, scene, tracer, settings, layers, text_of(scene, described)}) : nullptr;
  // Nothing may fail between this and the drawing, for the other ranks wait for rank 0 there.
  if (team() != nullptr) team()->agree(fingerprints_of(scene, described.dump()));
  const Drawn drawn = [&] {
    const CancellableSection section;
    Progress progress("rendering");
    const auto update = [&](double done) { progress.update(done); };
    try {
      if (team() != nullptr && can_share(engine, settings, layers))
        return draw_with_team(scene, tracer, settings, file.get(), update, *team());
      return file == nullptr ? Drawn{} : draw_picture(scene, tracer, engine, settings, layers, *file, update);
    } catch (const Interrupted&) {
      CancellableSection::leave_if_cancelled();
      throw;
    }
  }();
  if (team() != nullptr) team()->agree({});
  if (file == nullptr) return;
  value_or_fail(file->finish());
  const double write_ms = drawing.elapsed_ms() - drawn.render_ms;

  // Print the report.
  const double mray_per_s = drawn.render_ms > 0 ? static_cast<double>(drawn.all_rays) / drawn.render_ms / 1000 : 0;
  if (!options.json) {
    const Tile pixels = drawn_pixels(settings);
    const std::string copies = scene.spheres.has_images()
                                   ? fmt::format(" in {} copies", grouped(scene.spheres.images().count()))
                                   : std::string();
    print_report(fmt::format("{}: {} x {}, {} spheres{}; tree {}, picture {} ({:.3g} Mray/s of all kinds)\n",
                             escaped(options.output), pixels.width(), pixels.height(), grouped(scene.spheres.size()),
                             copies, readable_ms(tracer.build_ms()), readable_ms(drawn.render_ms), mray_per_s),
                 {options.output});
    return;
  }
  ordered_json json = report_json(options, input, settings, engine, tracer, drawn);
  json["settings"] = described;
  json["rays"] = drawn.rays;
  json["read_ms"] = read_ms;
  json["build_ms"] = tracer.build_ms();
  json["render_ms"] = drawn.render_ms;
  json["write_ms"] = write_ms;
  json["mray_per_s"] = mray_per_s;
  json["peak_memory_bytes"] = peak_memory_bytes();
  if (const auto hash = file->hash()) json["picture_hash"] = fmt::format("{:016x}", *hash);
  json["warnings"] = input.warnings;
  print(as_text(json, 2) + "\n");
}

}  // namespace bihive::cli
