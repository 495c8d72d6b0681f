// bihive render: from an input to a PNG.

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/image/png.h"
#include "bihive/render/draw_labels.h"
#include "bihive/render/memory.h"
#include "bihive/render/tree_picture.h"
#include "bihive/scene/clips.h"
#include "bihive/simd/target.h"
#include "commands/choose_camera.h"
#include "commands/choose_labels.h"
#include "commands/choose_look.h"
#include "commands/commands.h"
#include "commands/names.h"
#include "commands/render_on_gpu.h"
#include "support/failure.h"
#include "support/interrupt.h"
#include "support/messages.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

bool shows_reference_tree(View view) {
  return view == View::traversal || view == View::tree;
}

bool is_gpu(RenderEngine engine) {
  return engine == RenderEngine::gpu || engine == RenderEngine::gpu_brute;
}

// The pictures of the tree show the reference tree, also if another engine is faster.
RenderEngine choose_engine(const RenderOptions& options) {
  const RenderEngine engine = options.engine;
  if (!shows_reference_tree(options.view) || engine == RenderEngine::reference) return engine;
  if (engine == RenderEngine::automatic) return RenderEngine::reference;
  const std::string view = "--view " + name_of(kViews, options.view);
  const std::string chosen = "--engine " + name_of(kRenderEngines, engine);
  if (engine == RenderEngine::brute || engine == RenderEngine::gpu_brute)
    fail_usage(view + " shows a tree, and " + chosen + " has none");
  if (engine == RenderEngine::wide)
    fail_usage(view + " shows the reference tree, and --engine wide has another one",
               "leave --engine out, or choose --engine reference");
  if (options.view == View::tree)
    fail_usage(view + " is drawn by the CPU alone, not by " + chosen,
               "leave --engine out, or choose --engine reference");
  return engine;
}

// The structure that an engine builds.
Engine structure_of(RenderEngine engine) {
  switch (engine) {
    case RenderEngine::wide:
      return Engine::wide;
    case RenderEngine::reference:
    case RenderEngine::gpu:
      return Engine::reference;
    case RenderEngine::brute:
    case RenderEngine::gpu_brute:
      return Engine::brute;
    case RenderEngine::automatic:
      break;
  }
  return Engine::automatic;
}

// With the ambient light and the lights that throw soft shadows; only what differs from plain pictures.
void describe_effects(const RenderSettings& settings, const Scene& scene, ordered_json& json) {
  if (settings.ambient_occlusion) {
    const AmbientOcclusion& ambient = *settings.ambient_occlusion;
    ordered_json& object = json["ambient_occlusion"];
    if (std::isfinite(ambient.distance)) object["distance"] = ambient.distance;
    object["directions"] = ambient.directions;
  }
  if (settings.opacity_rule != OpacityRule::each_surface && lets_light_through(scene))
    json["opacity_rule"] = name_of(kOpacityRules, settings.opacity_rule);
  for (const PointLight& light : scene.lights)
    if (light.radius > 0) json["light_points"] = settings.light_points;
  if (settings.outline) json["outline_px"] = settings.outline->width_px;
  if (settings.fog) json["fog"] = settings.fog->strength;
  if (settings.tone.any()) {
    json["exposure"] = settings.tone.exposure_stops;
    json["tone"] = name_of(kToneCurves, settings.tone.curve);
  }
}

void describe_labels(const Labels& labels, ordered_json& json) {
  if (!labels.any()) return;
  ordered_json& object = json["labels"];
  if (labels.legend) object["legend"] = true;
  if (labels.scale_bar) object["scale_bar"] = true;
  if (labels.axes) object["axes"] = true;
  if (!labels.title.empty()) object["title"] = labels.title;
  if (labels.length_unit) object["length_unit"] = *labels.length_unit;
}

// Everything that decides the picture, for its text chunk. Threads and engine do not.
ordered_json settings_json(const RenderOptions& options, const RenderSettings& settings, const Scene& scene) {
  const auto vector = [](Vec3d v) { return ordered_json{v.x, v.y, v.z}; };
  ordered_json json;
  json["view"] = name_of(kViews, settings.view);
  json["width_px"] = settings.width_px;
  json["height_px"] = settings.height_px;
  if (settings.crop) json["crop"] = {settings.crop->x0, settings.crop->y0, settings.crop->x1, settings.crop->y1};
  json["samples_per_pixel"] =
      settings.adaptive_samples ? ordered_json("auto") : ordered_json(settings.samples_per_pixel);
  json["recursion"] = settings.recursion;
  json["shadows"] = settings.shadows;
  describe_effects(settings, scene, json);
  json["transfer"] = name_of(kTransfers, scene.picture.transfer);
  json["background"] = vector(scene.background);
  if (settings.transparent) json["transparent"] = true;
  describe_labels(settings.labels, json);
  if (options.bits) json["bits"] = *options.bits;
  if (options.dots_per_inch > 0) json["dpi"] = options.dots_per_inch;
  json["camera"] = {{"eye", vector(scene.camera.eye)},
                    {"look_at", vector(scene.camera.look_at)},
                    {"up", vector(scene.camera.up)},
                    {"fov_deg", scene.camera.fov_deg}};
  if (scene.camera.projection == Projection::orthographic) {
    json["camera"]["projection"] = name_of(kProjections, scene.camera.projection);
    json["camera"]["shorter_side"] = scene.camera.shorter_side;
  }
  if (scene.camera.aperture > 0) {
    json["camera"]["aperture"] = scene.camera.aperture;
    json["camera"]["focus"] = focus_distance(scene.camera);
  }
  if (shows_reference_tree(settings.view)) {
    const auto limit = [](std::int64_t value) { return value == kUnlimited ? ordered_json() : ordered_json(value); };
    const BuildParameters tree = options.tree.for_reference();
    json["max_prims"] = limit(tree.max_prims);
    json["max_depth"] = limit(tree.max_depth);
  }
  const InputOptions& input = options.input;
  json["spheres"] = scene.spheres.size();
  if (input.radius) json["radius"] = *input.radius;
  if (input.radius_scale) json["radius_scale"] = *input.radius_scale;
  if (input.frame) json["frame"] = *input.frame;
  if (input.recenter) json["recenter"] = true;
  if (!input.assembly.empty()) json["assembly"] = input.assembly;
  if (!options.looks.element_colours.empty()) json["element_colours"] = options.looks.element_colours;
  if (!options.looks.words.empty()) json["looks"] = options.looks.words;
  return json;
}

std::string as_text(const ordered_json& json, int indent) {
  return json.dump(indent, ' ', /*ensure_ascii=*/true, ordered_json::error_handler_t::replace);
}

// PNG's plain text knows Latin-1 only.
std::string latin1(std::string text) {
  std::string converted;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : 0);
    if (byte < 0x80) {
      converted += text[i];
    } else if ((byte == 0xC2 || byte == 0xC3) && (next & 0xC0) == 0x80) {
      converted += static_cast<char>((byte << 6 & 0xC0) | (next & 0x3F));
      ++i;
    } else if ((byte & 0xC0) != 0x80) {
      converted += '?';
    }
  }
  return converted;
}

PngText text_chunks(const Scene& scene, const ordered_json& settings) {
  PngText text{{"Software", "bihive " + std::string(version())},
               {"Scene", latin1(scene.name)},
               {"Settings", as_text(settings, -1)}};
  if (scene.seed) text.emplace_back("Seed", std::to_string(*scene.seed));
  return text;
}

// A picture and its report.
struct Drawn {
  Film film;
  std::int64_t all_rays = 0;
  double render_ms = 0;
  ordered_json rays, gpu;
};

Drawn draw_on_cpu(const Scene& scene, const Tracer& tracer, const RenderSettings& settings) {
  const CancellableSection section;
  Progress progress("rendering");
  Result<Rendered> result = render(
      scene, tracer, settings, [&](double done) { progress.update(done); }, &CancellableSection::token());
  CancellableSection::leave_if_cancelled();
  Rendered rendered = value_or_fail(std::move(result));
  const RenderCounts& rays = rendered.rays;
  Drawn drawn;
  drawn.all_rays = rays.primary + rays.shadow + rays.reflected + rays.transmitted + rays.ambient;
  drawn.rays = {{"primary", rays.primary},         {"shadow", rays.shadow},   {"reflected", rays.reflected},
                {"transmitted", rays.transmitted}, {"ambient", rays.ambient}, {"all", drawn.all_rays}};
  drawn.film = std::move(rendered.film);
  drawn.render_ms = rendered.render_ms;
  return drawn;
}

Drawn draw_on_gpu(const Scene& scene, const Tracer& tracer, const RenderSettings& settings) {
  const CancellableSection section;
  Progress progress("rendering");
  GpuPicture picture = render_on_gpu(scene, tracer.tree(), settings, [&](double done) {
    progress.update(done);
    CancellableSection::leave_if_cancelled();
  });
  Drawn drawn;
  drawn.all_rays = picture.primary + picture.others;
  drawn.rays = {{"primary", picture.primary}, {"all", drawn.all_rays}};
  drawn.gpu = picture.gpu;
  drawn.film = std::move(picture.film);
  drawn.render_ms = picture.render_ms;
  return drawn;
}

// The samples of a picture with --aperture and without --samples: so many places on the lens are hardly seen one by
// one.
constexpr int kLensSamples = 64;

void choose_samples(const RenderOptions& options, RenderSettings& settings) {
  if (options.samples) {
    settings.adaptive_samples = *options.samples == kAutomaticSamples;
    if (!settings.adaptive_samples) settings.samples_per_pixel = static_cast<int>(*options.samples);
  } else if (options.aperture.value_or(0) > 0) {
    settings.adaptive_samples = false;
    settings.samples_per_pixel = std::max(settings.samples_per_pixel, kLensSamples);
  }
}

// Applies the user's options to the scene: transfer curve, background, camera, light. The scene's own settings with the
// user's options are the result.
RenderSettings apply_options(const RenderOptions& options, Input& input) {
  Scene& scene = input.scene;
  RenderSettings settings = settings_from(scene.picture);
  if (options.size) settings.width_px = options.size->width_px;
  if (options.size) settings.height_px = options.size->height_px;
  settings.crop = options.crop;
  if (options.crop && (options.crop->x1 > settings.width_px || options.crop->y1 > settings.height_px))
    fail_usage(
        fmt::format("--crop ends outside of the picture of {} x {} pixels", settings.width_px, settings.height_px),
        "give the size of the whole picture by --size");
  choose_samples(options, settings);
  settings.recursion = static_cast<int>(options.recursion.value_or(settings.recursion));
  settings.shadows = options.shadows.value_or(settings.shadows);
  apply_effects(options.style, settings);
  settings.view = options.view;
  settings.threads = static_cast<int>(options.threads);
  scene.picture.transfer = options.transfer.value_or(scene.picture.transfer);
  if (options.background) settings.transparent = *options.background == kNoBackground;
  if (options.background && !settings.transparent)
    scene.background = *colour_from(*options.background, scene.picture.transfer);
  if (settings.transparent && shows_reference_tree(settings.view))
    fail_usage("--view " + name_of(kViews, settings.view) + " has no transparent background",
               "give a colour by --background, or choose another view");
  scene.camera = choose_camera(input, options, settings);
  if (settings.adaptive_samples && scene.camera.aperture > 0)
    fail_usage("adaptive samples look for edges, and depth of field needs many samples everywhere",
               "give a number: --samples 64");
  apply_look(options.style, input);
  choose_labels(options.labels, scene, settings);
  return settings;
}

// What the graphics processor cannot draw.
void refuse_on_gpu(RenderEngine engine, const Scene& scene, const RenderSettings& settings) {
  const auto refuse = [engine](const std::string& what, const std::string& without) {
    fail_usage("--engine " + name_of(kRenderEngines, engine) + " draws no " + what,
               "leave --engine out, or draw " + without);
  };
  if (const std::string beyond = beyond_gpu(scene, settings); settings.view == View::shaded && !beyond.empty())
    refuse(beyond, "without it: --style plain");
  if (settings.view == View::shaded && settings.tone.any())
    refuse("exposure and tone curve", "without them: --exposure 0 --tone none");
  if (settings.adaptive_samples) refuse("adaptive samples", "with a number of them: --samples 4");
  if (has_clips(scene)) refuse("cut spheres", "without --clip");
  if (scene.camera.aperture > 0) refuse("depth of field", "without it: --aperture 0");
  if (settings.crop) refuse("part of a picture", "the whole picture without --crop");
  if (settings.transparent) refuse("transparent background", "on a colour: --background white");
}

// Two views are drawn whole before they are cut.
void check_memory_of(const RenderSettings& settings) {
  const bool of_parts = settings.view != View::distance && settings.view != View::tree;
  const Tile whole{0, 0, settings.width_px, settings.height_px};
  const Tile drawn = of_parts ? drawn_pixels(settings) : whole;
  value_or_fail(check_picture_memory(drawn.width(), drawn.height()));
}

void check_output(const RenderOptions& options) {
  if (options.output != kStandardOutput) {
    if (const Status status = check_writable(options.output); !status) fail(status.error());
    return;
  }
  if (options.json) fail_usage("--json prints where -o - writes the picture", "write the picture into a file");
  if (isatty(STDOUT_FILENO) != 0)
    fail_usage("-o - would write the picture to the terminal", "send it to a program or into a file");
}

void write_picture(const std::string& output, const std::string& png) {
  if (output == kStandardOutput) return print(png);
  const WritingSection section;
  if (const Status status = write_file(output, png); !status) fail(status.error());
}

}  // namespace

void run_render(const RenderOptions& options) {
  const RenderEngine engine = choose_engine(options);
  check_output(options);

  // Load the scene and apply the user's options to it.
  const bool named = !options.style.name.empty();
  const Style style = is_gpu(engine) && !named ? Style{} : choose_style(options.style);
  Input input = load_input(options.input, LooksOfFile::keep, &style, /*asked_for=*/named);
  if (options.transfer) input.scene.picture.transfer = *options.transfer;
  look(input, options.looks);
  if (is_gpu(engine) && options.view == View::id && !input.scene.id_in_input.empty())
    fail_usage("--engine " + name_of(kRenderEngines, engine) + " does not know the ids of a set with hidden spheres",
               "leave --engine out");
  const RenderSettings settings = apply_options(options, input);
  if (is_gpu(engine)) refuse_on_gpu(engine, input.scene, settings);
  if (shows_reference_tree(settings.view) && has_clips(input.scene))
    fail_usage("--view " + name_of(kViews, settings.view) + " shows the tree of whole spheres", "leave out --clip");
  const Scene& scene = input.scene;
  check_memory_of(settings);
  value_or_fail(check_tree_memory(scene.spheres, structure_of(engine), options.tree));

  // Build, render, write.
  const Tracer tracer = value_or_fail(Tracer::build(scene, structure_of(engine), options.tree, settings.threads));
  const Drawn drawn = is_gpu(engine) ? draw_on_gpu(scene, tracer, settings) : draw_on_cpu(scene, tracer, settings);
  const Transfer curve = settings.view == View::shaded ? scene.picture.transfer : Transfer::none;
  PngPixels image =
      png_pixels_from_film(drawn.film, curve, static_cast<int>(options.bits.value_or(8)), settings.threads);
  draw_labels(image, scene, settings, options.dots_per_inch);
  const ordered_json described = settings_json(options, settings, scene);
  write_picture(options.output, value_or_fail(encode_png(image, text_chunks(scene, described), options.dots_per_inch)));
  if (options.output == kStandardOutput) return;

  // Print the report.
  const double mray_per_s = drawn.render_ms > 0 ? static_cast<double>(drawn.all_rays) / drawn.render_ms / 1000 : 0;
  if (!options.json) {
    print(fmt::format("{}: {} x {}, {} spheres; tree {}, picture {} ({:.3g} Mray/s of all kinds)\n", options.output,
                      image.width, image.height, grouped(scene.spheres.size()), readable_ms(tracer.build_ms()),
                      readable_ms(drawn.render_ms), mray_per_s));
    return;
  }
  ordered_json json;
  json["output"] = options.output;
  json["scene"] = scene.name;
  json["seed"] = scene.seed ? ordered_json(*scene.seed) : ordered_json();
  json["size"] = fmt::format("{}x{}", image.width, image.height);
  json["view"] = name_of(kViews, settings.view);
  json["engine"] = is_gpu(engine) ? name_of(kRenderEngines, engine) : name_of(kEngines, tracer.engine());
  json["target"] = tracer.engine() == Engine::wide ? ordered_json(active_target()) : ordered_json();
  if (is_gpu(engine)) json["gpu"] = drawn.gpu;
  json["spheres"] = scene.spheres.size();
  json["settings"] = described;
  json["rays"] = drawn.rays;
  json["build_ms"] = tracer.build_ms();
  json["render_ms"] = drawn.render_ms;
  json["mray_per_s"] = mray_per_s;
  json["picture_hash"] = fmt::format("{:016x}", picture_hash(image));
  json["warnings"] = input.warnings;
  print(as_text(json, 2) + "\n");
}

}  // namespace bihive::cli
