// The style for points by their density, and cameras that leave out a few spheres far away.
#include "bihive/scene/density.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "bihive/render/frame_picture.h"
#include "bihive/scene/central_box.h"
#include "bihive/scene/framed_spheres.h"
#include "bihive/scene/load_scene.h"

namespace bihive {
namespace {

using ::testing::Each;
using ::testing::Eq;
using ::testing::HasSubstr;
using ::testing::Not;

// A cube of side 10 with 11^3 points, and `more` lines.
std::string cube_csv(const std::string& more = "") {
  std::string text = "x,y,z\n";
  for (int i = 0; i < 11 * 11 * 11; ++i)
    text += std::to_string(i % 11) + "," + std::to_string(i / 11 % 11) + "," + std::to_string(i / 121) + "\n";
  return text + more;
}

LoadedScene loaded(const std::string& text, const std::string& style) {
  const Style named = style_named(style).value();
  return load_scene(text, "points.csv", {}, LooksOfFile::apply, &named).value();
}

void expect_same_spheres(const SphereSet& a, const SphereSet& b) {
  EXPECT_EQ(a.x(), b.x());
  EXPECT_EQ(a.y(), b.y());
  EXPECT_EQ(a.z(), b.z());
  EXPECT_EQ(a.r(), b.r());
  EXPECT_EQ(a.scale_exponent(), b.scale_exponent());
  EXPECT_EQ(a.attributes().opacity, b.attributes().opacity);
  EXPECT_EQ(a.attributes().colour, b.attributes().colour);
}

TEST(CentralBox, leaves_out_as_many_at_either_end) {
  std::vector<double> x, zero;
  for (int i = 0; i < 100; ++i) x.push_back(i);
  zero.assign(100, 0);
  const SphereSet spheres = SphereSet::from_world(x, zero, zero, zero).value();
  const double unit = spheres.inverse_scale();
  const CentralBox all = central_box(spheres, 1);
  EXPECT_EQ(double(all.lo[0]) * unit, 0);
  EXPECT_EQ(double(all.hi[0]) * unit, 99);
  const CentralBox most = central_box(spheres, 0.9);
  EXPECT_EQ(double(most.lo[0]) * unit, 5);
  EXPECT_EQ(double(most.hi[0]) * unit, 94);
  // Less than a whole sphere is none.
  const CentralBox nearly_all = central_box(spheres, 0.985);
  EXPECT_EQ(double(nearly_all.hi[0]) * unit, 99);
}

TEST(FramedSpheres, a_sphere_far_away_does_not_count) {
  const LoadedScene near = loaded(cube_csv(), "plain");
  const LoadedScene far = loaded(cube_csv("1000,0,0\n-500,2000,5\n"), "plain");
  EXPECT_EQ(FramedSpheres(far.scene, 1).set().size(), far.scene.spheres.size());
  EXPECT_EQ(FramedSpheres(far.scene, 0.99).set().size(), near.scene.spheres.size());
  EXPECT_EQ(&FramedSpheres(far.scene, 1).set(), &far.scene.spheres);

  RenderSettings settings = settings_from(far.scene.picture);
  const Side side = side_of(ViewFrom::front);
  const double whole = length(frame_picture(far.scene, side, {}, settings).eye);
  settings.fit_share = 0.99;
  const Camera most = frame_picture(far.scene, side, {}, settings);
  const Camera of_near = frame_picture(near.scene, side, {}, settings);
  EXPECT_GT(whole, 1000);
  EXPECT_NEAR(length(most.eye - of_near.eye), 0, 1e-3);
}

TEST(FramedSpheres, where_none_is_in_the_middle_along_all_axes_all_are_framed) {
  // Six clusters on the axes: along each axis the central half of them is at 0.
  std::string text = "x,y,z\n";
  for (const char* end : {"-9,0,0", "9,0,0", "0,-9,0", "0,9,0", "0,0,-9", "0,0,9"}) text += std::string(end) + "\n";
  const LoadedScene ends = loaded(text, "plain");
  EXPECT_EQ(FramedSpheres(ends.scene, 0.5).set().size(), 6);
}

TEST(Density, dots_have_the_size_that_the_style_states) {
  const LoadedScene cube = loaded(cube_csv("1e6,0,0\n"), "density");
  ASSERT_TRUE(cube.density && cube.density->radius);
  EXPECT_NEAR(*cube.density->radius, 10 / std::sqrt(1332.0) / 2, 1e-6);  // few points have larger dots
  EXPECT_THAT(cube.scene.spheres.r(), Each(Eq(cube.scene.spheres.r()[0])));
  EXPECT_NEAR(cube.scene.spheres.radius(0), *cube.density->radius, 1e-6);
  EXPECT_THAT(cube.warnings, Each(Not(HasSubstr("no radii"))));
  EXPECT_THAT(cube.rules, ::testing::Contains(HasSubstr("as the style density draws points")));
  EXPECT_EQ(cube.scene.picture.fit_share, 0.98);
}

TEST(Density, as_many_discs_as_are_behind_each_other_have_the_brightness) {
  // Along each axis 11 points are behind each other, and a square holds one such column; a disc fills pi/4 of it.
  const LoadedScene cube = loaded(cube_csv(), "density");
  ASSERT_TRUE(cube.density && cube.density->opacity);
  const double discs = 11 * 3.14159265358979 / 4;
  EXPECT_NEAR(1 - std::pow(1 - *cube.density->opacity, discs), 0.9, 1e-9);
  const auto opacity = static_cast<float>(*cube.density->opacity);
  EXPECT_THAT(cube.scene.spheres.attributes().opacity, Each(Eq(opacity)));
  EXPECT_EQ(cube.scene.spheres.attributes().opacity.size(), std::size_t(cube.scene.spheres.size()));
}

TEST(Density, what_the_file_states_stays) {
  const LoadedScene spheres = loaded("x,y,z,r,opacity\n0,0,0,1,0.5\n5,0,0,2,0.25\n", "density");
  EXPECT_EQ(spheres.scene.spheres.radius(1), 2);
  EXPECT_EQ(spheres.scene.spheres.attributes().opacity, (std::vector<float>{0.5f, 0.25f}));
  const Style style = style_named("density").value();
  ReadOptions options;
  options.radius = 0.25;
  const LoadedScene points = load_scene("x,y,z\n0,0,0\n5,0,0\n", "a.csv", options, LooksOfFile::apply, &style).value();
  EXPECT_EQ(points.scene.spheres.radius(0), 0.25);
  EXPECT_EQ(points.scene.spheres.attributes().opacity.size(), 2u);
}

TEST(Density, one_place_and_one_point_have_values_too) {
  for (const char* text : {"x,y,z\n1,2,3\n", "x,y,z\n1,2,3\n1,2,3\n1,2,3\n"}) {
    const LoadedScene points = loaded(text, "density");
    ASSERT_TRUE(points.density);
    EXPECT_GT(points.scene.spheres.radius(0), 0);
    EXPECT_GE(*points.density->opacity, kLeastOpacityOfDots);
    EXPECT_LE(*points.density->opacity, 1);
  }
}

TEST(Density, another_style_takes_everything_back) {
  const LoadedScene plain = loaded(cube_csv(), "plain");
  const LoadedScene density = loaded(cube_csv(), "density");
  LoadedScene changed = plain;
  restyle(changed, style_named("density").value());
  expect_same_spheres(changed.scene.spheres, density.scene.spheres);
  restyle(changed, style_named("density").value());
  expect_same_spheres(changed.scene.spheres, density.scene.spheres);
  restyle(changed, style_named("plain").value());
  expect_same_spheres(changed.scene.spheres, plain.scene.spheres);
  EXPECT_FALSE(changed.density);
}

}  // namespace
}  // namespace bihive
