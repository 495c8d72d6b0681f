#include "bihive/scene/scene.h"

#include <algorithm>

#include "bihive/scene/clips.h"
#include "bihive/scene/image_colours.h"

namespace bihive {

std::vector<PointLight> local_lights(const Scene& scene) {
  std::vector<PointLight> lights = scene.lights;
  for (PointLight& light : lights) light.position = scene.spheres.to_local(light.position);
  return lights;
}

Status check_sticks(const Scene& scene) {
  if (scene.sticks.empty()) return Done{};
  const auto refused = [](const std::string& what) {
    return Error{"sticks cannot be drawn beside " + what, "", 0, 0, "leave one of them out"};
  };
  if (lets_light_through(scene)) return refused("transparent spheres");
  return Done{};
}

bool has_soft_light(const Scene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const PointLight& light) { return light.radius > 0; });
}

bool has_own_lines(const Scene& scene) {
  const SphereAttributes& attributes = scene.spheres.attributes();
  return !attributes.crease.empty() ||
         std::any_of(attributes.outline_px.begin(), attributes.outline_px.end(), [](float width) { return width > 0; });
}

bool has_effects(const Scene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& material) { return has_effects(material); }) ||
         (scene.plane && has_effects(scene.plane->material));
}

bool lets_light_through(const Scene& scene) {
  const std::vector<float>& opacity = scene.spheres.attributes().opacity;
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& material) { return material.transmissive > 0; }) ||
         std::any_of(opacity.begin(), opacity.end(), [](float share) { return share < 1; });
}

Material material_of(const Scene& scene, std::int64_t sphere_id) {
  const auto i = static_cast<std::size_t>(scene.spheres.stored_id(sphere_id));
  Material material =
      scene.materials[scene.material_of_sphere.empty() ? 0 : static_cast<std::size_t>(scene.material_of_sphere[i])];
  const SphereAttributes& attributes = scene.spheres.attributes();
  if (!attributes.colour.empty()) material.colour = to_double(attributes.colour[i]);
  if (!attributes.colour.empty() && sphere_id >= scene.spheres.size())
    material.colour = to_double(ImageColours(scene).colour(sphere_id));

  // The complement of the opacity is transmitted straight.
  if (!attributes.opacity.empty() && attributes.opacity[i] < 1) {
    const double opacity = double(attributes.opacity[i]);
    material.ambient *= opacity;
    material.diffuse *= opacity;
    material.specular *= opacity;
    material.glow *= opacity;
    material.transmissive = 1 - opacity;
    material.refraction_index = 1;
  }
  return material;
}

}  // namespace bihive
