// The graphics processor's pictures against the CPU's.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "bihive/bih/reference_builder.h"
#include "bihive/io/bundled.h"
#include "bihive/io/read_spheres.h"
#include "bihive/render/renderer.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/named_materials.h"
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
  scene.camera = frame_spheres(scene.spheres, ViewFrom::front, 30, 480, 300);
  scene.lights = {light_behind(scene.camera)};
  return scene;
}

Scene scene_of(const std::string& name) {
  if (name == "molecule") return molecule_scene();
  if (name == "four_spheres") return four_spheres_scene();
  return scenario_scene(static_cast<Scenario>(name.back() - '0'), {}).value();
}

RenderSettings settings_of(const Scene& scene, int width_px = 480, int height_px = 300) {
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = width_px;
  settings.height_px = height_px;
  settings.samples_per_pixel = 1;
  return settings;
}

enum class Structure { tree, brute };

// Both pictures, and their comparison.
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

TEST_P(Scenes, orthographic) {
  Scene scene = scene_of(GetParam());
  scene.camera = with_projection(scene.camera, Projection::orthographic);
  RenderSettings settings = settings_of(scene, 240, 150);
  settings.recursion = 1;
  expect_agreement(compare(scene, settings), kAtDepth1);
  settings.view = View::distance;
  expect_agreement(compare(scene, settings), kAtDepth1);
}

TEST(Agreement, materials_and_ambient_light) {
  for (const auto& [name, material] : named_materials()) {
    SCOPED_TRACE(name);
    Scene scene = molecule_scene();
    scene.materials = {material};
    scene.ambient_light = {0.5, 0.7, 1.5};
    RenderSettings settings = settings_of(scene, 240, 150);
    settings.recursion = 1;
    // The borders of bands are edges of their own.
    const Agreement agreement = compare(scene, settings);
    if (material.bands == 0) expect_agreement(agreement, kAtDepth1);
    EXPECT_LE(agreement.share(), kAtDepth5) << agreement.text();
  }
}

// Red and transparent spheres in turn, seen from the front, with a light.
Scene scene_around(SphereSet spheres) {
  Scene scene;
  scene.materials = {red_material(), transparent_material()};
  for (std::int64_t id = 0; id < spheres.size(); ++id) scene.material_of_sphere.push_back(static_cast<int>(id % 2));
  scene.spheres = std::move(spheres);
  scene.camera = frame_spheres(scene.spheres, ViewFrom::front, 30, 240, 150);
  scene.lights = {light_behind(scene.camera)};
  return scene;
}

TEST(Agreement, hostile_sets) {
  for (const test::World& world : test::hostile_worlds(512, 200)) {
    SCOPED_TRACE(world.name);
    std::printf("%s: ", world.name.c_str());
    const Scene scene = scene_around(test::sphere_set(world));
    RenderSettings settings = settings_of(scene, 240, 150);
    settings.recursion = 3;
    expect_agreement(compare(scene, settings), kAtDepth5);
    settings.recursion = 1;
    expect_agreement(compare(scene, settings), kAtDepth1);
  }
}

TEST(Agreement, brute_force) {
  const Scene scene = scenario_scene(Scenario::mixed, {200, 2, 1}).value();
  RenderSettings settings = settings_of(scene, 240, 150);
  settings.shadows = true;
  expect_agreement(compare(scene, settings, Structure::brute), kAtDepth5);
  settings.view = View::id;
  expect_agreement(compare(scene, settings, Structure::brute), kAtDepth1);
}

TEST(Agreement, leaves_of_every_size) {
  const Scene scene = scenario_scene(Scenario::corners, {300, 1, 1}).value();
  const RenderSettings settings = settings_of(scene, 240, 150);
  for (const BuildParameters parameters : {BuildParameters{1, kUnlimited}, BuildParameters{300, 1}}) {
    const Tree tree = build_reference_tree(scene.spheres, parameters);
    const Tracer tracer(scene.spheres, std::make_shared<const Tree>(tree));
    const Image cpu = image_from_film(render(scene, tracer, settings)->film, View::shaded, Transfer::none);
    const Image gpu =
        image_from_film(GlPictures::get().draw(scene, &tree, settings).film, View::shaded, Transfer::none);
    expect_agreement(test::agreement_of(scene, tracer, settings, cpu, gpu), kAtDepth5);
  }
}

TEST(Agreement, several_samples_and_lights) {
  Scene scene = four_spheres_scene();
  scene.lights.push_back({{-30, 10, 30}, {0.2, 0.5, 1}});
  scene.lights.push_back({{30, 0, 40}, {0.5, 0.2, 0.1}});
  RenderSettings settings = settings_of(scene, 160, 100);
  settings.samples_per_pixel = 5;
  settings.recursion = 8;
  settings.shadows = true;
  expect_agreement(compare(scene, settings), kAtDepth5);
  settings.view = View::distance;
  expect_agreement(compare(scene, settings), kAtDepth1);
}

TEST(Agreement, little_of_everything) {
  RenderSettings settings;
  settings.width_px = 120;
  settings.height_px = 75;
  settings.samples_per_pixel = 1;
  const auto expect = [&](const Scene& scene) {
    for (const View view : {View::shaded, View::traversal, View::normal, View::distance, View::id}) {
      settings.view = view;
      expect_agreement(compare(scene, settings), kAtDepth5);
    }
  };
  // One sphere; one sphere without a light; only a sphere of radius 0; only the plane; nothing.
  const auto spheres = [](double radius) {
    return SphereSet::from_world(std::vector<double>{1}, {2}, {3}, {radius}).value();
  };
  expect(scene_around(spheres(0.5)));
  Scene dark = scene_around(spheres(0.5));
  dark.lights.clear();
  expect(dark);
  expect(scene_around(spheres(0)));
  expect(thesis_scene_without_spheres());
  Scene nothing = thesis_scene_without_spheres();
  nothing.plane.reset();
  expect(nothing);
}

TEST(Agreement, powers_of_highlights) {
  for (const double power : {0.5, 1.0, 3.0, 1000.0}) {
    Scene scene = four_spheres_scene();
    scene.plane.reset();
    for (Material& material : scene.materials) material.power = power, material.specular = 1;
    RenderSettings settings = settings_of(scene, 160, 100);
    settings.recursion = 1;
    expect_agreement(compare(scene, settings), kAtDepth1);
  }
}

}  // namespace
}  // namespace bihive
