#include "bihive/scene/json_parts.h"

#include <nlohmann/json.hpp>
#include <string>

#include "bihive/scene/colour_text.h"
#include "bihive/scene/names.h"

namespace bihive {
namespace {

using nlohmann::json;

// Leaves `target` alone if there is no such key.
template <class T>
void take_value(const json& object, const char* key, T& target) {
  target = object.value(key, target);
}

AmbientOcclusion ambient_from_json(const json& value) {
  AmbientOcclusion made;
  take_value(value, "distance", made.distance);
  take_value(value, "directions", made.directions);
  return made;
}

Outline outline_from_json(const json& value, Transfer transfer) {
  Outline made;
  take_value(value, "width_px", made.width_px);
  take_value(value, "step", made.step);
  if (value.contains("colour")) made.colour = colour_from_json(value.at("colour"), transfer);
  return made;
}

Fog fog_from_json(const json& value) {
  Fog made;
  take_value(value, "start", made.start);
  take_value(value, "end", made.end);
  take_value(value, "strength", made.strength);
  return made;
}

}  // namespace

Vec3d vector_from_json(const json& value) {
  return {value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

Vec3d colour_from_json(const json& value, Transfer transfer) {
  if (value.is_array()) return vector_from_json(value);
  return *colour_from_text(value.get_ref<const std::string&>(), transfer);
}

void take_material(const json& value, Transfer transfer, Material& material) {
  if (value.contains("colour")) material.colour = colour_from_json(value.at("colour"), transfer);
  take_value(value, "ambient", material.ambient);
  take_value(value, "diffuse", material.diffuse);
  take_value(value, "reflective", material.reflective);
  take_value(value, "specular", material.specular);
  take_value(value, "power", material.power);
  take_value(value, "transmissive", material.transmissive);
  take_value(value, "refraction_index", material.refraction_index);
  take_value(value, "tint", material.tint);
  take_value(value, "bands", material.bands);
  take_value(value, "glow", material.glow);
}

void take_picture(const json& value, PictureDefaults& picture) {
  if (value.contains("transfer")) picture.transfer = value.at("transfer") == "srgb" ? Transfer::srgb : Transfer::none;
  take_value(value, "width_px", picture.width_px);
  take_value(value, "height_px", picture.height_px);
  if (value.contains("samples_per_pixel")) {
    const json& samples = value.at("samples_per_pixel");
    picture.adaptive_samples = samples.is_string();
    if (samples.is_number()) picture.samples_per_pixel = samples.get<int>();
  }
  take_value(value, "recursion", picture.recursion);
  take_value(value, "shadows", picture.shadows);
  take_value(value, "transparent", picture.transparent);
  if (value.contains("opacity_rule"))
    picture.opacity_rule = *value_named(kOpacityRules, value.at("opacity_rule").get_ref<const std::string&>());
  take_value(value, "light_points", picture.light_points);
  take_value(value, "exposure", picture.tone.exposure_stops);
  if (value.contains("tone")) picture.tone.curve = *value_named(kToneCurves, value.at("tone").get<std::string>());
  take_value(value, "legend", picture.labels.legend);
  take_value(value, "scale_bar", picture.labels.scale_bar);
  take_value(value, "axes", picture.labels.axes);
  take_value(value, "title", picture.labels.title);
  if (value.contains("length_unit")) picture.labels.length_unit = value.at("length_unit").get<std::string>();
  if (value.contains("ambient_occlusion")) picture.ambient_occlusion = ambient_from_json(value.at("ambient_occlusion"));
  if (value.contains("outline")) picture.outline = outline_from_json(value.at("outline"), picture.transfer);
  if (value.contains("fog")) picture.fog = fog_from_json(value.at("fog"));
  if (value.contains("cell_lines")) {
    const json& lines = value.at("cell_lines");
    CellLines made;
    take_value(lines, "width_px", made.width_px);
    if (lines.contains("colour")) made.colour = colour_from_json(lines.at("colour"), picture.transfer);
    picture.cell_lines = made;
  }
}

}  // namespace bihive
