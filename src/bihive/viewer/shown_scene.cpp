#include "bihive/viewer/shown_scene.h"

#include <utility>

#include "bihive/render/tree_picture.h"
#include "bihive/scene/clips.h"

namespace bihive {

SceneFacts facts_of(const LoadedScene& loaded) {
  return {loaded.scene.name, loaded.format, loaded.scene.spheres.size(), loaded.frames, loaded.rules, loaded.warnings};
}

ShownScene::ShownScene(LoadedScene loaded)
    : scene(std::move(loaded.scene)),
      has_camera(loaded.has_camera),
      has_lights(loaded.has_lights),
      rig(std::move(loaded.rig)),
      own_camera(scene.camera) {
  // A lens needs more samples than a picture that turns.
  scene.camera.aperture = own_camera.aperture = 0;
  const SphereSet::Bounds bounds = scene.spheres.bounds();
  diagonal = length(bounds.hi - bounds.lo);
}

Camera ShownScene::framed(ViewFrom side, Projection projection, View view, PictureSizePx size) const {
  const Lens lens{own_camera.fov_deg, projection};
  return view == View::tree
             ? frame_tree(scene.spheres, side_of(side), lens, size.width, size.height)
             : frame_spheres(RemainingSpheres(scene).set(), side_of(side), lens, size.width, size.height);
}

bool ShownScene::same_spheres(const ShownScene& other) const {
  const SphereSet &a = scene.spheres, &b = other.scene.spheres;
  return a.scale_exponent() == b.scale_exponent() && a.x() == b.x() && a.y() == b.y() && a.z() == b.z() &&
         a.r() == b.r() && scene.clips == other.scene.clips && a.attributes().clips == b.attributes().clips;
}

void ShownScene::take_look_of(ShownScene&& other) {
  SphereSet spheres = std::move(scene.spheres);
  spheres.attributes() = std::move(other.scene.spheres.attributes());
  scene = std::move(other.scene);
  scene.spheres = std::move(spheres);
  rig = std::move(other.rig);
}

void ShownScene::look_by(const Camera& camera) {
  scene.camera = camera;
  if (!has_lights) scene.lights = lights_around(rig, camera);
}

}  // namespace bihive
