#include "bihive/viewer/shown_scene.h"

#include <utility>

#include "bihive/render/frame_picture.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/focus.h"
#include "bihive/scene/framed_spheres.h"
#include "bihive/scene/framing_cell.h"
#include "bihive/viewer/whole_in_view.h"

namespace bihive {

SceneFacts facts_of(const LoadedScene& loaded) {
  SceneFacts facts{loaded.scene.name, loaded.format, loaded.scene.spheres.size(),
                   loaded.frames,     loaded.rules,  loaded.warnings};
  facts.title = loaded.title;
  facts.entry_id = loaded.entry_id;
  return facts;
}

std::string title_of(const SceneFacts& facts) {
  const std::string name = facts.title.empty() ? facts.name.substr(facts.name.rfind('/') + 1) : facts.title;
  return facts.entry_id.empty() || facts.entry_id == name ? name : name + " \u00b7 " + facts.entry_id;
}

ShownScene::ShownScene(LoadedScene loaded)
    : scene(std::move(loaded.scene)),
      has_camera(loaded.has_camera),
      has_lights(loaded.has_lights),
      states_fog(loaded.states_fog),
      rig(std::move(loaded.rig)),
      own_camera(scene.camera) {
  const SphereSet::Bounds bounds = scene.spheres.bounds();
  diagonal = length(bounds.hi - bounds.lo);
}

Camera ShownScene::framed(ViewFrom side, const Camera& like, const ViewerSettings& settings, PictureSizePx size) const {
  RenderSettings picture = settings_from(settings.picture.result());
  picture.stereo = {};
  picture.width_px = size.width;
  picture.height_px = size.height;
  picture.view = settings.view;
  Camera camera = frame_picture(scene, side_of(side), {like.fov_deg, like.projection}, picture);
  camera.aperture = like.aperture;
  camera.focus = like.focus;
  return camera;
}

Camera ShownScene::far_enough(const Camera& camera, bool cell, PictureSizePx size) const {
  const std::vector<Vec3d> corners = cell ? cell_corners(scene.spheres) : std::vector<Vec3d>();
  return with_all_in_view(FramedSpheres(scene, 1).set(), corners, camera, size);
}

bool ShownScene::same_spheres(const ShownScene& other) const {
  const SphereSet &a = scene.spheres, &b = other.scene.spheres;
  return a.scale_exponent() == b.scale_exponent() && a.origin() == b.origin() && a.x() == b.x() && a.y() == b.y() &&
         a.z() == b.z() && a.r() == b.r() && a.images().counts == b.images().counts &&
         a.images().vectors == b.images().vectors && scene.sticks == other.scene.sticks && same_clips(other);
}

bool ShownScene::same_clips(const ShownScene& other) const {
  return scene.clips == other.scene.clips && scene.spheres.attributes().clips == other.scene.spheres.attributes().clips;
}

void ShownScene::take_look_of(ShownScene&& other) {
  SphereSet spheres = std::move(scene.spheres);
  spheres.attributes() = std::move(other.scene.spheres.attributes());
  scene = std::move(other.scene);
  scene.spheres = std::move(spheres);
  rig = std::move(other.rig);
  has_lights = other.has_lights;
  states_fog = other.states_fog;
}

void ShownScene::look_by(const ViewerSettings& settings) {
  const Camera& camera = settings.camera;
  scene.camera = camera;
  // A camera that has turned away from the selected spheres focuses as if none were selected.
  if (scene.camera.aperture > 0 && !settings.focus_on.empty()) {
    const Result<double> distance = focus_on(scene.spheres, camera, settings.focus_on);
    scene.camera.focus = distance ? *distance : 0;
  }
  if (!has_lights) scene.lights = lights_around(rig, camera);
}

}  // namespace bihive
