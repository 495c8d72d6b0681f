#include "bihive/scene/default_colours.h"

#include "bihive/scene/palette.h"

namespace bihive {

void take_default_colours(Scene& scene, std::string_view format, const Style* style) {
  if (format == "PDB" || format == "mmCIF") scene.length_unit = "\u00C5";
  const ElementScheme scheme = style != nullptr ? style->element_colours : ElementScheme::jmol;
  const std::string_view attribute = colour_spheres(scene.spheres, scheme);
  if (attribute.empty()) return;
  ColourBy how;
  how.attribute = attribute;
  scene.coloured_by = {how};
}

}  // namespace bihive
