#include "bihive/scene/default_colours.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/scene/palette.h"
#include "bihive/select/attribute_names.h"

namespace bihive {
namespace {

// Leaves the scene alone if the spheres lack the attribute.
void colour_by_style(const ColourBy& how, Scene& scene) {
  const auto count = static_cast<std::size_t>(scene.spheres.size());
  std::vector<Vec3f> colours(count);
  const Result<ColourBy> done =
      colour_by(scene.spheres, how, std::vector<std::uint8_t>(count, 1), scene.picture.transfer, colours);
  if (!done) return;
  scene.spheres.attributes().colour = std::move(colours);
  scene.coloured_by = {*done};
}

// Whether the attribute has several values, none of them with too many spheres.
bool tells_apart(const SphereSet& spheres, const std::string& attribute) {
  const FoundAttribute found = find_attribute(spheres, attribute);
  if (!found.found()) return false;
  std::map<double, std::int64_t> count_of;
  std::int64_t most = 0;
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    const double value = found.texts != nullptr ? double(found.texts->text_of_sphere[static_cast<std::size_t>(id)])
                                                : found.number_of(spheres, id);
    if (!std::isnan(value)) most = std::max(most, ++count_of[value]);
  }
  return count_of.size() > 1 && static_cast<double>(most) <= kMostOfOneColour * static_cast<double>(spheres.size());
}

bool colours_atoms(const std::optional<AtomColours>& how, const SphereSet& spheres) {
  return how && spheres.size() > how->above && tells_apart(spheres, how->attribute);
}

}  // namespace

void take_default_colours(Scene& scene, std::string_view format, const Style* style) {
  if (format == "PDB" || format == "PQR" || format == "mmCIF" || format == "GRO") scene.length_unit = "\u00C5";
  const ElementScheme scheme = style != nullptr ? style->element_colours : ElementScheme::jmol;
  scene.element_colours = element_colours_of(scheme);
  const std::string_view attribute = colour_spheres(scene.spheres, scheme);
  if (attribute.empty()) {
    if (style != nullptr && style->colour_by && scene.spheres.attributes().colour.empty())
      colour_by_style(*style->colour_by, scene);
    return;
  }
  ColourBy how;
  how.attribute = attribute;
  scene.coloured_by = {how};
  if (style != nullptr && attribute == "element" && colours_atoms(style->colour_atoms_by, scene.spheres)) {
    how.attribute = style->colour_atoms_by->attribute;
    colour_by_style(how, scene);
  }
}

}  // namespace bihive
