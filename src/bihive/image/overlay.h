// Blends masks of one colour over finished pixels, with or without opacity.
#pragma once

#include "bihive/image/png_pixels.h"
#include "bihive/image/shape.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// Covers the pixels with `colour` (values of the screen, 0 to 1) by opacity x the mask's share. `part`: the pixels of
/// the whole picture that `pixels` holds; masks are placed in the whole picture. Where pixels have opacity, the
/// result's opacity and colour are those of a layer above another one.
void blend(PngPixels& pixels, const Tile& part, const CoverageMask& mask, Vec3d colour, double opacity = 1);

}  // namespace bihive
