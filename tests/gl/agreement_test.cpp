// The graphics processor's pictures against the CPU's.
#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "bihive/bih/reference_builder.h"
#include "bihive/io/bundled.h"
#include "bihive/io/read_spheres.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/palette.h"
#include "support/gl_picture.h"
#include "support/hostile_sets.h"
#include "support/picture_agreement.h"

namespace bihive {
namespace {

using test::Agreement;
using test::GlPictures;

Scene molecule_scene() {
  Scene scene;
  scene.spheres = std::move(read_spheres_from_memory(bundled_molecule(), "1hpv.pdb", {})->spheres);
  colour_spheres(scene.spheres);
  scene.camera = frame_spheres(scene.spheres, ViewFrom::front, 30, 481, 300);
  scene.lights = {light_behind(scene.camera)};
  return scene;
}

Scene scene_of(const std::string& name) {
  if (name == "molecule") return molecule_scene();
  if (name == "four_spheres") return four_spheres_scene();
  return scenario_scene(static_cast<Scenario>(name.back() - '0'), {}).value();
}

RenderSettings settings_of(const Scene& scene, int width_px = 481, int height_px = 300) {
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = width_px;
  settings.height_px = height_px;
  settings.samples_per_pixel = 1;
  return settings;
}

enum class Structure { tree, brute };

// Both pictures, and how they compare.
Agreement compare(const Scene& scene, const RenderSettings& settings, Structure structure = Structure::tree) {
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference).value();
  const Rendered cpu = render(scene, tracer, settings).value();
  const GlRenderer::Picture gpu =
      GlPictures::get().draw(scene, structure == Structure::tree ? tracer.tree() : nullptr, settings);
  const Transfer transfer = scene.picture.transfer;
  EXPECT_EQ(gpu.primary, cpu.rays.primary);
  const double others = double(cpu.rays.shadow + cpu.rays.reflected + cpu.rays.transmitted);
  EXPECT_NEAR(double(gpu.others), others, 0.001 * others);
  return test::agreement_of(scene, tracer, settings, image_from_film(cpu.film, settings.view, transfer),
                            image_from_film(gpu.film, settings.view, transfer));
}

void expect_agreement(const Agreement& agreement, double most) {
  EXPECT_LE(agreement.share(), most) << agreement.text();
  EXPECT_EQ(agreement.off_edge, 0) << agreement.text();
  ::testing::Test::RecordProperty("share", std::to_string(agreement.share()));
  std::printf("%s\n", agreement.text().c_str());
}

constexpr double kAtDepth1 = 0.0005, kAtDepth5 = 0.005;

class Scenes : public ::testing::TestWithParam<std::string> {};

TEST_P(Scenes, recursion_1) {
  const Scene scene = scene_of(GetParam());
  RenderSettings settings = settings_of(scene);
  settings.recursion = 1;
  expect_agreement(compare(scene, settings), kAtDepth1);
}

TEST_P(Scenes, recursion_5) {
  const Scene scene = scene_of(GetParam());
  RenderSettings settings = settings_of(scene);
  settings.recursion = 5;
  expect_agreement(compare(scene, settings), kAtDepth5);
}

TEST_P(Scenes, recursion_5_with_the_other_shadows) {
  const Scene scene = scene_of(GetParam());
  RenderSettings settings = settings_of(scene);
  settings.shadows = !settings.shadows;
  expect_agreement(compare(scene, settings), kAtDepth5);
}

TEST_P(Scenes, views) {
  const Scene scene = scene_of(GetParam());
  for (const View view : {View::recursion, View::traversal, View::normal, View::distance, View::id}) {
    SCOPED_TRACE(static_cast<int>(view));
    RenderSettings settings = settings_of(scene, 240, 150);
    settings.view = view;
    expect_agreement(compare(scene, settings), view == View::recursion ? kAtDepth5 : kAtDepth1);
  }
}

INSTANTIATE_TEST_SUITE_P(all, Scenes,
                         ::testing::Values("scenario1", "scenario2", "scenario3", "four_spheres", "molecule"),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace bihive
