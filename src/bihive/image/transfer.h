// From linear radiance to what is written into a picture.
#pragma once

#include <cstdint>

#include "bihive/math/vec3.h"

namespace bihive {

/// srgb: the sRGB curve [IEC61966-2-1]. none: the value as it is, as in the thesis's pictures.
enum class Transfer { srgb, none };

/// The sRGB curve and its inverse on [0, 1], built on the library's own pow (same bits everywhere).
double srgb_from_linear(double linear);
double linear_from_srgb(double srgb);

/// Clamps to [0, 1] (NaN gives 0), applies the curve, and rounds to the nearest of 0 ... 255.
std::uint8_t byte_from_radiance(double radiance, Transfer transfer);

}  // namespace bihive
