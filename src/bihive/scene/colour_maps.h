// Colour maps: from a number to a colour of the screen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/image/transfer.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// viridis, magma, plasma, inferno [SmithVanDerWalt2015], cividis [Nunez2018] and greys rise evenly in lightness; turbo
/// [Mikhailov2019] has all colours of the rainbow; coolwarm [Moreland2009] and RdBu [HarrowerBrewer2003] have a light
/// middle between two colours; okabe_ito [OkabeIto2008] is for categories; own: `colours`.
struct ColourMap {
  enum Name { viridis, magma, plasma, inferno, cividis, turbo, greys, coolwarm, rd_bu, okabe_ito, own };

  Name name = viridis;
  bool is_reversed = false;
  std::vector<std::uint32_t> colours;  ///< of `own`: 0xRRGGBB as on the screen, at equal distances; 2 to 1024

  ColourMap() = default;
  ColourMap(Name known) : name(known) {}  // NOLINT(google-explicit-constructor): a name is a map
  friend bool operator==(const ColourMap& a, const ColourMap& b) = default;
};

constexpr std::size_t kMostMapColours = 1024;

/// "viridis", "RdBu", "okabe-ito" ...; all but the last also with "_r" after it: reversed. Or own colours, each #rrggbb
/// or a name, with a dash between them: "blue-white-#ff0000".
std::optional<ColourMap> colour_map_from(std::string_view name);
/// Every name that colour_map_from() knows, without "_r".
std::vector<std::string> colour_map_names();
/// Own colours as colour_map_from() takes them.
std::string text_of_colours(const std::vector<std::uint32_t>& colours);

/// The colours of a file: one on each line, #rrggbb, a name, or three numbers with blanks or commas between them: from
/// 0 to 1, or if any in the file is larger, to 255. Other lines that begin with # are remarks. Errors have their line.
Result<std::vector<std::uint32_t>> read_colour_map(std::string_view text, const std::string& file);

/// The same map from its end to its beginning. Not for okabe_ito.
ColourMap reversed(ColourMap map);

/// The linear colour that appears on the screen, under the transfer, as the map's colour at `share` (0 to 1; outside,
/// the end's colour). Between its control colours (33 of a named map) it is linear in the screen's values. Not for
/// okabe_ito.
Vec3f map_colour(const ColourMap& map, double share, Transfer transfer);

}  // namespace bihive
