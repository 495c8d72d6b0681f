// A style fits any input: a material, colours, lights around the camera, and effects.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/colour_by.h"
#include "bihive/scene/density.h"
#include "bihive/scene/palette.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Maximum share of all spheres with one colour: above it, a picture says less than by element.
constexpr double kMostOfOneColour = 0.75;

/// Colours of atoms by an attribute instead of by element.
struct AtomColours {
  std::string attribute;   ///< such as chain
  std::int64_t above = 0;  ///< only for sets with more spheres
};

/// The settings of a style that states none: files' defaults, with lines that grow with the picture.
inline PictureSettings picture_of_style() {
  PictureSettings picture;
  picture.line_unit = LineUnit::picture;
  return picture;
}

struct Style {
  std::string name;
  std::string description;  ///< one line
  Material material = matte_material();
  ElementScheme element_colours = ElementScheme::jmol;
  /// For spheres without element, type and own colour, if they have the attribute. Unset: the material's colour.
  std::optional<ColourBy> colour_by;
  /// For spheres with elements, if the attribute distinguishes them: no value of it holds more than kMostOfOneColour of
  /// them. Unset: by element.
  std::optional<AtomColours> colour_atoms_by;
  /// Lines between spheres that touch and differ in this attribute, if they have it; empty: none.
  std::string crease;
  /// For sets of points: their radius and opacity follow from their density. Unset: they are as the file says.
  std::optional<DensityStyle> density;
  LightRig lights;
  Vec3d background{1, 1, 1};                     ///< linear
  PictureSettings picture = picture_of_style();  ///< its size and transfer are unused
};

/// The built-in styles, the default one first.
const std::vector<std::string>& style_names();

/// One of them. Error: there is none of this name; the hint lists all.
Result<Style> style_named(std::string_view name);

/// Parses a style file (docs/styles.md; docs/scene.schema.json under definitions/style). `file` is for messages, and
/// the name of a style without one. Missing keys are as in the style `plain`.
Result<Style> parse_style(std::string_view text, const std::string& file);

/// The scene gets the style's material, background, ambient light and effects, and keeps spheres, camera, lights,
/// plane, size and transfer.
void apply_style(const Style& style, Scene& scene);

}  // namespace bihive
