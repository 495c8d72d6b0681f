// Other colours for chemical elements than those of palette.h.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/palette.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// By atomic number: linear RGB; no value: the usual colour (element_colour()).
using ElementColours = std::array<std::optional<Vec3f>, kElementNumbers>;

/// "cpk": the colours of RasMol [SayleMilnerWhite1995], after the models of Corey, Pauling and Koltun. "jmol" and
/// "soft": those of palette.h. Nothing for any other name.
std::optional<ElementColours> element_colours_called(std::string_view name);

/// The names that element_colours_called() knows.
std::vector<std::string> element_colour_names();

/// Parses lines `C #rrggbb`: a symbol in upper or lower case, or X for an unknown element, and a colour or its name as
/// it appears on the screen with the sRGB curve. Blank lines, and lines that begin with # are skipped. Errors have
/// file, line and column.
Result<ElementColours> read_element_colours(std::string_view text, const std::string& file);

/// Gives the spheres these colours, also where the style colours them by something else, and colour_by() too. Where
/// they have those of the input or of elements, one whose colour is none of palette.h for its element keeps it. Error:
/// no element is known.
Status recolour_elements(Scene& scene, const ElementColours& colours);

}  // namespace bihive
