#include "bihive/scene/style.h"

namespace bihive {

void apply_style(const Style& style, Scene& scene) {
  scene.materials = {style.material};
  scene.material_of_sphere.clear();
  scene.background = style.background;
  scene.ambient_light = style.lights.ambient_light;
  PictureSettings picture = style.picture;
  picture.width_px = scene.picture.width_px;
  picture.height_px = scene.picture.height_px;
  picture.transfer = scene.picture.transfer;
  scene.picture = picture;
}

}  // namespace bihive
