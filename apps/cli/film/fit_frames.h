// The camera of a film that shows the spheres of all its frames.
#pragma once

#include "bihive/job/frame_source.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/style.h"
#include "film/film_plan.h"

namespace bihive::cli {

/// The camera in the direction of plan.fixed.camera that is as near as it can be with all spheres of all frames in the
/// picture, as looks, `follow` and `align` leave and move them. `first`: the input of the frame that is shown first.
/// Reads all frames.
Camera camera_over_frames(const FrameSource& source, const FilmPlan& plan, const FilmOptions& options,
                          const Style& style, const Input& first, const RenderSettings& settings);

}  // namespace bihive::cli
