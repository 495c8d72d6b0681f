// The option `floor`: a plane below the spheres.
#pragma once

#include "bihive/geometry/plane.h"
#include "bihive/job/input.h"
#include "bihive/job/picture_request.h"
#include "bihive/scene/render_settings.h"

namespace bihive {

/// Gives the scene the plane that request.floor asks for: that of the film, or one that touches the lowest sphere, at
/// right angles to what is up in the world: `up`, else of a scene's own camera its up, else y. Fails with kBadUsage if
/// the scene has a plane of its own, or if nothing in the picture could throw a shadow.
void lay_floor(const PictureRequest& request, const RenderSettings& settings, Input& input);

}  // namespace bihive
