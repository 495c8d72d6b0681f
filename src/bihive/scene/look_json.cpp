#include "bihive/scene/look_json.h"

#include <nlohmann/json.hpp>

#include "bihive/scene/named_materials.h"

namespace bihive {
namespace {

ColourChoice colour_from_json(const nlohmann::json& value) {
  if (value.is_string()) return value.get<std::string>();
  return Vec3d{value.at(0).get<double>(), value.at(1).get<double>(), value.at(2).get<double>()};
}

// The schema has checked the names; not the colours' number, nor that each is one.
std::optional<ColourMap> colour_map_from_json(const nlohmann::json& value) {
  if (value.is_string()) return colour_map_from(value.get<std::string>());
  std::string colours;
  for (const nlohmann::json& one : value) colours += (colours.empty() ? "" : "-") + one.get<std::string>();
  return colour_map_from(colours);
}

}  // namespace

ColourBy colour_by_from_json(const nlohmann::json& value) {
  ColourBy how;
  how.attribute = value.at("attribute").get<std::string>();
  if (value.contains("map")) how.map = colour_map_from_json(value.at("map"));
  if (value.contains("range"))
    how.range.emplace(value.at("range").at(0).get<double>(), value.at("range").at(1).get<double>());
  if (how.range && how.range->first > how.range->second) {
    std::swap(how.range->first, how.range->second);
    how.map = reversed(how.map.value_or(ColourMap()));
  }
  if (value.contains("percentiles"))
    how.percentiles.emplace(value.at("percentiles").at(0).get<double>(), value.at("percentiles").at(1).get<double>());
  if (value.contains("middle")) how.middle = value.at("middle").get<double>();
  how.logarithmic = value.value("log", false);
  if (value.contains("nan_colour")) how.nan_colour = colour_from_json(value.at("nan_colour"));
  return how;
}

Clip clip_from_json(const nlohmann::json& value) {
  const auto vector = [](const nlohmann::json& v) {
    return Vec3d{v.at(0).get<double>(), v.at(1).get<double>(), v.at(2).get<double>()};
  };
  if (value.contains("plane")) {
    const nlohmann::json& plane = value.at("plane");
    return PlaneClip{vector(plane.at("normal")), plane.at("offset").get<double>()};
  }
  if (value.contains("box")) {
    const nlohmann::json& box = value.at("box");
    return BoxClip{vector(box.at("lo")), vector(box.at("hi"))};
  }
  const nlohmann::json& sphere = value.at("sphere");
  return SphereClip{vector(sphere.at("centre")), sphere.at("radius").get<double>()};
}

Look look_from_json(const nlohmann::json& value) {
  Look look;
  look.select = value.value("select", look.select);
  if (value.contains("show")) look.actions.emplace_back(SetShown{value.at("show").get<bool>()});
  if (value.contains("colour")) look.actions.emplace_back(SetColour{colour_from_json(value.at("colour"))});
  if (value.contains("colour_by")) look.actions.emplace_back(colour_by_from_json(value.at("colour_by")));
  if (value.contains("opacity")) look.actions.emplace_back(SetOpacity{value.at("opacity").get<double>()});
  if (value.contains("material"))
    look.actions.emplace_back(SetMaterial{*value_named(named_materials(), value.at("material").get<std::string>())});
  if (value.contains("radius_scale")) look.actions.emplace_back(ScaleRadius{value.at("radius_scale").get<double>()});
  if (value.contains("outline")) look.actions.emplace_back(SetOutline{value.at("outline").get<double>()});
  if (value.contains("crease")) look.actions.emplace_back(SetCrease{value.at("crease").get<std::string>()});
  if (value.contains("legend_name"))
    look.actions.emplace_back(SetLegendName{value.at("legend_name").get<std::string>()});
  if (value.contains("clip"))
    for (const nlohmann::json& clip : value.at("clip")) look.actions.emplace_back(AddClip{clip_from_json(clip)});
  return look;
}

}  // namespace bihive
