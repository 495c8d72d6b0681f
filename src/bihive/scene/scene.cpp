#include "bihive/scene/scene.h"

#include <algorithm>
#include <string>

#include "bihive/scene/clips.h"
#include "bihive/scene/image_colours.h"

namespace bihive {

std::vector<PointLight> local_lights(const Scene& scene) {
  std::vector<PointLight> lights = scene.lights;
  for (PointLight& light : lights) light.position = scene.spheres.to_local(light.position);
  return lights;
}

Status check_sticks(const Scene& scene) {
  if (scene.sticks.empty() || !lets_light_through(scene)) return Done{};
  for (std::int64_t stick = 0; stick < scene.sticks.size(); ++stick) {
    const std::int64_t one = scene.sticks.sphere_at(scene.spheres, 2 * stick);
    const std::int64_t other = scene.sticks.sphere_at(scene.spheres, 2 * stick + 1);
    if (one != other && !are_equally_clear(scene, one, other))
      return Error{"a stick has one opacity, and that between the spheres " + std::to_string(input_id(scene, one)) +
                       " and " + std::to_string(input_id(scene, other)) + " would have two",
                   "", 0, 0, "give them the same, or make the stick of two parts"};
  }
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
  if (scene.sticks.has_opacities()) return true;
  return std::any_of(scene.materials.begin(), scene.materials.end(),
                     [](const Material& material) { return material.transmissive > 0; }) ||
         std::any_of(opacity.begin(), opacity.end(), [](float share) { return share < 1; });
}

bool are_equally_clear(const Scene& scene, std::int64_t one, std::int64_t other) {
  const Material a = material_of(scene, one), b = material_of(scene, other);
  return a.transmissive == b.transmissive && (a.transmissive == 0 || a.refraction_index == b.refraction_index);
}

namespace {

// `factor`: of the sphere's own opacity.
Material material_with(const Scene& scene, std::int64_t sphere_id, double factor) {
  const auto i = static_cast<std::size_t>(scene.spheres.stored_id(sphere_id));
  Material material =
      scene.materials[scene.material_of_sphere.empty() ? 0 : static_cast<std::size_t>(scene.material_of_sphere[i])];
  const SphereAttributes& attributes = scene.spheres.attributes();
  if (!attributes.colour.empty()) material.colour = to_double(attributes.colour[i]);
  if (!attributes.colour.empty() && sphere_id >= scene.spheres.size())
    material.colour = to_double(ImageColours(scene).colour(sphere_id));

  // The complement of the opacity is transmitted straight.
  const double opacity = factor * (attributes.opacity.empty() ? 1 : double(attributes.opacity[i]));
  if (opacity < 1) {
    material.ambient *= opacity;
    material.diffuse *= opacity;
    material.specular *= opacity;
    material.glow *= opacity;
    material.transmissive = 1 - opacity;
    material.refraction_index = 1;
  }
  return material;
}

}  // namespace

Material material_of(const Scene& scene, std::int64_t sphere_id) {
  return material_with(scene, sphere_id, 1);
}

Material shown_material(const Scene& scene, std::int64_t id) {
  const std::int64_t half = id - scene.spheres.total_size();
  if (half < 0) return material_of(scene, id);
  Material material = material_with(scene, shown_sphere(scene, id), scene.sticks.opacity_at(half));
  if (const Vec3f* const own = scene.sticks.colour_at(half)) material.colour = to_double(*own);
  return material;
}

}  // namespace bihive
