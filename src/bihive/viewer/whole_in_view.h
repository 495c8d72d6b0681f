// Keeps the whole set in the picture while it turns.
#pragma once

#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/camera.h"
#include "bihive/viewer/orbit.h"

namespace bihive {

/// The same camera, as much farther away from look_at as every sphere needs to lie inside the picture less the margin
/// of frame_spheres() (scene/framing.h). It never comes nearer. An orthographic camera gets a longer shorter side
/// instead, and stays in front of all spheres. Costs a pass over all spheres. The camera must pass check_camera().
Camera with_all_in_view(const SphereSet& spheres, const Camera& camera, PictureSizePx size);

}  // namespace bihive
