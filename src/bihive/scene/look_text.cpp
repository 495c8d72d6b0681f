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
#include "bihive/math/vector_text.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/named_materials.h"

namespace bihive {
namespace {

std::optional<double> number_in(std::string_view text, double min, double max) {
  const std::optional<double> number = parse_double(text);
  return number && *number >= min && *number <= max ? number : std::nullopt;
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

Result<LookAction> hide_action(const std::string&) {
  return LookAction(SetShown{false});
}

Result<LookAction> show_action(const std::string&) {
  return LookAction(SetShown{true});
}

constexpr LookActionText kActions[] = {
    {.name = "hide", .from_text = hide_action},
    {.name = "show", .from_text = show_action},
    {.name = "colour",
     .value = "a colour",
     .example = "orange or #ff8800",
     .names = ValueNames::colours,
     .from_text = colour_action},
    {.name = "colour-by",
     .value = "an attribute",
     .example = "chain or b_factor:magma",
     .names = ValueNames::attributes,
     .from_text = colour_by_action},
    {.name = "opacity", .value = "an opacity", .example = "0 to 1", .is_number = true, .from_text = opacity_action},
    {.name = "material",
     .value = "a material",
     .example = "metal",
     .names = ValueNames::materials,
     .from_text = material_action},
    {.name = "radius-scale",
     .label = "radius ×",
     .value = "a factor",
     .example = "0.5",
     .is_number = true,
     .from_text = radius_scale_action},
    {.name = "outline",
     .label = "outline px",
     .value = "a width",
     .example = "0 to 16",
     .is_number = true,
     .from_text = outline_action},
    {.name = "crease",
     .value = "an attribute",
     .example = "chain",
     .names = ValueNames::attributes,
     .from_text = crease_action},
    {.name = "legend-name",
     .label = "name in legend",
     .value = "a name",
     .example = "ligand",
     .from_text = legend_name_action},
    {.name = "clip", .value = "a shape", .example = "plane:0,0,1,0", .from_text = clip_action},
};

}  // namespace

std::span<const LookActionText> look_actions() {
  return kActions;
}

const LookActionText* look_action_named(std::string_view name) {
  for (const LookActionText& action : kActions)
    if (action.name == name) return &action;
  return nullptr;
}

const std::vector<std::string>& look_action_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const LookActionText& action : kActions) all.emplace_back(action.name);
    return all;
  }();
  return names;
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

Result<LookAction> look_action_from_text(std::string_view name, const std::string& value) {
  if (const LookActionText* action = look_action_named(name)) return action->from_text(value);
  std::string known;
  for (const std::string& one : look_action_names()) known += (known.empty() ? "" : ", ") + one;
  return Error{"there is no action \"" + std::string(name) + "\"", "", 0, 0, "there are " + known};
}

Result<ColourChoice> colour_choice_from_text(const std::string& text) {
  if (const std::optional<Vec3d> light = vector_from_text(text, 0, 1)) return ColourChoice(*light);
  if (colour_from_text(text, Transfer::srgb)) return ColourChoice(text);
  Error error = unexpected("#rrggbb, r,g,b with numbers from 0 to 1, or one of " + std::string(kColourNames), text);
  if (const std::string near = near_name(text, colour_names()); !near.empty())
    error.hint = "did you mean \"" + near + "\"?";
  return error;
}

}  // namespace bihive
