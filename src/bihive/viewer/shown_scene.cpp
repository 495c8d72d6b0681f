#include "bihive/viewer/shown_scene.h"

#include <utility>

#include "bihive/render/tree_picture.h"

namespace bihive {

SceneFacts facts_of(const LoadedScene& loaded) {
  return {loaded.scene.name, loaded.format, loaded.scene.spheres.size(), loaded.frames, loaded.rules, loaded.warnings};
}

ShownScene::ShownScene(Scene shown, SceneFacts said, bool with_camera, bool with_lights)
    : scene(std::move(shown)),
      facts(std::move(said)),
      has_camera(with_camera),
      has_lights(with_lights),
      own_camera(scene.camera) {
  // A lens needs more samples than a picture that turns.
  scene.camera.aperture = own_camera.aperture = 0;
  const SphereSet::Bounds bounds = scene.spheres.bounds();
  diagonal = length(bounds.hi - bounds.lo);
}

Camera ShownScene::framed(ViewFrom side, View view, PictureSizePx size) const {
  const Lens lens{own_camera.fov_deg, own_camera.projection};
  return view == View::tree ? frame_tree(scene.spheres, side_of(side), lens, size.width, size.height)
                            : frame_spheres(scene.spheres, side_of(side), lens, size.width, size.height);
}

void ShownScene::look_by(const Camera& camera) {
  scene.camera = camera;
  if (!has_lights) scene.lights = {light_behind(camera)};
}

}  // namespace bihive
