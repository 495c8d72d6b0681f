#include "bihive/job/floor.h"

#include <optional>

#include "bihive/base/setting_name.h"
#include "bihive/job/failure.h"
#include "bihive/job/values.h"
#include "bihive/scene/floor.h"

namespace bihive {
namespace {

Vec3d up_in_world(const PictureRequest& request, const Input& input) {
  const bool has_own = input.has_camera && !request.view_from && !request.view_of;
  return normalized(request.up ? *request.up : has_own ? input.scene.camera.up : Vec3d{0, 1, 0});
}

}  // namespace

void lay_floor(const PictureRequest& request, const RenderSettings& settings, Input& input) {
  if (!request.floor) return;
  Scene& scene = input.scene;
  if (scene.plane) fail_setting("floor", ": the scene has a plane of its own", "leave out " + setting_name("floor"));
  if (settings.view != View::shaded)
    fail_setting("floor", " is for the shaded picture", "leave out " + setting_name("view"));
  const bool is_of_shadows = *request.floor == kFloorOfShadows;
  if (is_of_shadows && !settings.shadows && !settings.ambient_occlusion)
    fail_setting("floor", " shadow shows shadows, and the picture has none",
                 "add " + setting_name("shadows") + " or " + setting_name("ao"));
  const bool is_of_film = request.fixed && request.fixed->floor;
  const Plane plane = is_of_film ? *request.fixed->floor : plane_below(scene, up_in_world(request, input));
  scene.plane = floor_in(
      plane, is_of_shadows ? std::nullopt : std::optional(*colour_from(*request.floor, scene.picture.transfer)), scene);
}

}  // namespace bihive
