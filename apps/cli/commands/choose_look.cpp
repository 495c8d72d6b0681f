#include "commands/choose_look.h"

#include "bihive/base/write_file.h"
#include "support/failure.h"

namespace bihive::cli {
namespace {

std::optional<AmbientOcclusion> choose_ambient(const AmbientOptions& options,
                                               const std::optional<AmbientOcclusion>& of_scene) {
  const bool implied = options.distance || options.directions;
  if (!options.on.value_or(implied || of_scene)) return std::nullopt;
  AmbientOcclusion ambient = of_scene.value_or(AmbientOcclusion{});
  ambient.distance = options.distance.value_or(ambient.distance);
  ambient.directions = static_cast<int>(options.directions.value_or(ambient.directions));
  return ambient;
}

// A name has neither a folder nor an ending.
bool is_path(const std::string& style) {
  return style.find('/') != std::string::npos || style.find('.') != std::string::npos;
}

}  // namespace

Style choose_style(const StyleOptions& options) {
  const std::string& wanted = options.name.empty() ? style_names().front() : options.name;
  if (is_path(wanted)) return value_or_fail(parse_style(value_or_fail(read_file(wanted)), wanted));
  Result<Style> style = style_named(wanted);
  if (!style) fail_usage("--style: " + style.error().message, style.error().hint);
  return std::move(*style);
}

void apply_look(const StyleOptions& options, Input& input) {
  Scene& scene = input.scene;
  if (options.lights.empty()) {
    if (!input.has_lights) scene.lights = lights_around(input.rig, scene.camera);
    return;
  }
  const LightRig rig = rig_of(options.lights, scene.ambient_light);
  scene.lights = lights_around(rig, scene.camera);
  scene.ambient_light = rig.ambient_light;
}

void apply_effects(const StyleOptions& options, RenderSettings& settings) {
  settings.ambient_occlusion = choose_ambient(options.ambient, settings.ambient_occlusion);
  settings.opacity_rule = options.opacity_rule.value_or(settings.opacity_rule);
  settings.light_points = static_cast<int>(options.light_points.value_or(settings.light_points));
  if (options.outline_px) {
    Outline outline = settings.outline.value_or(Outline{});
    outline.width_px = *options.outline_px;
    settings.outline = outline.width_px > 0 ? std::optional<Outline>(outline) : std::nullopt;
  }
  if (options.fog) {
    Fog fog = settings.fog.value_or(Fog{});
    fog.strength = *options.fog;
    settings.fog = fog.strength > 0 ? std::optional<Fog>(fog) : std::nullopt;
  }
  settings.tone.exposure_stops = options.exposure_stops.value_or(settings.tone.exposure_stops);
  settings.tone.curve = options.tone.value_or(settings.tone.curve);
}

}  // namespace bihive::cli
