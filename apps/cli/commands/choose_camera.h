// The camera of bihive render.
#pragma once

#include "bihive/scene/camera.h"
#include "bihive/scene/render_settings.h"
#include "commands/commands.h"
#include "support/input.h"

namespace bihive::cli {

/// The scene's own camera, or one that shows everything; the user's options replace parts of it. Fails with kBadUsage
/// if the options contradict each other or the camera sees nothing.
Camera choose_camera(const Input& input, const RenderOptions& options, const RenderSettings& settings);

}  // namespace bihive::cli
