#include "bihive/scene/generators.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bihive/base/readable.h"
#include "bihive/math/rng.h"

namespace bihive {
namespace {

// The cube that encloses everything.
constexpr float kCubeLow = -20;
constexpr float kCubeHigh = 20;
constexpr float kCubeSide = 40;

// Centres, in the order in which they are made.
struct Centres {
  std::vector<float> x, y, z;

  void add(float px, float py, float pz) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
  }
};

// The largest k with k^3 <= count.
std::int64_t cube_root(std::int64_t count) {
  std::int64_t k = 1;
  while ((k + 1) * (k + 1) * (k + 1) <= count) ++k;
  return k;
}

// A k x k x k grid with k^3 <= count; the remaining spheres start again at the first position.
void add_grid(Centres& centres, std::int64_t count, float radius) {
  if (count == 0) return;
  // Steps by repeated addition: the rounding of the sums decides ties of the tree builder.
  const std::int64_t k = cube_root(count);
  const float step = k > 1 ? (kCubeSide - 2 * radius) / static_cast<float>(k - 1) : 0;
  std::vector<float> place(static_cast<std::size_t>(k));
  place[0] = kCubeLow + radius;
  for (std::size_t i = 1; i < place.size(); ++i) place[i] = place[i - 1] + step;

  const auto at = [&](std::int64_t i) { return place[static_cast<std::size_t>(i)]; };
  for (std::int64_t j = 0; j < count; ++j) centres.add(at(j % k), at((j / k) % k), at((j / (k * k)) % k));
}

// Uniform in a small cube at each corner, corner by corner; x is the lowest bit of a corner's number.
void add_corners(Centres& centres, std::int64_t count, float radius, float side, SplitMix64& random) {
  const float room = side - 2 * radius;
  for (int corner = 0; corner < 8; ++corner) {
    const std::int64_t here = count / 8 + (corner < count % 8 ? 1 : 0);
    for (std::int64_t i = 0; i < here; ++i) {
      float position[3];
      for (int axis = 0; axis < 3; ++axis) {
        const float offset = radius + random.next_float() * room;
        position[axis] = (corner >> axis & 1) != 0 ? kCubeHigh - offset : kCubeLow + offset;
      }
      centres.add(position[0], position[1], position[2]);
    }
  }
}

Error out_of_range(const std::string& what, const std::string& expected) {
  return {what + " is out of range", "", 0, 0, "it must be " + expected};
}

// Red and transparent in turn. The text does not say which sphere has which material; so both are visible everywhere.
void alternate_materials(Scene& scene) {
  scene.material_of_sphere.resize(static_cast<std::size_t>(scene.spheres.size()));
  for (std::size_t i = 0; i < scene.material_of_sphere.size(); ++i)
    scene.material_of_sphere[i] = static_cast<std::int32_t>(i % 2);
}

}  // namespace

float scenario_radius(double radius) {
  const bool fits = std::abs(radius) <= double(std::numeric_limits<float>::max());
  return fits ? static_cast<float>(radius) : std::numeric_limits<float>::infinity();
}

Result<SphereSet> scenario_spheres(Scenario scenario, const ScenarioParameters& parameters) {
  // Check the ranges: spheres must fit the cubes in which they are placed.
  const bool corners = scenario != Scenario::grid;
  const float largest = corners ? parameters.corner_side / 2 : kCubeSide / 2;
  if (!(parameters.corner_side > 0 && parameters.corner_side <= kCubeSide / 2))
    return out_of_range("the side of the small cubes", "above 0 and at most 20");
  if (parameters.count < 1) return out_of_range("the number of spheres", "at least 1");
  if (!(parameters.radius > 0 && parameters.radius < largest))
    return out_of_range("the radius", "above 0 and below " + readable_number(largest) + " in this scenario");

  Centres centres;
  SplitMix64 random(parameters.seed);
  const std::int64_t n = parameters.count;
  const std::int64_t corner_count = scenario == Scenario::grid ? 0 : scenario == Scenario::corners ? n : n / 2;
  add_corners(centres, corner_count, parameters.radius, parameters.corner_side, random);
  add_grid(centres, n - corner_count, parameters.radius);
  const std::vector<float> radii(static_cast<std::size_t>(n), parameters.radius);
  return SphereSet::from_world(centres.x, centres.y, centres.z, radii);
}

ScenePlane thesis_plane() {
  // Matte, so that the plane shows nothing but its own shading. Checker and grey values are chosen, not stated.
  Material matte;
  matte.colour = {0.8, 0.8, 0.8};
  matte.ambient = 0.3;
  matte.diffuse = 0.5;
  return {{{0, -20, 0}, {0, 1, 0}}, matte, Checker{5, {0.6, 0.6, 0.6}, 500}};
}

Scene thesis_scene_without_spheres() {
  Scene scene;
  scene.materials = {red_material(), transparent_material()};
  scene.lights = {{{0, 40, 0}, {1, 1, 1}}};
  scene.plane = thesis_plane();
  scene.camera = {{0, 0, 100}, {0, 0, 0}, {0, 1, 0}, 30};
  scene.background = {0, 0, 0};
  scene.picture.samples_per_pixel = 1;
  scene.picture.shadows = false;
  scene.picture.transfer = Transfer::none;
  return scene;
}

Result<Scene> scenario_scene(Scenario scenario, const ScenarioParameters& parameters) {
  Result<SphereSet> spheres = scenario_spheres(scenario, parameters);
  if (!spheres) return spheres.error();
  Scene scene = thesis_scene_without_spheres();
  scene.spheres = std::move(*spheres);
  alternate_materials(scene);
  scene.name = "scenario" + std::to_string(static_cast<int>(scenario));
  if (scenario != Scenario::grid) scene.seed = parameters.seed;
  return scene;
}

Scene four_spheres_scene() {
  Scene scene = thesis_scene_without_spheres();
  // Large spheres close together, as large as the cube allows. Reflections of reflections reach depth 5 where the red
  // spheres face each other, and the transparent one in front shows them once more.
  const std::vector<float> x{-10.5F, 10.5F, 0, 1.5F};
  const std::vector<float> y{-10, -10, 8.5F, -6};
  const std::vector<float> z{-5, -5, -7, 11.5F};
  const std::vector<float> r{9.5F, 9.5F, 10, 8};
  Result<SphereSet> spheres = SphereSet::from_world(x, y, z, r);
  scene.spheres = std::move(spheres.value());
  scene.material_of_sphere = {0, 0, 0, 1};
  scene.name = "four-spheres";
  return scene;
}

}  // namespace bihive
