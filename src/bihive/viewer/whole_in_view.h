// Keeps the whole set in the picture while it turns.
#pragma once

#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/camera.h"
#include "bihive/viewer/orbit.h"

namespace bihive {

/// The same camera, as much farther away from look_at as every sphere, every image of one and every point needs to lie
/// inside the picture less kFreeBorder (scene/framing.h) on each side. It never comes nearer. An orthographic camera
/// gets a longer shorter side instead, and stays in front of all spheres. Costs at most eight passes over the stored
/// spheres. The camera must pass check_camera().
Camera with_all_in_view(const SphereSet& spheres, const std::vector<Vec3d>& points, const Camera& camera,
                        PictureSizePx size);

}  // namespace bihive
