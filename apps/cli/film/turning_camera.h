// The camera of a film that turns around its spheres.
#pragma once

#include "bihive/job/input.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/render_settings.h"
#include "commands/commands.h"

namespace bihive::cli {

/// A camera in the direction of `camera`, aimed at the centre of the spheres (and of the cell, if that is drawn), that
/// sees all of them from every side.
Camera camera_around(const Input& input, const Camera& camera, const RenderOptions& options,
                     const RenderSettings& settings);

}  // namespace bihive::cli
