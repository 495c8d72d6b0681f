#include "synthetic.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/scene/generators.h"

namespace bihive::bench {
namespace {

constexpr float kCornerSide = 10;
constexpr std::uint64_t kSeed = 1;

struct Spheres {
  std::vector<float> x, y, z, r;

  void add(float px, float py, float pz, float radius) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
    r.push_back(radius);
  }
};

// Uniform in a small cube at each corner of the large one.
void add_corners(Spheres& spheres, std::int64_t count, float radius, SplitMix64& random) {
  const float room = kCornerSide - 2 * radius;
  for (std::int64_t i = 0; i < count; ++i) {
    float position[3];
    for (int axis = 0; axis < 3; ++axis) {
      const float offset = radius + random.next_float() * room;
      position[axis] = (i % 8 >> axis & 1) != 0 ? kCubeHalf - offset : offset - kCubeHalf;
    }
    spheres.add(position[0], position[1], position[2], radius);
  }
}

// Uniform in the cube. The radius makes them fill a tenth of it.
void add_uniform(Spheres& spheres, std::int64_t count, SplitMix64& random) {
  const double cube = std::pow(2.0 * double(kCubeHalf), 3);
  const double ball = 4.0 / 3.0 * 3.14159265358979;
  const auto radius = static_cast<float>(std::cbrt(0.1 * cube / (static_cast<double>(count) * ball)));
  const auto place = [&] { return (2 * random.next_float() - 1) * kCubeHalf; };
  for (std::int64_t i = 0; i < count; ++i) {
    const float x = place(), y = place(), z = place();
    spheres.add(x, y, z, radius);
  }
}

// N of "uN", a power of ten from 1e3 to 1e8; 0 for any other name.
std::int64_t uniform_count(const std::string& name) {
  if (name.size() != 4 || name.rfind("u1e", 0) != 0 || name[3] < '3' || name[3] > '8') return 0;
  std::int64_t count = 1;
  for (int i = 0; i < name[3] - '0'; ++i) count *= 10;
  return count;
}

// The spheres of a name; nothing for an unknown name.
std::optional<SphereSet> spheres_of(const std::string& name) {
  for (const Scenario scenario : {Scenario::grid, Scenario::corners, Scenario::mixed})
    if (name == "s" + std::to_string(static_cast<int>(scenario))) return scenario_spheres(scenario, {}).value();
  Spheres spheres;
  SplitMix64 random(kSeed);
  if (name == "c1e6") add_corners(spheres, 1000000, 0.05F, random);
  if (const std::int64_t count = uniform_count(name); count > 0) add_uniform(spheres, count, random);
  if (spheres.x.empty()) return std::nullopt;
  return SphereSet::from_world(spheres.x, spheres.y, spheres.z, spheres.r).value();
}

}  // namespace

std::optional<Scene> synthetic_scene(const std::string& name) {
  std::optional<SphereSet> spheres = spheres_of(name);
  if (!spheres) return std::nullopt;
  Scene scene = thesis_scene_without_spheres();
  scene.spheres = std::move(*spheres);
  scene.materials = {red_material()};
  scene.name = name;
  return scene;
}

}  // namespace bihive::bench
