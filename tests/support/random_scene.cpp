#include "support/random_scene.h"

#include <cmath>
#include <string>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/scene/generators.h"
#include "support/clips.h"

namespace bihive::test {
namespace {

// Some lights with a radius, some materials with effects, and another ambient light.
void add_look(std::uint64_t seed, Scene& scene) {
  SplitMix64 rng(seed + 1000);
  for (PointLight& light : scene.lights)
    if (rng.next() % 3 != 0) light.radius = 8 * rng.next_double();
  for (Material& material : scene.materials) {
    if (rng.next() % 2 == 0) material.tint = rng.next_double();
    if (rng.next() % 2 == 0) material.bands = static_cast<int>(rng.next() % 5);
    if (rng.next() % 2 == 0) material.glow = rng.next_double();
  }
  scene.ambient_light = {rng.next_double(), rng.next_double(), 2 * rng.next_double()};
}

}  // namespace

Scene random_scene(std::uint64_t seed) {
  SplitMix64 rng(seed);
  const auto between = [&](double lo, double hi) { return lo + (hi - lo) * rng.next_double(); };
  const auto chance = [&](double share) { return rng.next_double() < share; };
  const auto vector = [&](double size) {
    const double x = between(-size, size), y = between(-size, size), z = between(-size, size);
    return Vec3d{x, y, z};
  };
  Scene scene;
  scene.name = "seed " + std::to_string(seed);
  const int count = chance(0.1) ? 0 : 1 + static_cast<int>(between(0, 60));
  std::vector<double> x, y, z, r;
  for (int i = 0; i < count; ++i) {
    const Vec3d centre = vector(10);
    x.push_back(centre.x);
    y.push_back(centre.y);
    z.push_back(centre.z);
    r.push_back(chance(0.05) ? 0 : between(0.3, 4));
  }
  scene.spheres = SphereSet::from_world(x, y, z, r).value();

  scene.materials.clear();
  for (int i = 0; i < 1 + static_cast<int>(between(0, 6)); ++i) {
    Material material;
    material.colour = {between(0, 1), between(0, 1), between(0, 1)};
    material.ambient = between(0, 0.4);
    material.diffuse = between(0, 0.8);
    material.reflective = chance(0.5) ? between(0, 0.6) : 0;
    material.specular = chance(0.6) ? between(0, 1) : 0;
    material.power = chance(0.1) ? between(1e6, 1e9) : between(0.3, 100);
    if (chance(0.5)) material.power = std::ceil(material.power);
    material.transmissive = chance(0.5) ? between(0, 0.9) : 0;
    material.refraction_index = material.transmissive == 0 && chance(0.5) ? 0 : between(0.5, 2);
    scene.materials.push_back(material);
  }
  if (chance(0.8))
    for (int i = 0; i < count; ++i)
      scene.material_of_sphere.push_back(static_cast<std::int32_t>(rng.next() % scene.materials.size()));
  for (int i = 0; i < count && seed % 3 == 0; ++i) {
    const auto share = [&] { return static_cast<float>(between(0, 1)); };
    scene.spheres.attributes().colour.push_back({share(), share(), share()});
    scene.spheres.attributes().opacity.push_back(chance(0.3) ? 1 : share());
  }

  const int lights = static_cast<int>(between(0, 4));
  for (int i = 0; i < lights; ++i) scene.lights.push_back({vector(30), {between(0, 1), between(0, 1), between(0, 1)}});
  if (seed % 2 == 0) add_look(seed, scene);
  // Some materials let light straight through.
  for (std::size_t i = 0; i < scene.materials.size(); i += 2)
    if (scene.materials[i].transmissive > 0 && seed % 5 < 3) scene.materials[i].refraction_index = 1;
  if (chance(0.7)) {
    scene.plane = thesis_plane();
    scene.plane->plane.point = {0, -6, 0};
    if (chance(0.5)) scene.plane->plane.normal = normalized(vector(1));
    if (chance(0.3)) scene.plane->checker.reset();
    if (chance(0.5)) scene.plane->material.reflective = 0.2;
    if (chance(0.3)) scene.plane->material.transmissive = 0.3;
    if (chance(0.5)) scene.plane->material.specular = 0.4;
  }
  scene.background = {between(0, 1), between(0, 1), between(0, 1)};
  scene.camera.eye = chance(0.2) ? vector(5) : Vec3d{0, 0, 30};
  scene.camera.fov_deg = between(20, 100);
  if (seed % 4 == 1) scene.camera = with_projection(scene.camera, Projection::orthographic);
  if (seed % 4 == 3) scene.camera.aperture = 0.1 * static_cast<double>(seed % 11);
  if (seed % 8 == 3) scene.camera.focus = 20;
  if (seed % 5 == 2 || seed % 7 == 1) add_random_clips(seed, 10, scene);
  return scene;
}

RenderSettings random_settings(std::uint64_t seed) {
  RenderSettings settings;
  settings.width_px = 3 + static_cast<int>(seed * 7 % 31);
  settings.height_px = 1 + static_cast<int>(seed * 11 % 29);
  settings.samples_per_pixel = 1 + static_cast<int>(seed % 5);
  settings.recursion = 1 + static_cast<int>(seed % 7);
  settings.shadows = seed % 4 != 0;
  settings.light_points = 1 + static_cast<int>(seed % 4);
  if (seed % 3 != 1) settings.opacity_rule = seed % 2 == 0 ? OpacityRule::once : OpacityRule::first;
  if (seed % 5 == 0) settings.outline = Outline{1 + 0.5 * static_cast<double>(seed % 3), 0.3, {0.2, 0, 0.1}};
  if (seed % 10 == 5) settings.line_unit = LineUnit::picture;
  if (seed % 5 < 2) settings.fog = Fog{0.1, 0.8, 0.7};
  if (seed % 7 < 4) settings.tone = {0.3 * static_cast<double>(seed % 6) - 0.5, static_cast<ToneCurve>(seed % 3)};
  if (seed % 3 == 0) settings.ambient_occlusion = {seed % 2 == 0 ? 3.0 : AmbientOcclusion{}.distance, 5};
  // More than kFewestDirections, so that faint surfaces ask fewer.
  if (seed % 12 == 0) settings.ambient_occlusion->directions = 20;
  if (seed % 12 == 2) settings.light_points = 17;
  return settings;
}

}  // namespace bihive::test
