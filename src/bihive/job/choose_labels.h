// The labels of a picture of bihive render.
#pragma once

#include "bihive/job/picture_request.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Removes labels that the picture cannot have; the camera must be known. Fails with kBadUsage on a label that the user
/// asks for; drops one of the scene's or style's with a warning.
void leave_out_labels(const Overrides& user, const Scene& scene, RenderSettings& settings);

}  // namespace bihive
