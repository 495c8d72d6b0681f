#include "bihive/viewer/viewer_effects.h"

#include <cmath>
#include <string>

#include "bihive/scene/light_points.h"

namespace bihive {
namespace {

// A member that is as the scene's own picture had it becomes what that picture has now.
template <class T>
void follow(const T& before, const T& now, T& value) {
  if (value == before) value = now;
}

Error out_of_range(const std::string& message) {
  return {message, "", 0, 0, ""};
}

}  // namespace

Status check_effects(const ViewerEffects& effects) {
  const auto outside = [](auto value, auto least, auto most) { return !(value >= least && value <= most); };
  if (!(effects.ambient_distance > 0)) return out_of_range("the distance of ambient occlusion must be above 0");
  if (outside(effects.ambient_directions, 1, kMostAmbientDirections))
    return out_of_range("directions of ambient occlusion must be from 1 to " + std::to_string(kMostAmbientDirections));
  if (outside(effects.light_points, 1, kMostLightPoints))
    return out_of_range("points of a light must be from 1 to " + std::to_string(kMostLightPoints));
  if (outside(effects.fog, 0.0, 1.0)) return out_of_range("fog must be from 0 to 1");
  if (effects.outline_px != 0 && outside(effects.outline_px, 1.0, kWidestOutlinePx))
    return out_of_range("outlines must be 0, or from 1 to 16 pixels wide");
  if (outside(effects.tone.exposure_stops, -kMostExposureStops, kMostExposureStops))
    return out_of_range("exposure must be from -32 to 32 stops");
  return Done{};
}

ViewerEffects effects_of(const PictureDefaults& defaults) {
  ViewerEffects effects;
  effects.adaptive_samples = defaults.adaptive_samples;
  effects.ambient_occlusion = defaults.ambient_occlusion.has_value();
  const AmbientOcclusion ambient = defaults.ambient_occlusion.value_or(AmbientOcclusion{});
  effects.ambient_distance = ambient.distance;
  effects.ambient_directions = ambient.directions;
  effects.light_points = defaults.light_points;
  effects.opacity_rule = defaults.opacity_rule;
  effects.fog = defaults.fog ? defaults.fog->strength : 0;
  effects.outline_px = defaults.outline ? defaults.outline->width_px : 0;
  effects.tone = defaults.tone;
  effects.labels = defaults.labels;
  return effects;
}

void follow_effects(const PictureDefaults& before, const PictureDefaults& now, ViewerEffects& effects) {
  const ViewerEffects old = effects_of(before), next = effects_of(now);
  follow(old.adaptive_samples, next.adaptive_samples, effects.adaptive_samples);
  follow(old.ambient_occlusion, next.ambient_occlusion, effects.ambient_occlusion);
  follow(old.ambient_distance, next.ambient_distance, effects.ambient_distance);
  follow(old.ambient_directions, next.ambient_directions, effects.ambient_directions);
  follow(old.light_points, next.light_points, effects.light_points);
  follow(old.opacity_rule, next.opacity_rule, effects.opacity_rule);
  follow(old.fog, next.fog, effects.fog);
  follow(old.outline_px, next.outline_px, effects.outline_px);
  follow(old.tone.exposure_stops, next.tone.exposure_stops, effects.tone.exposure_stops);
  follow(old.tone.curve, next.tone.curve, effects.tone.curve);
  follow(old.labels.legend, next.labels.legend, effects.labels.legend);
  follow(old.labels.scale_bar, next.labels.scale_bar, effects.labels.scale_bar);
  follow(old.labels.axes, next.labels.axes, effects.labels.axes);
  follow(old.labels.title, next.labels.title, effects.labels.title);
  follow(old.labels.length_unit, next.labels.length_unit, effects.labels.length_unit);
}

void put_effects(const ViewerEffects& effects, RenderSettings& settings) {
  settings.adaptive_samples = effects.adaptive_samples;
  settings.ambient_occlusion.reset();
  if (effects.ambient_occlusion)
    settings.ambient_occlusion = AmbientOcclusion{effects.ambient_distance, effects.ambient_directions};
  settings.light_points = effects.light_points;
  settings.opacity_rule = effects.opacity_rule;
  Fog fog = settings.fog.value_or(Fog{});
  fog.strength = effects.fog;
  settings.fog = fog.strength > 0 ? std::optional<Fog>(fog) : std::nullopt;
  Outline outline = settings.outline.value_or(Outline{});
  outline.width_px = effects.outline_px;
  settings.outline = outline.width_px > 0 ? std::optional<Outline>(outline) : std::nullopt;
  settings.tone = effects.tone;
  settings.labels = effects.labels;
}

}  // namespace bihive
