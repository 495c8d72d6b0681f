// A camera that magnifies some of the spheres.
#pragma once

#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// `before` with the selected spheres as large in the picture as its margins and labels allow. Direction, up and
/// projection stay, and the eye stays in its plane at right angles to the view: it moves sideways, and the angle
/// becomes smaller (or larger). Nothing comes to lie behind the eye that was in front of it, except that an
/// orthographic eye moves back from among the selected spheres. Fails with kBadUsage where a perspective eye is not in
/// front of all of them.
Camera zoomed_to(const Scene& scene, const SphereSet& selected, const Camera& before, const RenderSettings& settings);

}  // namespace bihive
