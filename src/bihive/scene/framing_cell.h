// A camera that brings a set and its periodic cell into view.
#pragma once

#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/framing.h"

namespace bihive {

/// The eight outermost corners of the cell and of its copies; none without a cell.
std::vector<Vec3d> cell_corners(const SphereSet& spheres);

/// As frame_spheres() of scene/framing.h, with the corners of the cell and of its copies inside the picture too.
/// Without a cell it is that camera.
Camera frame_with_cell(const SphereSet& spheres, const Side& side, const Lens& lens, int width_px, int height_px,
                       const Insets& insets = {});

}  // namespace bihive
