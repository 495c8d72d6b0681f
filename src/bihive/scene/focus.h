// Focus on selected spheres.
#pragma once

#include <string>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/camera.h"

namespace bihive {

/// The mean distance along the view of the selected spheres' centres: a value for Camera::focus. Errors: the
/// selection's (select/selection.h), that it matches no sphere, or that they are not in front of the camera.
Result<double> focus_on(const SphereSet& spheres, const Camera& camera, const std::string& selection);

}  // namespace bihive
