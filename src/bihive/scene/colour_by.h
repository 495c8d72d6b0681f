// Colours from what is known of spheres: from a number by a map, from a text or type by category.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/colour_maps.h"

namespace bihive {

/// Linear RGB from 0 to 1, or a text for colour_from_text(), whose meaning depends on the scene's transfer.
using ColourChoice = std::variant<Vec3d, std::string>;

/// Error: the text is no colour.
Result<Vec3f> linear_colour(const ColourChoice& colour, Transfer transfer);

struct ColourBy {
  std::string attribute;         ///< a name as selections know it, or arithmetic of names: "sqrt(vx^2 + vy^2)"
  std::optional<ColourMap> map;  ///< unset: by category for texts, types and elements, else viridis
  std::optional<std::pair<double, double>> range;  ///< unset: the finite values of the coloured spheres
  bool logarithmic = false;                        ///< the map runs along the logarithm; numbers <= 0 are below it
  ColourChoice nan_colour = std::string("grey");   ///< of spheres whose number is unknown (NaN)
  std::optional<std::pair<double, double>> percentiles = {};  ///< of these values, in place of an open range's ends
  std::optional<double> middle = {};                          ///< the range is widened so that the map's middle is here
  std::string title = {};                                     ///< of the legend's key; empty: the attribute
};

/// The file name that stands in place of a map in a text for colour_by_from_text(); empty if there is none. A part with
/// a dot or a slash that is no range, number or map is a file name. with_map() replaces it by colours.
std::string colour_map_file(std::string_view text);
std::string with_map(std::string_view text, const std::vector<std::uint32_t>& colours);

/// "ATTR", then ":MAP", ":MIN,MAX" (numbers, or percentiles such as 2%,98%; MIN above MAX reverses the map), ":log" and
/// ":mid=NUMBER", each of which may be left out; MAP comes first. An error says what was expected.
Result<ColourBy> colour_by_from_text(const std::string& text);

/// Sets `colours` (one for each sphere) where the mask is not 0. Numbers outside the range have the colour of its end.
/// Returns what was done: of a continuous map, its name and its range, also where `how` left them open; of categories,
/// no range. `element_colours`: as Scene::element_colours. Error: the set lacks the attribute, no number is known, or
/// the range has no extent that the map can show.
Result<ColourBy> colour_by(const SphereSet& spheres, const ColourBy& how, const std::vector<std::uint8_t>& mask,
                           Transfer transfer, std::vector<Vec3f>& colours,
                           const std::vector<Vec3f>& element_colours = {});

/// The smallest and the greatest number of the attribute that colour_by() would take for an open range, above 0 if the
/// map is logarithmic. Nothing: the set has no such numbers.
std::optional<std::pair<double, double>> number_range(const SphereSet& spheres, const ColourBy& how);

/// The place of a number in a range, 0 to 1 inside of it; 0.5 if the range has no extent, -inf for 0 or less on a
/// logarithmic scale. NaN: unknown.
double place_in_range(std::pair<double, double> range, bool logarithmic, double number);

}  // namespace bihive
