#include "bihive/scene/cavities.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bihive/render/tracer.h"
#include "bihive/scene/looks.h"
#include "bihive/scene/scene.h"

namespace bihive {
namespace {

using ::testing::Each;
using ::testing::HasSubstr;

// Balls of radius 0.5 on the surface of a cube of 3 x 3 x 3 places, with nothing in the middle, and one far away.
Scene hollow_cube() {
  std::vector<double> x, y, z, r;
  const auto add = [&](double px, double py, double pz) {
    x.push_back(px);
    y.push_back(py);
    z.push_back(pz);
    r.push_back(0.5);
  };
  add(9, 0, 0);
  for (int i = -1; i <= 1; ++i)
    for (int j = -1; j <= 1; ++j)
      for (int k = -1; k <= 1; ++k)
        if (i != 0 || j != 0 || k != 0) add(i, j, k);
  Scene scene;
  scene.spheres = SphereSet::from_world(x, y, z, r).value();
  return scene;
}

std::string refusal_of(Scene& scene) {
  const Result<ShownCavities> shown = show_cavities(scene, 0.25);
  return shown.ok() ? "" : shown.error().message;
}

TEST(Cavities, SpheresThatLineNoneAreHidden) {
  Scene scene = hollow_cube();
  const ShownCavities shown = show_cavities(scene, 0.25).value();
  EXPECT_EQ(shown.cavities, 1);
  EXPECT_EQ(shown.undecided_spheres, 0);
  EXPECT_EQ(scene.spheres.size(), 26);  // the one far away lines nothing
  EXPECT_EQ(scene.size_of_input, 27);
  EXPECT_EQ(scene.spheres.radius(0), 0.75);
  const NamedNumbers* const column = scene.spheres.attributes().find_numbers("cavity");
  ASSERT_NE(column, nullptr);
  EXPECT_THAT(column->values, Each(1.0));

  // From outside a ray ends on the inner side of the ball that it crosses.
  const Tracer tracer = Tracer::build(scene, Engine::automatic).value();
  Ray ray;
  ray.origin = {-5, 0, 0};
  ray.direction = {1, 0, 0};
  const Hit hit = tracer.closest_hit(ray);
  EXPECT_EQ(hit.t, 4.75);
  EXPECT_EQ(scene.spheres.centre(hit.sphere_id), (Vec3d{-1, 0, 0}));
  ray.t_min = 5;  // from the middle of the cavity on
  EXPECT_EQ(tracer.closest_hit(ray).t, 5.25);
  ray.origin = {-5, 2, 0};
  EXPECT_FALSE(tracer.closest_hit(ray).found());
}

TEST(Cavities, ThereMayBeNone) {
  Scene scene = hollow_cube();
  EXPECT_EQ(show_cavities(scene, 0).value().cavities, 0);  // balls in contact let everything out
  EXPECT_EQ(scene.cavity_walls, nullptr);
  EXPECT_THAT(scene.spheres.r(), Each(0.0F));
  Scene filled = hollow_cube();
  EXPECT_EQ(show_cavities(filled, 0.75).value().cavities, 0);
  Scene empty;
  EXPECT_EQ(show_cavities(empty, 1).value().cavities, 0);
}

TEST(Cavities, HiddenSpheresDoNotCount) {
  Scene scene = hollow_cube();
  ASSERT_TRUE(apply_looks(scene, {Look{"index 5", {SetShown{false}}}}).ok());
  EXPECT_EQ(show_cavities(scene, 0.25).value().cavities, 0);
}

TEST(Cavities, WhatTheyCannotBeShownWithIsRefused) {
  Scene scene = hollow_cube();
  scene.spheres.attributes().numbers = {{"cavity", std::vector<double>(27, 1.0)}};
  EXPECT_THAT(refusal_of(scene), HasSubstr("column cavity"));
  scene = hollow_cube();
  ASSERT_TRUE(apply_looks(scene, {Look{"all", {AddClip{PlaneClip{{0, 0, 1}, 0}}}}}).ok());
  EXPECT_THAT(refusal_of(scene), HasSubstr("cut spheres"));
  scene = hollow_cube();
  ASSERT_TRUE(scene.spheres.replicate({Vec3d{20, 0, 0}, {0, 20, 0}, {0, 0, 20}}, {2, 1, 1}).ok());
  EXPECT_THAT(refusal_of(scene), HasSubstr("copies"));
}

}  // namespace
}  // namespace bihive
