#include "bihive/scene/default_colours.h"

#include <cstdint>
#include <utility>
#include <vector>

#include "bihive/scene/palette.h"

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

}  // namespace

void take_default_colours(Scene& scene, std::string_view format, const Style* style) {
  if (format == "PDB" || format == "PQR" || format == "mmCIF" || format == "GRO") scene.length_unit = "\u00C5";
  const ElementScheme scheme = style != nullptr ? style->element_colours : ElementScheme::jmol;
  const std::string_view attribute = colour_spheres(scene.spheres, scheme);
  if (attribute.empty()) {
    if (style != nullptr && style->colour_by && scene.spheres.attributes().colour.empty())
      colour_by_style(*style->colour_by, scene);
    return;
  }
  ColourBy how;
  how.attribute = attribute;
  scene.coloured_by = {how};
}

}  // namespace bihive
