// What bihive render writes on a picture.
#pragma once

#include "bihive/job/picture_request.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// What of these the picture cannot have; the camera must stand already. Fails with kBadUsage on a label that the user
/// asks for; leaves out one of the scene's or style's, with a warning.
void leave_out_labels(const Overrides& user, const Scene& scene, RenderSettings& settings);

}  // namespace bihive
