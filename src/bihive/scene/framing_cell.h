// A camera that brings a set and its periodic cell into view.
#pragma once

#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/framing.h"

namespace bihive {

/// As frame_spheres() of scene/framing.h, with the corners of the cell and of its copies inside of the picture too.
/// Without a cell it is that camera.
Camera frame_with_cell(const SphereSet& spheres, const Side& side, const Lens& lens, int width_px, int height_px);

}  // namespace bihive
