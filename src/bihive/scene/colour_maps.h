// Colour maps: from a number to a colour of the screen.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/image/transfer.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// viridis, magma, plasma, inferno [SmithVanDerWalt2015], cividis [Nunez2018] and greys rise evenly in lightness; turbo
/// [Mikhailov2019] has all colours of the rainbow; coolwarm [Moreland2009] and RdBu [HarrowerBrewer2003] have a light
/// middle between two colours; okabe_ito [OkabeIto2008] is for categories.
enum class ColourMap { viridis, magma, plasma, inferno, cividis, turbo, greys, coolwarm, rd_bu, okabe_ito };

/// "viridis", "RdBu", "okabe-ito" ...; all but the last also with "_r" after it: reversed.
std::optional<ColourMap> colour_map_from(std::string_view name);
/// Every name that colour_map_from() knows, without "_r".
std::vector<std::string> colour_map_names();

/// The same map from its end to its beginning. Not for okabe_ito.
ColourMap reversed(ColourMap map);

/// The linear colour that appears on the screen, under the transfer, as the map's colour at `share` (0 to 1; outside,
/// the end's colour). Between its 33 control colours a map is linear in the screen's values. Not for okabe_ito.
Vec3f map_colour(ColourMap map, double share, Transfer transfer);

}  // namespace bihive
