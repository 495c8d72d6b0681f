// The thesis's scenes.
// ctest: asan-long
#include "bihive/scene/generators.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

SphereSet spheres(Scenario scenario, std::int64_t count, float radius = 1, std::uint64_t seed = 1) {
  return scenario_spheres(scenario, {count, radius, seed}).value();
}

TEST(SplitMix, known_sequence) {
  // The first numbers of the generator for seed 0, from its authors' reference program.
  SplitMix64 random(0);
  EXPECT_EQ(random.next(), 0xE220A8397B1DCDAFu);
  EXPECT_EQ(random.next(), 0x6E789E6AA1B965F4u);
  EXPECT_EQ(random.next(), 0x06C45D188009454Fu);
}

TEST(Grid, fills_the_cube_from_face_to_face) {
  const SphereSet set = spheres(Scenario::grid, 64);
  ASSERT_EQ(set.size(), 64);
  EXPECT_EQ(set.centre(0), (Vec3d{-19, -19, -19}));
  // Three steps of 38 / 3, added one after the other in binary32.
  const float step = 38.0f / 3;
  const float last = ((-19 + step) + step) + step;
  EXPECT_EQ(set.centre(63), (Vec3d{last, last, last}));
  EXPECT_EQ(set.centre(1), (Vec3d{double(-19 + step), -19, -19})) << "x runs fastest";
  EXPECT_EQ(set.radius(17), 1);
}

TEST(Grid, what_is_left_over_starts_again) {
  const SphereSet set = spheres(Scenario::grid, 64 + 20);
  for (std::int64_t i = 64; i < 84; ++i) EXPECT_EQ(set.centre(i), set.centre(i - 64)) << i;
}

TEST(Grid, one_sphere_sits_in_the_first_corner) {
  EXPECT_EQ(spheres(Scenario::grid, 7, 2).centre(3), (Vec3d{-18, -18, -18}));
}

TEST(Corners, lie_wholly_inside_their_small_cubes) {
  const SphereSet set = spheres(Scenario::corners, 1003, 0.5F, 9);
  // 1003 = 8 x 125 + 3: the first three corners have one more.
  std::int64_t id = 0;
  for (int corner = 0; corner < 8; ++corner)
    for (int i = 0; i < 125 + (corner < 3 ? 1 : 0); ++i, ++id)
      for (int axis = 0; axis < 3; ++axis) {
        const double outward = (corner >> axis & 1) != 0 ? 1 : -1;
        const double from_face = 20 - outward * set.centre(id)[axis];
        ASSERT_GE(from_face, 0.5 - 2e-6) << id;
        ASSERT_LE(from_face, 7.5 + 2e-6) << id;
      }
  EXPECT_EQ(id, set.size());
}

TEST(Corners, seeds_differ_and_repeat) {
  EXPECT_EQ(spheres(Scenario::corners, 100, 1, 5).x(), spheres(Scenario::corners, 100, 1, 5).x());
  EXPECT_NE(spheres(Scenario::corners, 100, 1, 5).x(), spheres(Scenario::corners, 100, 1, 6).x());
}

TEST(Mixed, corners_first_then_grid) {
  const SphereSet mixed = spheres(Scenario::mixed, 101);
  const SphereSet corners = spheres(Scenario::corners, 50);
  const SphereSet grid = spheres(Scenario::grid, 51);
  ASSERT_EQ(mixed.size(), 101);
  for (std::int64_t i = 0; i < 50; ++i) EXPECT_EQ(mixed.centre(i), corners.centre(i));
  for (std::int64_t i = 0; i < 51; ++i) EXPECT_EQ(mixed.centre(50 + i), grid.centre(i));
}

TEST(Scenarios, refuse_what_does_not_fit) {
  EXPECT_FALSE(scenario_spheres(Scenario::grid, {0, 1, 1}));
  EXPECT_FALSE(scenario_spheres(Scenario::grid, {8, 20, 1}));
  EXPECT_TRUE(scenario_spheres(Scenario::grid, {8, 19.5F, 1}));
  EXPECT_FALSE(scenario_spheres(Scenario::corners, {8, 4, 1}));
  EXPECT_FALSE(scenario_spheres(Scenario::mixed, {8, 4, 1}));
  EXPECT_FALSE(scenario_spheres(Scenario::mixed, {8, 0, 1}));
  EXPECT_FALSE(scenario_spheres(Scenario::mixed, {8, std::nanf(""), 1}));
  EXPECT_TRUE(scenario_spheres(Scenario::mixed, {8, 4, 1, 10}));
  EXPECT_EQ(scenario_spheres(Scenario::mixed, {8, 4, 1, 7}).error().hint,
            "it must be above 0 and below 3.5 in this scenario");
  for (const float side : {0.0F, 20.5F, std::nanf("")})
    EXPECT_FALSE(scenario_spheres(Scenario::corners, {8, 1, 1, side}));
}

TEST(Scenarios, small_cubes_of_another_side_hold_the_same_clusters) {
  const SphereSet usual = scenario_spheres(Scenario::corners, {64, 1, 1}).value();
  const SphereSet larger = scenario_spheres(Scenario::corners, {64, 1, 1, 14}).value();
  for (std::int64_t id = 0; id < 64; ++id)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(19 - std::abs(larger.centre(id)[axis]), 2 * (19 - std::abs(usual.centre(id)[axis])), 1e-4);
}

TEST(Scenarios, a_radius_beyond_binary32_is_refused) {
  EXPECT_EQ(scenario_radius(0.1), 0.1F);
  for (const double radius : {1e39, -1e39, 1e300, std::numeric_limits<double>::infinity(), std::nan("")}) {
    ScenarioParameters parameters;
    parameters.radius = scenario_radius(radius);
    EXPECT_FALSE(scenario_spheres(Scenario::grid, parameters)) << radius;
  }
}

TEST(Scenarios, come_with_the_scene_of_the_thesis) {
  const Scene scene = scenario_scene(Scenario::mixed, {10, 1, 4}).value();
  EXPECT_EQ(scene.camera.eye, (Vec3d{0, 0, 100}));
  EXPECT_EQ(scene.lights.at(0).position, (Vec3d{0, 40, 0}));
  EXPECT_EQ(scene.plane->plane.point, (Vec3d{0, -20, 0}));
  EXPECT_EQ(scene.background, (Vec3d{0, 0, 0}));
  EXPECT_FALSE(scene.picture.shadows);
  EXPECT_EQ(scene.picture.transfer, Transfer::none);
  EXPECT_EQ(scene.seed, 4u);
  EXPECT_EQ(material_of(scene, 0).reflective, 0.30) << "red first";
  EXPECT_EQ(material_of(scene, 1).transmissive, 0.70) << "then transparent";
}

TEST(Materials, colour_and_opacity_attributes) {
  Scene scene = four_spheres_scene();
  scene.spheres.attributes().colour = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
  scene.spheres.attributes().opacity = {1, 0.25F, 1, 1};
  EXPECT_EQ(material_of(scene, 0).colour, (Vec3d{0, 1, 0}));
  EXPECT_EQ(material_of(scene, 0).transmissive, 0) << "opaque: as the material says";
  EXPECT_EQ(material_of(scene, 1).transmissive, 0.75);
  EXPECT_EQ(material_of(scene, 1).refraction_index, 1);
  EXPECT_EQ(material_of(scene, 1).diffuse, 0.30 * 0.25);
}

}  // namespace
}  // namespace bihive
