#include "bihive/scene/links.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bihive/scene/legend.h"

namespace bihive {
namespace {

using ::testing::HasSubstr;

Scene scene_of_three() {
  Scene scene;
  scene.spheres = SphereSet::from_world(std::vector<double>{0, 4, 8}, {0, 0, 0}, {0, 0, 0}, {1, 1, 0.5}).value();
  return scene;
}

Cell cube_of(double side) {
  Cell cell;
  cell.vectors = {Vec3d{side, 0, 0}, Vec3d{0, side, 0}, Vec3d{0, 0, side}};
  cell.periodic = {true, true, true};
  return cell;
}

LinkTable table_of(const std::string& text) {
  const Result<LinkTable> table = links_from_csv(text, "l.csv");
  EXPECT_TRUE(table.ok()) << table.error().to_string();
  return table ? *table : LinkTable();
}

std::string unreadable(const std::string& text) {
  const Result<LinkTable> table = links_from_csv(text, "l.csv");
  EXPECT_FALSE(table.ok()) << text;
  return table ? "" : table.error().to_string();
}

std::string undrawn(const std::string& text, Links links = {}) {
  Scene scene = scene_of_three();
  const Result<AddedLinks> added = add_links(scene, table_of(text), links);
  EXPECT_FALSE(added.ok()) << text;
  EXPECT_TRUE(scene.sticks.empty());
  return added ? "" : added.error().to_string();
}

// In world units.
Stick link_half(const Scene& scene, std::int64_t k) {
  Stick made = scene.sticks.stored(scene.spheres, k);
  const double world = scene.spheres.inverse_scale();
  return {world * made.a, world * made.b, world * made.radius_a, world * made.radius_b};
}

TEST(Links, have_two_halves_that_belong_to_their_spheres) {
  Scene scene = scene_of_three();
  const Result<AddedLinks> added = add_links(scene, table_of("first,second\n0,1\n2,1\n"), {});
  ASSERT_TRUE(added.ok()) << added.error().to_string();
  EXPECT_EQ(added->count, 2);
  ASSERT_EQ(scene.sticks.size(), 4);
  EXPECT_EQ(link_half(scene, 0), (Stick{{0, 0, 0}, {2, 0, 0}, 0.25, 0.25}));
  EXPECT_EQ(link_half(scene, 1), (Stick{{2, 0, 0}, {4, 0, 0}, 0.25, 0.25}));
  EXPECT_EQ(link_half(scene, 2), (Stick{{8, 0, 0}, {6, 0, 0}, 0.125, 0.125}))
      << "a quarter of the smaller sphere's radius";
  const std::int64_t spheres[] = {0, 1, 2, 1};
  for (std::int64_t k = 0; k < 4; ++k) EXPECT_EQ(shown_sphere(scene, 3 + 2 * k), spheres[k]);
  EXPECT_FALSE(scene.sticks.has_colours());
}

TEST(Links, go_through_the_sides_of_a_cell) {
  for (const std::string text : {"first,second\n0,2\n", "first,second,image_a,image_b,image_c\n0,2,-1,0,0\n"}) {
    Scene scene = scene_of_three();
    scene.spheres.cell() = cube_of(10);
    ASSERT_TRUE(add_links(scene, table_of(text), {}).ok());
    ASSERT_EQ(scene.sticks.size(), 2);
    EXPECT_EQ(link_half(scene, 0), (Stick{{0, 0, 0}, {-1, 0, 0}, 0.125, 0.125})) << text;
    EXPECT_EQ(link_half(scene, 1), (Stick{{9, 0, 0}, {8, 0, 0}, 0.125, 0.125})) << text;
  }
}

TEST(Links, take_radii_and_colours_from_columns) {
  Scene scene = scene_of_three();
  Links links;
  links.radius = "f:0.125";
  links.colour = "f:magma";
  const LinkTable table = table_of("f,first,second\n2,0,1\n4,1,2\n0,0,2\n,0,2\n");
  const Result<AddedLinks> added = add_links(scene, table, links);
  ASSERT_TRUE(added.ok()) << added.error().to_string();
  EXPECT_EQ(added->count, 2);
  EXPECT_EQ(added->unknown, 1);
  ASSERT_EQ(scene.sticks.size(), 4);
  EXPECT_EQ(link_half(scene, 0).radius_a, 0.25);
  EXPECT_EQ(link_half(scene, 2).radius_a, 0.5);
  ASSERT_TRUE(scene.sticks.has_colours());
  EXPECT_EQ(*scene.sticks.colour_at(0), *scene.sticks.colour_at(2));
  EXPECT_NE(*scene.sticks.colour_at(0), *scene.sticks.colour_at(4));
  const std::vector<LegendKey> keys = legend_of(scene);
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys[0].title, "f");
}

TEST(Links, name_spheres_by_their_numbers_in_the_input) {
  Scene scene = scene_of_three();
  scene.id_in_input = {1, 2, 5};
  scene.size_of_input = 6;
  const Result<AddedLinks> added = add_links(scene, table_of("first,second\n1,5\n0,1\n"), {});
  ASSERT_TRUE(added.ok()) << added.error().to_string();
  EXPECT_EQ(added->count, 1) << "sphere 0 of the input is hidden";
  EXPECT_EQ(link_half(scene, 0).a, (Vec3d{0, 0, 0}));
  EXPECT_EQ(link_half(scene, 1).b, (Vec3d{8, 0, 0}));
}

TEST(Links, name_the_line_of_what_is_wrong) {
  EXPECT_THAT(unreadable("first,second\n0,1\n0\n"), HasSubstr("l.csv:3"));
  EXPECT_THAT(unreadable("first,second\n0,x\n"), HasSubstr("expected a whole number"));
  EXPECT_THAT(unreadable("0,1\n"), HasSubstr("names of columns"));
  EXPECT_THAT(unreadable("# nothing\n"), HasSubstr("no line"));
  EXPECT_THAT(undrawn("first,second\n0,3\n"), HasSubstr("there are 3"));
  EXPECT_THAT(undrawn("first,second\n0,0\n"), HasSubstr("itself"));
  Links links;
  links.radius = "g";
  EXPECT_THAT(undrawn("first,second,f\n0,1,2\n", links), HasSubstr("there are f"));
  links.radius = "f";
  EXPECT_THAT(undrawn("first,second,f\n0,1,-2\n", links), HasSubstr("below 0"));
}

}  // namespace
}  // namespace bihive
