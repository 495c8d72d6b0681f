// Colours as people write them: "#rrggbb", "srgb(r,g,b)" or a name.
#pragma once

#include <optional>
#include <string_view>

#include "bihive/image/transfer.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// The linear radiance that appears on the screen as the text's colour. Each byte v is v / 255 with the transfer
/// `none`; with `srgb` the inverse of the sRGB curve is applied to that. "srgb(r,g,b)" has numbers from 0 to 1 in place
/// of these quotients. Nothing if the text is none of these, nor one of kColourNames.
std::optional<Vec3d> colour_from_text(std::string_view text, Transfer transfer);

/// For messages: every name that colour_from_text() knows.
constexpr std::string_view kColourNames =
    "white, black, grey, red, green, blue, yellow, cyan, magenta, orange, purple, brown, pink";

}  // namespace bihive
