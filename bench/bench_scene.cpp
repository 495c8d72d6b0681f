#include "bench_scene.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/generators.h"
#include "failure.h"

namespace bihive::bench {
namespace {

constexpr float kCubeHalf = 20;
constexpr float kCornerSide = 10;
constexpr std::int64_t kScenarioCount = 4096;
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

// A grid in the cube with at least `count` places, filled from the first.
void add_grid(Spheres& spheres, std::int64_t count, float radius) {
  std::int64_t k = 1;
  while (k * k * k < count) ++k;
  const float step = (2 * kCubeHalf - 2 * radius) / static_cast<float>(k - 1);
  const auto place = [&](std::int64_t i) { return radius - kCubeHalf + static_cast<float>(i) * step; };
  for (std::int64_t i = 0; i < count; ++i) spheres.add(place(i % k), place(i / k % k), place(i / (k * k)), radius);
}

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

// Uniform in the cube, of a radius with which they fill a tenth of it.
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

// N of "uN", a power of ten from 1e3 to 1e8; 0 if it is no such name.
std::int64_t uniform_count(const std::string& name) {
  if (name.size() != 4 || name.rfind("u1e", 0) != 0 || name[3] < '3' || name[3] > '8') return 0;
  std::int64_t count = 1;
  for (int i = 0; i < name[3] - '0'; ++i) count *= 10;
  return count;
}

// The synthetic scene of a name; empty if there is none.
Spheres synthetic_spheres(const std::string& name) {
  Spheres spheres;
  SplitMix64 random(kSeed);
  if (name == "s1") add_grid(spheres, kScenarioCount, 1);
  if (name == "s2") add_corners(spheres, kScenarioCount, 1, random);
  if (name == "s3") {
    add_corners(spheres, kScenarioCount / 2, 1, random);
    add_grid(spheres, kScenarioCount / 2, 1);
  }
  if (name == "c1e6") add_corners(spheres, 1000000, 0.05F, random);
  if (const std::int64_t count = uniform_count(name); count > 0) add_uniform(spheres, count, random);
  return spheres;
}

// 5 x 5 x 5 copies of a set, boxes side by side.
SphereSet copies(const SphereSet& one) {
  const SphereSet::Bounds bounds = one.bounds();
  const Vec3d size = bounds.hi - bounds.lo;
  std::vector<double> x, y, z, r;
  for (int copy = 0; copy < 125; ++copy) {
    const Vec3d offset = Vec3d{double(copy % 5), double(copy / 5 % 5), double(copy / 25)} * size;
    for (std::int64_t id = 0; id < one.size(); ++id) {
      const Vec3d centre = one.centre(id) + offset;
      x.push_back(centre.x);
      y.push_back(centre.y);
      z.push_back(centre.z);
      r.push_back(one.radius(id));
    }
  }
  return cli::value_or_fail(SphereSet::from_world(x, y, z, r));
}

}  // namespace

int picture_side_px(std::int64_t rays) {
  const auto blocks = std::lround(std::sqrt(static_cast<double>(rays)) / 8);
  return static_cast<int>(std::max(1L, blocks)) * 8;
}

BenchScene load_bench_scene(const BenchOptions& options) {
  BenchScene bench;
  const std::string& name = options.input.input;

  // A synthetic scene of the benchmark.
  if (const Spheres spheres = synthetic_spheres(name); !spheres.x.empty()) {
    bench.scene = thesis_scene_without_spheres();
    bench.scene.spheres = cli::value_or_fail(SphereSet::from_world(spheres.x, spheres.y, spheres.z, spheres.r));
    bench.scene.name = bench.description = name;
    bench.random_lo = {-kCubeHalf, -kCubeHalf, -kCubeHalf};
    bench.random_hi = {kCubeHalf, kCubeHalf, kCubeHalf};
    return bench;
  }

  // A molecule, or whatever bihive can read.
  cli::InputOptions wanted = options.input;
  const bool molecule = name == "mol" || name == "mol5";
  if (molecule) wanted.input = options.molecule.empty() ? "demo" : options.molecule;
  cli::Input input = cli::load_input(wanted);
  bench.scene = std::move(input.scene);
  bench.description = name;
  if (molecule) bench.description += options.molecule.empty() ? " (PDB entry 1HPV)" : " (" + options.molecule + ")";
  if (name == "mol5") {
    bench.scene.spheres = copies(bench.scene.spheres);
    bench.scene.material_of_sphere.clear();
  }
  const int side = picture_side_px(options.rays);
  Scene& scene = bench.scene;
  if (!input.has_camera) scene.camera = frame_spheres(scene.spheres, ViewFrom::front, scene.camera.fov_deg, side, side);
  if (!input.has_lights || scene.lights.empty()) scene.lights = {light_behind(scene.camera)};
  scene.lights.resize(1);
  const SphereSet::Bounds bounds = scene.spheres.bounds();
  bench.random_lo = bounds.lo;
  bench.random_hi = bounds.hi;
  return bench;
}

}  // namespace bihive::bench
