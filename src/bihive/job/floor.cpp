#include "bihive/job/floor.h"

#include <algorithm>
#include <limits>

#include "bihive/base/setting_name.h"
#include "bihive/image/colour_text.h"
#include "bihive/job/failure.h"
#include "bihive/scene/clips.h"

namespace bihive {
namespace {

Vec3d up_in_world(const PictureRequest& request, const Input& input) {
  const bool has_own = input.has_camera && !request.view_from && !request.view_of;
  return normalized(request.up ? *request.up : has_own ? input.scene.camera.up : Vec3d{0, 1, 0});
}

// Below the lowest point of the set.
Plane plane_below(const Scene& scene, Vec3d up) {
  double lowest = std::numeric_limits<double>::infinity();
  const RemainingSpheres remaining(scene);
  const SphereSet& spheres = remaining.set();
  for (std::int64_t id = 0; id < spheres.total_size(); ++id)
    lowest = std::min(lowest, dot(up, spheres.centre(id)) - spheres.radius(id));
  return {(spheres.empty() ? 0 : lowest) * up, up};
}

}  // namespace

void lay_floor(const PictureRequest& request, const RenderSettings& settings, Input& input) {
  if (!request.floor) return;
  Scene& scene = input.scene;
  if (scene.plane) fail_setting("floor", ": the scene has a plane of its own", "leave out " + setting_name("floor"));
  if (settings.view != View::shaded)
    fail_setting("floor", " is for the shaded picture", "leave out " + setting_name("view"));
  ScenePlane floor;
  const bool is_of_film = request.fixed && request.fixed->floor;
  floor.plane = is_of_film ? *request.fixed->floor : plane_below(scene, up_in_world(request, input));
  floor.material = scene.materials.front();
  floor.material.transmissive = 0;
  floor.shadows_only = *request.floor == kFloorOfShadows;
  if (floor.shadows_only) {
    if (!settings.shadows && !settings.ambient_occlusion)
      fail_setting("floor", " shadow shows shadows, and the picture has none",
                   "add " + setting_name("shadows") + " or " + setting_name("ao"));
    const bool is_lit = floor.material.diffuse > 0 || floor.material.ambient > 0;
    if (!is_lit) floor.material = matte_material();
  } else {
    floor.material.colour = *colour_from(*request.floor, scene.picture.transfer);
  }
  scene.plane = floor;
}

}  // namespace bihive
