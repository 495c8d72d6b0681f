#include "bihive/scene/look_text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/near_name.h"
#include "bihive/base/parse_number.h"
#include "bihive/image/colour_text.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/named_materials.h"

namespace bihive {
namespace {

Error unexpected(const std::string& expected, const std::string& found) {
  return {"expected " + expected + ", found \"" + found + "\"", "", 0, 0, ""};
}

std::vector<std::string> colour_names() {
  std::vector<std::string> names;
  for (std::string_view rest = kColourNames; !rest.empty();) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    names.emplace_back(rest.substr(0, comma));
    rest.remove_prefix(std::min(comma + 2, rest.size()));
  }
  return names;
}

std::optional<double> number_in(std::string_view text, double min, double max) {
  const std::optional<double> number = parse_double(text);
  return number && *number >= min && *number <= max ? number : std::nullopt;
}

// "r,g,b", each from 0 to 1.
std::optional<Vec3d> light_from(std::string_view text) {
  Vec3d light;
  for (int channel = 0; channel < 3; ++channel) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (channel == 2)) return std::nullopt;
    const std::optional<double> number = number_in(text.substr(0, comma), 0, 1);
    if (!number) return std::nullopt;
    light[channel] = *number;
    text.remove_prefix(channel == 2 ? text.size() : comma + 1);
  }
  return light;
}

Result<LookAction> colour_action(const std::string& value) {
  const Result<ColourChoice> colour = colour_choice_from_text(value);
  if (!colour) return colour.error();
  return LookAction(SetColour{*colour});
}

Result<LookAction> colour_by_action(const std::string& value) {
  const Result<ColourBy> how = colour_by_from_text(value);
  if (!how) return how.error();
  return LookAction(*how);
}

Result<LookAction> opacity_action(const std::string& value) {
  const std::optional<double> opacity = number_in(value, 0, 1);
  if (!opacity) return unexpected("a number from 0 to 1", value);
  return LookAction(SetOpacity{*opacity});
}

Result<LookAction> material_action(const std::string& value) {
  if (const Material* material = value_named(named_materials(), value)) return LookAction(SetMaterial{*material});
  std::string names;
  for (const auto& [name, material] : named_materials()) names += (names.empty() ? "" : ", ") + name;
  return unexpected("one of " + names, value);
}

Result<LookAction> radius_scale_action(const std::string& value) {
  const std::optional<double> factor = number_in(value, 0, double{std::numeric_limits<float>::max()});
  if (!factor) return unexpected("a number from 0 to 3.4e38", value);
  return LookAction(ScaleRadius{*factor});
}

Result<LookAction> outline_action(const std::string& value) {
  const std::optional<double> width = number_in(value, 0, kWidestOutlinePx);
  if (!width || (*width > 0 && *width < 1)) return unexpected("0 or a number from 1 to 16", value);
  return LookAction(SetOutline{*width});
}

Result<LookAction> crease_action(const std::string& value) {
  if (value.empty()) return unexpected("the name of an attribute", value);
  return LookAction(SetCrease{value});
}

Result<LookAction> legend_name_action(const std::string& value) {
  if (value.empty()) return unexpected("a name of at least one character", value);
  return LookAction(SetLegendName{value});
}

Result<LookAction> clip_action(const std::string& value) {
  const Result<Clip> clip = clip_from_text(value);
  if (!clip) return clip.error();
  return LookAction(AddClip{*clip});
}

using FromText = Result<LookAction> (*)(const std::string& value);

const Names<FromText>& actions() {
  static const Names<FromText> all{
      {"hide", [](const std::string&) -> Result<LookAction> { return LookAction(SetShown{false}); }},
      {"show", [](const std::string&) -> Result<LookAction> { return LookAction(SetShown{true}); }},
      {"colour", colour_action},
      {"colour-by", colour_by_action},
      {"opacity", opacity_action},
      {"material", material_action},
      {"radius-scale", radius_scale_action},
      {"outline", outline_action},
      {"crease", crease_action},
      {"legend-name", legend_name_action},
      {"clip", clip_action}};
  return all;
}

}  // namespace

const std::vector<std::string>& look_action_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const auto& action : actions()) all.push_back(action.first);
    return all;
  }();
  return names;
}

Result<LookAction> look_action_from_text(std::string_view name, const std::string& value) {
  if (const FromText* from_text = value_named(actions(), name)) return (*from_text)(value);
  std::string known;
  for (const std::string& one : look_action_names()) known += (known.empty() ? "" : ", ") + one;
  return Error{"there is no action \"" + std::string(name) + "\"", "", 0, 0, "there are " + known};
}

Result<ColourChoice> colour_choice_from_text(const std::string& text) {
  if (const std::optional<Vec3d> light = light_from(text)) return ColourChoice(*light);
  if (colour_from_text(text, Transfer::srgb)) return ColourChoice(text);
  Error error = unexpected("#rrggbb, r,g,b with numbers from 0 to 1, or one of " + std::string(kColourNames), text);
  if (const std::string near = near_name(text, colour_names()); !near.empty())
    error.hint = "did you mean \"" + near + "\"?";
  return error;
}

}  // namespace bihive
