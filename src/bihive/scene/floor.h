// A plane below the spheres, as `--floor` and the viewer lay it.
#pragma once

#include <optional>
#include <string>

#include "bihive/geometry/plane.h"
#include "bihive/math/vec3.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// The word for a floor that is seen by the shadows on it alone; other floors are said by their colours.
inline const std::string kFloorOfShadows = "shadow";

/// Touches the lowest of the spheres that clips leave; `up`, of length 1, is its normal.
Plane plane_below(const Scene& scene, Vec3d up);

/// A floor of the scene's first material in that plane, opaque. Without a colour (linear RGB) it is seen by the shadows
/// on it alone, and is matte where the material takes no light.
ScenePlane floor_in(const Plane& plane, const std::optional<Vec3d>& colour, const Scene& scene);

}  // namespace bihive
