#include "bench_scene.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "bihive/job/failure.h"
#include "bihive/scene/framing.h"
#include "synthetic.h"

namespace bihive::bench {
namespace {

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
  return value_or_fail(SphereSet::from_world(x, y, z, r));
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
  if (std::optional<Scene> scene = synthetic_scene(name)) {
    bench.scene = std::move(*scene);
    bench.description = name;
    bench.random_lo = {-kCubeHalf, -kCubeHalf, -kCubeHalf};
    bench.random_hi = {kCubeHalf, kCubeHalf, kCubeHalf};
    return bench;
  }

  // A molecule, or any input of bihive.
  InputOptions wanted = options.input;
  const bool molecule = name == "mol" || name == "mol5";
  if (molecule) wanted.input = options.molecule.empty() ? "demo" : options.molecule;
  Input input = load_input(wanted);
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
  bench.random_lo = scene.spheres.to_local(bounds.lo);
  bench.random_hi = scene.spheres.to_local(bounds.hi);
  return bench;
}

}  // namespace bihive::bench
