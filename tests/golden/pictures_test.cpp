// Small pictures of every scene, recursion depth and view, kept pixel by pixel.
#include <gtest/gtest.h>

#include <string>

#include "bihive/io/bundled.h"
#include "bihive/io/read_spheres.h"
#include "bihive/render/renderer.h"
#include "bihive/render/tree_picture.h"
#include "bihive/scene/bonds.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/generators.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/palette.h"
#include "bihive/scene/style.h"
#include "support/golden.h"

namespace bihive {
namespace {

constexpr int kWidth = 96;
constexpr int kHeight = 72;

Image picture_of(const Scene& scene, View view, int recursion, const BuildParameters& parameters, int samples) {
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference, parameters).value();
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = kWidth;
  settings.height_px = kHeight;
  settings.view = view;
  settings.recursion = recursion;
  settings.samples_per_pixel = samples;
  Result<Rendered> rendered = render(scene, tracer, settings);
  return image_from_film(rendered.value().film, view, scene.picture.transfer);
}

Scene scene_of(const std::string& name) {
  if (name == "four-spheres") return four_spheres_scene();
  ScenarioParameters parameters;
  parameters.count = 512;
  return scenario_scene(static_cast<Scenario>(name.back() - '0'), parameters).value();
}

class Scenes : public ::testing::TestWithParam<std::string> {};

TEST_P(Scenes, recursion_depths_1_to_5) {
  const Scene scene = scene_of(GetParam());
  for (int depth = 1; depth <= 5; ++depth)
    testing::expect_golden(GetParam() + "-recursion" + std::to_string(depth),
                           picture_of(scene, View::shaded, depth, {}, 1));
}

TEST_P(Scenes, views) {
  const Scene scene = scene_of(GetParam());
  const std::pair<View, const char*> views[] = {{View::recursion, "recursion"},
                                                {View::traversal, "traversal"},
                                                {View::normal, "normal"},
                                                {View::distance, "distance"},
                                                {View::id, "id"},
                                                {View::tree, "tree"}};
  for (const auto& [view, name] : views)
    testing::expect_golden(GetParam() + "-view-" + name, picture_of(scene, view, 5, {}, 1));
}

INSTANTIATE_TEST_SUITE_P(all, Scenes, ::testing::Values("scenario1", "scenario2", "scenario3", "four-spheres"),
                         [](const auto& scene) {
                           return scene.param == "four-spheres" ? "four_spheres" : scene.param;
                         });

TEST(Traversal, figure_4_3) {
  // Scenario 1 with 64 spheres: one leaf, four leaves, all; and the same trees by the other parameter.
  ScenarioParameters parameters;
  parameters.count = 64;
  const Scene scene = scenario_scene(Scenario::grid, parameters).value();
  const auto draw = [&](std::int64_t max_prims, std::int64_t max_depth) {
    return picture_of(scene, View::traversal, 1, {max_prims, max_depth}, 1);
  };
  testing::expect_golden("figure-4-3a", draw(1, 1));
  testing::expect_golden("figure-4-3b", draw(1, 3));
  testing::expect_golden("figure-4-3c", draw(1, kUnlimited));
  testing::expect_golden("figure-4-3a", draw(kUnlimited, kUnlimited));
  testing::expect_golden("figure-4-3e", draw(32, kUnlimited));
}

TEST(Tree, drawn_at_a_readable_size) {
  // All kinds of nodes: gaps, overlaps, clip nodes, one-sided nodes; with the parts above each other, and side by side.
  const Scene scene = scenario_scene(Scenario::corners, {256, 1, 1}).value();
  const Tracer tracer = Tracer::build(scene.spheres, Engine::reference).value();
  RenderSettings settings;
  settings.view = View::tree;
  settings.width_px = 240;
  settings.height_px = 360;
  testing::expect_golden("tree-scenario2",
                         image_from_film(render(scene, tracer, settings).value().film, View::tree, Transfer::none));

  Result<SphereFile> file = read_spheres_from_memory(bundled_molecule(), "1hpv.pdb", {});
  Scene molecule;
  molecule.spheres = std::move(file.value().spheres);
  molecule.camera = frame_tree(molecule.spheres, ViewFrom::iso, 30, 480, 240);
  const Tracer molecule_tracer = Tracer::build(molecule.spheres, Engine::reference).value();
  settings.width_px = 480;
  settings.height_px = 240;
  testing::expect_golden("tree-molecule", image_from_film(render(molecule, molecule_tracer, settings).value().film,
                                                          View::tree, Transfer::none));
}

TEST(Molecule, bonds) {
  // Ethanol, by the two styles that draw bonds.
  const std::string ethanol =
      "9\n\n"
      "C 1.1879 -0.3829 0\nC 0 0.5526 0\nO -1.1867 -0.2472 0\nH -1.9237 0.3850 0\nH 2.0985 0.2306 0\n"
      "H 1.1184 -1.0093 0.8869\nH 1.1184 -1.0093 -0.8869\nH -0.0227 1.1812 0.8852\nH -0.0227 1.1812 -0.8852\n";
  for (const std::string name : {"ball-and-stick", "licorice"}) {
    const Style style = style_named(name).value();
    Scene scene = load_scene(ethanol, "ethanol.xyz", {}, LooksOfFile::apply, &style).value().scene;
    ASSERT_TRUE(scale_balls(scene, scene.picture.sticks));
    ASSERT_TRUE(find_bonds(scene, scene.picture.sticks));
    EXPECT_EQ(scene.sticks.size(), 8);
    scene.camera = frame_spheres(scene.spheres, ViewFrom::iso, 30, kWidth, kHeight);
    scene.lights = lights_around(style.lights, scene.camera);
    const Tracer tracer = Tracer::build(scene, Engine::wide).value();
    RenderSettings settings = settings_from(scene.picture);
    settings.width_px = kWidth;
    settings.height_px = kHeight;
    testing::expect_golden("ethanol-" + name, image_from_film(render(scene, tracer, settings).value().film,
                                                              View::shaded, scene.picture.transfer));
  }
}

TEST(Molecule, bundled) {
  Result<SphereFile> file = read_spheres_from_memory(bundled_molecule(), "1hpv.pdb", {});
  Scene scene;
  scene.spheres = std::move(file.value().spheres);
  colour_spheres(scene.spheres);
  scene.camera = frame_spheres(scene.spheres, ViewFrom::front, 30, kWidth, kHeight);
  scene.lights = {light_behind(scene.camera)};
  testing::expect_golden("molecule", picture_of(scene, View::shaded, 5, {}, 4));
}

}  // namespace
}  // namespace bihive
