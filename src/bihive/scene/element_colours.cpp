#include "bihive/scene/element_colours.h"

#include <algorithm>

#include "bihive/image/colour_text.h"
#include "bihive/io/elements.h"
#include "bihive/io/text/text_scanner.h"
#include "bihive/scene/palette.h"

namespace bihive {
namespace {

struct SymbolColour {
  std::string_view symbol, colour;
};

// RasMol's table of colours for the scheme CPK, as they appear on the screen.
constexpr SymbolColour kCpkColours[] = {
    {"H", "#ffffff"},  {"C", "#c8c8c8"},  {"N", "#8f8fff"},  {"O", "#f00000"},  {"S", "#ffc832"},  {"P", "#ffa500"},
    {"F", "#daa520"},  {"Cl", "#00ff00"}, {"Br", "#a52a2a"}, {"I", "#a020f0"},  {"He", "#ffc0cb"}, {"Li", "#b22222"},
    {"Na", "#0000ff"}, {"Mg", "#228b22"}, {"Al", "#808090"}, {"Si", "#daa520"}, {"B", "#00ff00"},  {"Ca", "#808090"},
    {"Ti", "#808090"}, {"Cr", "#808090"}, {"Mn", "#808090"}, {"Fe", "#ffa500"}, {"Ni", "#a52a2a"}, {"Cu", "#a52a2a"},
    {"Zn", "#a52a2a"}, {"Ag", "#808090"}, {"Ba", "#ffa500"}, {"Au", "#daa520"},
};
constexpr const char* kCpk = "cpk";
constexpr std::string_view kUnknownCpk = "#ff1493";

Vec3f linear_from_text(std::string_view colour) {
  return to_float(*colour_from_text(colour, Transfer::srgb));
}

}  // namespace

std::optional<ElementColours> element_colours_called(std::string_view name) {
  ElementColours colours;
  if (const ElementScheme* scheme = value_named(kElementSchemes, name)) {
    for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = element_colour(static_cast<int>(i), *scheme);
    return colours;
  }
  if (name != kCpk) return std::nullopt;
  colours.fill(linear_from_text(kUnknownCpk));
  for (const SymbolColour& one : kCpkColours)
    colours[static_cast<std::size_t>(atomic_number(one.symbol))] = linear_from_text(one.colour);
  return colours;
}

std::vector<std::string> element_colour_names() {
  std::vector<std::string> names;
  for (const auto& [name, scheme] : kElementSchemes) names.push_back(name);
  names.emplace_back(kCpk);
  return names;
}

Result<ElementColours> read_element_colours(std::string_view text, const std::string& file) {
  ElementColours colours;
  TextScanner scanner(text, file);
  std::int64_t lines = 0;
  while (scanner.next_filled_line()) {
    if (trim(scanner.line()).front() == '#') continue;
    std::string_view field;
    scanner.next_field(field);
    const int number = atomic_number(field);
    if (number == 0 && lower_case(field) != "x")
      return scanner.field_error("expected an element's symbol, or X, but found " + quote(field),
                                 "a line is a symbol and a colour: C #909090");
    if (!scanner.next_field(field)) return scanner.line_error("expected a colour after the symbol", "C #909090");
    const auto colour = colour_from_text(field, Transfer::srgb);
    if (!colour)
      return scanner.field_error("expected a colour but found " + quote(field),
                                 "colours are #rrggbb or one of " + std::string(kColourNames));
    if (std::string_view more; scanner.next_field(more))
      return scanner.field_error("expected a symbol and a colour on this line, but found more: " + quote(more));
    colours[static_cast<std::size_t>(number)] = to_float(*colour);
    ++lines;
  }
  if (lines == 0) return Error{"there is no line with an element and its colour in it", file, 0, 0, "C #909090"};
  return colours;
}

Status recolour_elements(Scene& scene, const ElementColours& colours) {
  SphereAttributes& attributes = scene.spheres.attributes();
  if (attributes.element.empty()) return Error{"the input has no elements", "", 0, 0, ""};
  if (scene.element_colours.empty()) scene.element_colours = element_colours_of(ElementScheme::jmol);
  for (std::size_t number = 0; number < colours.size(); ++number)
    if (colours[number]) scene.element_colours[number] = *colours[number];

  // Spheres that the style colours by another attribute are recoloured.
  const bool keeps_others = scene.coloured_by.empty() || scene.coloured_by.front().attribute == "element";
  for (std::size_t i = 0; i < attributes.colour.size(); ++i) {
    const std::uint8_t element = attributes.element[i];
    const bool usual = std::any_of(kElementSchemes.begin(), kElementSchemes.end(), [&](const auto& scheme) {
      return attributes.colour[i] == element_colour(element, scheme.second);
    });
    if ((usual || !keeps_others) && element < colours.size()) attributes.colour[i] = scene.element_colours[element];
  }
  if (keeps_others) return Done{};
  ColourBy by_element;
  by_element.attribute = "element";
  scene.coloured_by = {by_element};
  scene.coloured_by_of_sphere.clear();
  scene.legend_names.clear();
  return Done{};
}

}  // namespace bihive
