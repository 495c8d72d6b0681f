// Colour maps: from a number to a colour of the screen.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "bihive/image/transfer.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// viridis, magma [SmithVanDerWalt2015] and cividis [Nunez2018] rise evenly in lightness; coolwarm [Moreland2009] has a
/// light middle between two colours; okabe_ito [OkabeIto2008] has eight colours for categories.
enum class ColourMap { viridis, magma, cividis, coolwarm, okabe_ito };

/// "viridis", "magma", "cividis", "coolwarm" or "okabe-ito".
std::optional<ColourMap> colour_map_from(std::string_view name);
/// For messages: every name that colour_map_from() knows.
constexpr std::string_view kColourMapNames = "viridis, magma, cividis, coolwarm, okabe-ito";

/// The linear colour that appears on the screen, under the transfer, as the map's colour at `share` (0 to 1; outside,
/// the end's colour). Between its 33 control colours a map is linear in the screen's values. Not for okabe_ito.
Vec3f map_colour(ColourMap map, double share, Transfer transfer);

}  // namespace bihive
