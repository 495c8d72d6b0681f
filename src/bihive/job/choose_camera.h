// The camera of bihive render.
#pragma once

#include <cstdint>
#include <functional>

#include "bihive/job/camera_selections.h"
#include "bihive/job/input.h"
#include "bihive/job/picture_request.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/render_settings.h"

namespace bihive {

/// Facts about the whole set that a picture needs, in a process that holds a chunk of it (commands/render_spread.cpp).
struct WholeSet {
  std::int64_t count = 0;
  SphereSet::Bounds bounds;  ///< of what clips leave
  /// As frame_picture(). Collective: all processes that have chunks call it.
  std::function<Camera(const Scene&, const Side&, const Lens&, const RenderSettings&)> frame;
};

/// The scene's own camera, or one that shows everything, with the user's options. Fails with kBadUsage if the options
/// contradict each other or the camera sees nothing. `selections`: those of the request. `whole`: null if the scene has
/// all spheres.
Camera choose_camera(const Input& input, const PictureRequest& request, const RenderSettings& settings,
                     const CameraSelections& selections, const WholeSet* whole = nullptr);

}  // namespace bihive
