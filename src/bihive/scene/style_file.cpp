// The parsing half of style.h.

#include <nlohmann/json.hpp>
#include <utility>

#include "bihive/base/json_text.h"
#include "bihive/base/near_name.h"
#include "bihive/scene/builtin_styles.h"
#include "bihive/scene/json_parts.h"
#include "bihive/scene/look_json.h"
#include "bihive/scene/named_materials.h"
#include "bihive/scene/scene_json.h"
#include "bihive/scene/style.h"
#include "bihive/settings/check_picture.h"
#include "bihive/settings/parameter_json.h"

namespace bihive {
namespace {

using nlohmann::json;

const Names<std::string_view (*)()>& builtin_styles() {
  static const Names<std::string_view (*)()> styles{
      {"default", style_text_default},  {"plain", style_text_plain},     {"illustrative", style_text_illustrative},
      {"studio", style_text_studio},    {"glossy", style_text_glossy},   {"flat", style_text_flat},
      {"xray", style_text_xray},        {"density", style_text_density}, {"ball-and-stick", style_text_ball_and_stick},
      {"licorice", style_text_licorice}};
  return styles;
}

// The schema has checked that the names exist.
CameraLight camera_light(const json& value) {
  CameraLight light;
  light.direction = vector_from_json(value.at("direction"));
  if (value.contains("colour")) light.colour = colour_from_json(value.at("colour"), Transfer::srgb);
  light.angle_deg = value.value("angle_deg", light.angle_deg);
  return light;
}

LightRig light_rig(const json& value) {
  if (value.is_string()) return *value_named(light_presets(), value.get<std::string>());
  LightRig rig;
  rig.light_behind = false;
  for (const json& light : value) rig.lights.push_back(camera_light(light));
  return rig;
}

Error fault(const std::string& file, const std::string& what, const std::string& hint) {
  return {what, file, 0, 0, hint};
}

// A style from a document that the schema has accepted.
Result<Style> style_from(const json& document, const std::string& file) {
  Style style;
  style.name = document.value("name", file);
  style.description = document.value("description", std::string());
  if (document.contains("material")) {
    const json& value = document.at("material");
    if (value.is_string())
      style.material = *value_named(named_materials(), value.get<std::string>());
    else
      take_material(value, Transfer::srgb, style.material);
  }
  if (document.contains("colour")) style.material.colour = colour_from_json(document.at("colour"), Transfer::srgb);
  if (document.contains("element_colours"))
    style.element_colours = *value_named(kElementSchemes, document.at("element_colours").get<std::string>());
  if (document.contains("colour_by")) style.colour_by = colour_by_from_json(document.at("colour_by"));
  if (document.contains("colour_atoms_by")) {
    const json& value = document.at("colour_atoms_by");
    style.colour_atoms_by = {value.at("attribute").get<std::string>(), value.value("above", std::int64_t{0})};
  }
  style.crease = document.value("crease", style.crease);
  if (document.contains("density")) {
    const json& value = document.at("density");
    DensityStyle& density = style.density.emplace();
    density.dot = value.value("dot", density.dot);
    density.percentile = value.value("percentile", density.percentile);
    density.brightness = value.value("brightness", density.brightness);
  }
  if (document.contains("lights")) style.lights = light_rig(document.at("lights"));
  if (document.contains("ambient_light"))
    style.lights.ambient_light = colour_from_json(document.at("ambient_light"), Transfer::srgb);
  if (document.contains("background")) style.background = colour_from_json(document.at("background"), Transfer::srgb);
  if (document.contains("picture")) take_picture(document.at("picture"), style.picture);

  // Rules that a schema cannot express.
  for (const CameraLight& light : style.lights.lights)
    if (!(dot(light.direction, light.direction) > 0))
      return fault(file, "/lights: a light's direction is [0, 0, 0]", "state right, up and towards the viewer");
  if (style.material.transmissive > 0 && !(style.material.refraction_index > 0))
    return fault(file, "/material/refraction_index: expected a number above 0, because transmissive is above 0", "");
  if (!check_picture(style.picture)) return fault(file, "/picture/fog: the start of the fog is not before its end", "");
  return style;
}

}  // namespace

Result<Style> parse_style(std::string_view text, const std::string& file) {
  const Result<json> document = parse_json(text, file);
  if (!document) return document.error();
  if (Status status = check_against_definition(*document, "style", file); !status) return status.error();
  return style_from(*document, file);
}

const std::vector<std::string>& style_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& style : builtin_styles()) all.push_back(style.first);
    return all;
  }();
  return names;
}

Result<Style> style_named(std::string_view name) {
  std::string known;
  for (const auto& [style, text] : builtin_styles()) {
    // A test checks the built-in styles against the schema, so they need no check at run time.
    if (style == name) return style_from(*json_from_text<json>(text()), style);
    known += (known.empty() ? "" : ", ") + style;
  }
  const std::string near = near_name(name, style_names());
  return Error{"there is no style \"" + std::string(name) + "\"", "", 0, 0,
               (near.empty() ? "" : "did you mean \"" + near + "\"? ") + "there are " + known + ", or a file"};
}

}  // namespace bihive
