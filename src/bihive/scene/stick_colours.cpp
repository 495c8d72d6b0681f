#include "bihive/scene/stick_colours.h"

#include <algorithm>
#include <utility>

#include "bihive/base/setting_name.h"
#include "bihive/scene/look_text.h"
#include "bihive/select/number_term.h"

namespace bihive {

Error error_of_setting(const std::string& setting, const Error& error) {
  const std::string place = error.column > 0 ? "column " + std::to_string(error.column) + ": " : "";
  return {setting_name(setting) + ": " + place + error.message, "", 0, 0, error.hint};
}

Result<std::vector<Vec3f>> stick_colours(const SphereSet& rows, const Scene& scene, const std::string& setting,
                                         const std::string& text, const std::vector<std::uint8_t>& mask,
                                         std::optional<ColourBy>& how) {
  if (text.empty()) return std::vector<Vec3f>();
  std::vector<Vec3f> colours(mask.size());
  if (const Result<ColourChoice> choice = colour_choice_from_text(text); choice) {
    if (find_attribute(rows, text).found())
      return Error{setting_name(setting) + ": \"" + text + "\" is a colour and an attribute", "", 0, 0,
                   "write the colour as #rrggbb, or a map after the attribute: " + text + ":viridis"};
    const Result<Vec3f> colour = linear_colour(*choice, scene.picture.transfer);
    if (!colour) return error_of_setting(setting, colour.error());
    std::fill(colours.begin(), colours.end(), *colour);
    return colours;
  }
  const Result<ColourBy> asked_for = colour_by_from_text(text);
  if (!asked_for) return error_of_setting(setting, asked_for.error());
  if (const Result<FoundAttribute> found = find_numbers(rows, asked_for->attribute); !found)
    return error_of_setting(setting, {"no colour, and " + found.error().message, "", 0, 0, found.error().hint});
  Result<ColourBy> done = colour_by(rows, *asked_for, mask, scene.picture.transfer, colours, scene.element_colours);
  if (!done) return error_of_setting(setting, done.error());
  how = std::move(*done);
  return colours;
}

}  // namespace bihive
