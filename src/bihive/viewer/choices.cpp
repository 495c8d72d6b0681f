#include "bihive/viewer/choices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "bihive/base/json_text.h"
#include "bihive/io/known_formats.h"
#include "bihive/io/reading_settings.h"
#include "bihive/render/memory.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/colour_maps.h"
#include "bihive/scene/element_colours.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/look_text.h"
#include "bihive/scene/named_materials.h"
#include "bihive/scene/names.h"
#include "bihive/scene/style.h"
#include "bihive/viewer/viewer_json.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;

template <class T>
ordered_json names_json(const Names<T>& names) {
  ordered_json list = ordered_json::array();
  for (const auto& named : names) list.push_back(named.first);
  return list;
}

const char* label_of(View view) {
  switch (view) {
    case View::shaded:
      return "picture";
    case View::recursion:
      return "recursion depth";
    case View::traversal:
      return "tree traversal";
    case View::normal:
      return "normals";
    case View::distance:
      return "distances";
    case View::id:
      return "ids";
    case View::tree:
      return "the tree itself";
  }
  return "";
}

const char* name_of_kind(BuiltInKind kind) {
  switch (kind) {
    case BuiltInKind::file:
      return "file";
    case BuiltInKind::scenario:
      return "scenario";
    case BuiltInKind::fixed:
      return "fixed";
  }
  return "";
}

const char* name_of_list(ValueNames names) {
  switch (names) {
    case ValueNames::none:
      return "none";
    case ValueNames::colours:
      return "colours";
    case ValueNames::materials:
      return "materials";
    case ValueNames::attributes:
      return "attributes";
  }
  return "";
}

const char* name_of_inputs(ReadingOf inputs) {
  switch (inputs) {
    case ReadingOf::scenarios_and_files:
      return "scenarios_and_files";
    case ReadingOf::files:
      return "files";
    case ReadingOf::molecules:
      return "molecules";
    case ReadingOf::frames:
      return "frames";
    case ReadingOf::cells:
      return "cells";
  }
  return "";
}

ordered_json built_ins_json() {
  ordered_json list = ordered_json::array();
  for (const BuiltInScene& one : kBuiltInScenes)
    list.push_back({{"name", one.name}, {"label", one.title}, {"kind", name_of_kind(one.kind)}});
  return list;
}

ordered_json styles_json() {
  ordered_json list = ordered_json::array();
  for (const std::string& name : style_names()) {
    const Style style = style_named(name).value();
    list.push_back({{"name", name}, {"description", style.description}});
  }
  return list;
}

ordered_json actions_json() {
  ordered_json list = ordered_json::array();
  for (const LookActionText& one : look_actions())
    list.push_back({{"name", one.name},
                    {"label", one.label.empty() ? one.name : one.label},
                    {"value", one.value},
                    {"example", one.example},
                    {"names", name_of_list(one.names)},
                    {"is_number", one.is_number}});
  return list;
}

ordered_json views_json() {
  ordered_json list = ordered_json::array();
  for (const auto& [name, view] : kViews) list.push_back({{"name", name}, {"label", label_of(view)}});
  return list;
}

// The map for categories is the last of colour_map_names().
ordered_json maps_json() {
  constexpr int kColours = 17;
  ordered_json list = ordered_json::array();
  for (const std::string& name : colour_map_names()) {
    const std::optional<ColourMap> map = colour_map_from(name);
    ordered_json one{{"name", name}, {"colours", ordered_json::array()}};
    for (int i = 0; map && map->name != ColourMap::okabe_ito && i < kColours; ++i) {
      const Vec3f colour = map_colour(*map, double(i) / (kColours - 1), Transfer::none);
      const auto byte = [](float value) { return static_cast<int>(std::lround(255 * std::clamp(value, 0.0f, 1.0f))); };
      one["colours"].push_back(fmt::format("#{:02x}{:02x}{:02x}", byte(colour.x), byte(colour.y), byte(colour.z)));
    }
    list.push_back(std::move(one));
  }
  return list;
}

ordered_json reading_json() {
  ordered_json list = ordered_json::array();
  for (const ReadingSetting& row : reading_settings())
    if (!row.label.empty())
      list.push_back({{"id", row.id},
                      {"label", row.label},
                      {"help", row.help},
                      {"empty_means", row.empty_means},
                      {"kind", row.value_name.empty() ? "flag"
                               : row.is_number        ? "number"
                                                      : "text"},
                      {"excludes", row.excludes},
                      {"shown_for", name_of_inputs(row.shown_for)},
                      {"inputs", row.inputs}});
  return list;
}

double most_pixels() {
  constexpr int kMostSide = 16384;
  int fits = 0;
  for (int step = kMostSide; step > 0; step /= 2)
    if (fits + step <= kMostSide && check_picture_memory(fits + step, fits + step)) fits += step;
  return double(fits) * double(fits);
}

}  // namespace

std::string choices_to_json() {
  const ordered_json json{{"built_ins", built_ins_json()},
                          {"styles", styles_json()},
                          {"actions", actions_json()},
                          {"materials", names_json(named_materials())},
                          {"lights", names_json(light_presets())},
                          {"colours", colour_names()},
                          {"element_colours", element_colour_names()},
                          {"sides", names_json(kSides)},
                          {"projections", names_json(kProjections)},
                          {"views", views_json()},
                          {"maps", maps_json()},
                          {"settings", *json_from_text<ordered_json>(parameters_to_json())},
                          {"reading", reading_json()},
                          {"formats", names_of_formats(FormatsThat::hold_spheres)},
                          {"most_pixels", most_pixels()}};
  return json.dump();
}

}  // namespace bihive
