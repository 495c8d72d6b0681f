#include "bihive/scene/trails.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

namespace bihive {
namespace {

using ::testing::HasSubstr;
using Earlier = std::vector<std::shared_ptr<const SphereSet>>;

// Spheres along x.
SphereSet row_of(const std::vector<double>& x, double radius = 0.5) {
  const std::vector<double> zeros(x.size(), 0), radii(x.size(), radius);
  return SphereSet::from_world(x, zeros, zeros, radii).value();
}

Earlier frames_of(const std::vector<std::vector<double>>& frames) {
  Earlier earlier;
  for (const std::vector<double>& x : frames) earlier.push_back(std::make_shared<const SphereSet>(row_of(x)));
  return earlier;
}

Trails of_frames(int frames) {
  Trails trails;
  trails.frames = frames;
  return trails;
}

// In world units.
Stick step_of(const Scene& scene, std::int64_t k) {
  const Stick stored = scene.sticks.stored(scene.spheres, k);
  const double world = scene.spheres.inverse_scale();
  return {world * stored.a, world * stored.b, world * stored.radius_a, world * stored.radius_b};
}

TEST(Trails, go_back_step_by_step_and_fade) {
  Scene scene;
  scene.spheres = row_of({3, 10});
  const AddedTrails added = add_trails(scene, frames_of({{-9, 10}, {0, 10}, {1, 10}}), of_frames(2)).value();
  EXPECT_EQ(added.frames, 2);
  EXPECT_EQ(added.trails, 1);  // the other sphere rests
  ASSERT_EQ(added.sticks, 2);
  EXPECT_EQ(step_of(scene, 0), (Stick{{1, 0, 0}, {3, 0, 0}, double(0.1F), double(0.1F)}));
  EXPECT_EQ(step_of(scene, 1), (Stick{{0, 0, 0}, {1, 0, 0}, double(0.1F), double(0.1F)}));
  EXPECT_EQ(scene.sticks.opacity_at(0), 0.75);
  EXPECT_EQ(scene.sticks.opacity_at(2), 0.25);
  EXPECT_EQ(scene.sticks.sphere_at(scene.spheres, 0), 0);
  // That of the sphere counts too.
  const std::int64_t id = scene.spheres.total_size();
  EXPECT_EQ(shown_material(scene, id + 2).transmissive, 0.75);
  scene.spheres.attributes().opacity = {0.5F, 1};
  EXPECT_EQ(shown_material(scene, id + 2).transmissive, 0.875);
  EXPECT_TRUE(lets_light_through(scene));
}

TEST(Trails, of_selected_spheres_and_of_hidden_ones_none) {
  Scene scene;
  scene.spheres = row_of({3, 10, 20});
  Trails trails = of_frames(5);
  trails.select = "index 2";
  trails.radius = 0.25;
  EXPECT_EQ(add_trails(scene, frames_of({{0, 0, 0}}), trails).value().sticks, 1);
  EXPECT_EQ(step_of(scene, 0), (Stick{{0, 0, 0}, {20, 0, 0}, 0.25, 0.25}));
  EXPECT_EQ(scene.sticks.opacity_at(0), double(0.9F));
  // Spheres of the input by their numbers there.
  Scene few;
  few.spheres = row_of({20});
  few.id_in_input = {2};
  few.size_of_input = 3;
  ASSERT_EQ(add_trails(few, frames_of({{0, 0, 7}}), of_frames(1)).value().sticks, 1);
  EXPECT_EQ(step_of(few, 0).a, (Vec3d{7, 0, 0}));

  trails.select = "index";
  const Result<AddedTrails> bad = add_trails(scene, frames_of({{0, 0, 0}}), trails);
  ASSERT_FALSE(bad);
  EXPECT_THAT(bad.error().to_string(), HasSubstr("trail_select"));
}

TEST(Trails, break_where_a_sphere_leaves_the_cell) {
  Scene scene;
  scene.spheres = row_of({1});
  Cell cell;
  cell.vectors = {Vec3d{10, 0, 0}, Vec3d{0, 10, 0}, Vec3d{0, 0, 10}};
  cell.periodic = {true, true, true};
  scene.spheres.cell() = cell;
  const AddedTrails added = add_trails(scene, frames_of({{8}, {9}}), of_frames(2)).value();
  EXPECT_EQ(added.broken, 1);
  ASSERT_EQ(added.sticks, 1);
  EXPECT_EQ(step_of(scene, 0).a, (Vec3d{8, 0, 0}));
  EXPECT_EQ(step_of(scene, 0).b, (Vec3d{9, 0, 0}));
  EXPECT_EQ(scene.sticks.opacity_at(0), 0.25);  // it is the step before the last one
}

TEST(Trails, begin_after_a_frame_of_other_spheres) {
  Scene scene;
  scene.spheres = row_of({3, 10});
  const AddedTrails added = add_trails(scene, frames_of({{0, 9}, {1, 9, 5}, {2, 9}}), of_frames(9)).value();
  EXPECT_TRUE(added.other_count);
  EXPECT_EQ(added.frames, 1);
  EXPECT_EQ(added.sticks, 2);
  EXPECT_EQ(add_trails(scene, {}, of_frames(9)).value().sticks, 0);
}

TEST(Trails, of_points_need_a_radius) {
  Scene scene;
  scene.spheres = row_of({3}, 0);
  const Result<AddedTrails> added = add_trails(scene, frames_of({{0}}), of_frames(1));
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().to_string(), HasSubstr("trail_radius"));
  Trails trails = of_frames(1);
  trails.radius = 0.125;
  EXPECT_EQ(add_trails(scene, frames_of({{0}}), trails).value().sticks, 1);
}

}  // namespace
}  // namespace bihive
