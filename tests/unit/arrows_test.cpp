#include "bihive/scene/arrows.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "bihive/scene/framed_spheres.h"
#include "bihive/scene/legend.h"
#include "bihive/scene/looks.h"

namespace bihive {
namespace {

using ::testing::HasSubstr;

// Three spheres with vectors (fx, fy, fz): along x, none, and unknown.
Scene scene_with_vectors() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Scene scene;
  scene.spheres = SphereSet::from_world(std::vector<double>{0, 4, 8}, {0, 0, 0}, {0, 0, 0}, {1, 1, 0.5}).value();
  scene.spheres.attributes().numbers = {{"fx", {3, 0, 1}}, {"fy", {0, 0, nan}}, {"fz", {0, 0, 0}}, {"q", {1, 2, 3}}};
  return scene;
}

Arrows forces() {
  Arrows arrows;
  arrows.components = "fx,fy,fz";
  return arrows;
}

std::string refused(const Arrows& arrows) {
  Scene scene = scene_with_vectors();
  const Result<AddedArrows> added = add_arrows(scene, arrows);
  EXPECT_FALSE(added.ok());
  EXPECT_TRUE(scene.sticks.empty());
  return added ? "" : added.error().to_string();
}

// In world units.
Stick stick(const Scene& scene, std::int64_t k) {
  Stick made = scene.sticks.stored(scene.spheres, k);
  const double world = scene.spheres.inverse_scale();
  return {world * made.a, world * made.b, world * made.radius_a, world * made.radius_b};
}

TEST(Arrows, are_a_shaft_and_a_head_that_ends_in_a_point) {
  Scene scene = scene_with_vectors();
  Arrows arrows = forces();
  arrows.scale = 2;
  const Result<AddedArrows> added = add_arrows(scene, arrows);
  ASSERT_TRUE(added.ok()) << added.error().to_string();
  EXPECT_EQ(added->count, 1);
  EXPECT_EQ(added->unknown, 1);
  EXPECT_EQ(added->inside, 0);
  EXPECT_EQ(added->longest, 6);
  ASSERT_EQ(scene.sticks.size(), 2);
  // A shaft of a quarter of the sphere's radius, and a head of five times that.
  EXPECT_EQ(stick(scene, 0), (Stick{{0, 0, 0}, {4.75, 0, 0}, 0.25, 0.25}));
  const Stick head = stick(scene, 1);
  EXPECT_EQ(head.a, (Vec3d{4.75, 0, 0}));
  EXPECT_EQ(head.b, (Vec3d{6, 0, 0}));
  EXPECT_FLOAT_EQ(static_cast<float>(head.radius_a), 0.55F);
  EXPECT_EQ(head.radius_b, 0);
  // It looks like its sphere.
  for (std::int64_t id = 3; id < 7; ++id) EXPECT_EQ(shown_sphere(scene, id), 0);
  EXPECT_FALSE(scene.sticks.has_colours());
}

TEST(Arrows, may_be_centred_on_their_spheres_and_be_short) {
  Scene scene = scene_with_vectors();
  Arrows arrows = forces();
  arrows.pivot = ArrowPivot::middle;
  arrows.radius = 2;
  const Result<AddedArrows> added = add_arrows(scene, arrows);
  ASSERT_TRUE(added.ok());
  EXPECT_EQ(added->inside, 0) << "a radius of 1, and half of 3";
  // A head alone, in its proportions.
  ASSERT_EQ(scene.sticks.size(), 1);
  const Stick head = stick(scene, 0);
  EXPECT_EQ(head.a, (Vec3d{-1.5, 0, 0}));
  EXPECT_EQ(head.b, (Vec3d{1.5, 0, 0}));
  EXPECT_FLOAT_EQ(static_cast<float>(head.radius_a), 3 * 2.2F / 5);
  arrows.pivot = ArrowPivot::tail;
  arrows.scale = 0.25;
  Scene small = scene_with_vectors();
  EXPECT_EQ(add_arrows(small, arrows)->inside, 1);
}

TEST(Arrows, may_be_as_long_as_a_share_of_the_set) {
  Scene scene = scene_with_vectors();
  const SphereSet::Bounds bounds = scene.spheres.bounds();
  const Vec3d sides = bounds.hi - bounds.lo;
  Arrows arrows = forces();
  arrows.scale = 77;
  arrows.share = 0.25;
  const Result<AddedArrows> added = add_arrows(scene, arrows);
  ASSERT_TRUE(added.ok());
  EXPECT_NEAR(added->longest, 0.25 * std::max({sides.x, sides.y, sides.z}), 1e-9);
  arrows.components = "fz,fz,fz";
  Scene none = scene_with_vectors();
  EXPECT_EQ(add_arrows(none, arrows)->count, 0);
}

TEST(Arrows, of_a_selection_in_colours_of_their_own) {
  Scene scene = scene_with_vectors();
  Arrows arrows = forces();
  arrows.components = "q,0*q,q-q";
  arrows.select = "index 1 2";
  arrows.colour = "q:viridis";
  ASSERT_TRUE(add_arrows(scene, arrows).ok());
  ASSERT_GE(scene.sticks.size(), 2);
  EXPECT_TRUE(scene.sticks.has_colours());
  EXPECT_EQ(shown_sphere(scene, 3), 1);
  ASSERT_NE(scene.sticks.colour_at(0), nullptr);
  const std::int64_t last = 2 * scene.sticks.size() - 1;
  EXPECT_NE(*scene.sticks.colour_at(0), *scene.sticks.colour_at(last));
  // Its scale stands in the legend.
  const std::vector<LegendKey> keys = legend_of(scene);
  ASSERT_EQ(keys.size(), 1);
  EXPECT_EQ(keys[0].title, "q");
  EXPECT_EQ(keys[0].scale->range, std::pair(2.0, 3.0));

  Scene red = scene_with_vectors();
  arrows.colour = "red";
  ASSERT_TRUE(add_arrows(red, arrows).ok());
  EXPECT_EQ(*red.sticks.colour_at(1), (Vec3f{1, 0, 0}));
  EXPECT_TRUE(legend_of(red).empty());
}

TEST(Arrows, have_a_legend_of_their_categories) {
  Scene scene = scene_with_vectors();
  scene.spheres.attributes().numbers = {{"fx", {3, 2, 1}}, {"fy", {0, 0, 0}}, {"fz", {0, 0, 0}}};
  scene.spheres.attributes().texts = {{"phase", {"up", "down", "none"}, {0, 1, 2}}};
  Arrows arrows = forces();
  arrows.select = "index 0 1";  // the third one has no arrow
  arrows.colour = "phase";
  ASSERT_TRUE(add_arrows(scene, arrows));
  const std::vector<LegendKey> keys = legend_of(scene);
  ASSERT_EQ(keys.size(), 1U);
  EXPECT_EQ(keys[0].title, "phase");
  ASSERT_EQ(keys[0].entries.size(), 2U);
  EXPECT_EQ(keys[0].entries[0].name, "up");
  EXPECT_EQ(keys[0].entries[1].name, "down");
  EXPECT_FALSE(keys[0].entries[0].colour == keys[0].entries[1].colour);

  // Spheres that are coloured so say it already.
  ColourBy phase;
  phase.attribute = "phase";
  ASSERT_TRUE(apply_looks(scene, {Look{"all", {phase}}}));
  EXPECT_EQ(legend_of(scene).size(), 1U);
}

TEST(Arrows, say_what_is_wrong) {
  const auto with = [](auto change) {
    Arrows arrows = forces();
    change(arrows);
    return refused(arrows);
  };
  for (const char* bad : {"fx", "fx,fy", "fx,fy,fz,q", "fx,,fz", "fx,fy,"})
    EXPECT_THAT(with([&](Arrows& a) { a.components = bad; }), HasSubstr("expected three attributes")) << bad;
  EXPECT_THAT(with([](Arrows& a) { a.components = "fx,fy,fw"; }), HasSubstr("there is no attribute \"fw\""));
  EXPECT_THAT(with([](Arrows& a) { a.select = "index <"; }), HasSubstr("arrow_select: column"));
  EXPECT_THAT(with([](Arrows& a) { a.colour = "charge"; }),
              HasSubstr("arrow_colour: no colour, and there is no attribute"));
  EXPECT_THAT(with([](Arrows& a) { a.colour = "q:rainbow"; }), HasSubstr("there is no colour map"));
  EXPECT_THAT(with([](Arrows& a) { a.scale = 2e38; }), HasSubstr("single precision"));

  Scene scene = scene_with_vectors();
  scene.spheres.attributes().numbers.push_back({"red", {1, 2, 3}});
  Arrows arrows = forces();
  arrows.colour = "red";
  EXPECT_THAT(add_arrows(scene, arrows).error().to_string(), HasSubstr("is a colour and an attribute"));
  ASSERT_TRUE(apply_looks(scene, {Look{"index 0", {ScaleRadius{0}}}}));
  arrows.colour = "";
  EXPECT_THAT(add_arrows(scene, arrows).error().to_string(), HasSubstr("sphere 0 has radius 0"));
  arrows.radius = 0.1;
  EXPECT_TRUE(add_arrows(scene, arrows).ok());
}

TEST(Arrows, a_set_makes_room_for_them_and_keeps_its_sticks) {
  Scene scene = scene_with_vectors();
  const Vec3d before = scene.spheres.centre(2);
  scene.sticks = StickSet::between(scene.spheres, {{0, 1}}, 0.125).value();
  Arrows arrows = forces();
  arrows.scale = 1000;
  arrows.radius = 0.5;
  ASSERT_TRUE(add_arrows(scene, arrows).ok());
  EXPECT_EQ(scene.spheres.centre(2), before);
  ASSERT_EQ(scene.sticks.size(), 3);
  EXPECT_EQ(stick(scene, 0), (Stick{{0, 0, 0}, {4, 0, 0}, 0.125, 0.125}));
  EXPECT_EQ(stick(scene, 2).b, (Vec3d{3000, 0, 0}));
  EXPECT_LE(std::abs(scene.sticks.stored(scene.spheres, 2).b.x), 1);
  // A camera brings them into view.
  EXPECT_EQ(FramedSpheres(scene, 1).set().bounds().hi.x, 3000);
}

TEST(Arrows, copies_have_them) {
  Scene scene = scene_with_vectors();
  ASSERT_TRUE(scene.spheres.replicate({Vec3d{0, 16, 0}, Vec3d{1, 0, 0}, Vec3d{0, 0, 1}}, {3, 1, 1}).ok());
  ASSERT_TRUE(add_arrows(scene, forces()).ok());
  EXPECT_EQ(scene.sticks.total_size(scene.spheres), 6);
  EXPECT_EQ(stick(scene, 5).b, (Vec3d{3, 32, 0}));
  EXPECT_EQ(shown_sphere(scene, scene.spheres.total_size() + 10), 6);
  const SphereSet::Bounds bounds = FramedSpheres(scene, 1).set().bounds();
  EXPECT_EQ(bounds.hi.y, 33);
  EXPECT_EQ(bounds.lo.x, -1);
}

TEST(Sticks, with_ends_of_their_own_are_checked) {
  Scene scene = scene_with_vectors();
  const double inf = std::numeric_limits<double>::infinity();
  for (const OwnStick& bad : {OwnStick{{0, 0, 0}, {1, 0, 0}, 0, 0, 0}, OwnStick{{0, 0, 0}, {1, 0, 0}, -1, 1, 0},
                              OwnStick{{0, 0, inf}, {1, 0, 0}, 1, 1, 0}, OwnStick{{0, 0, 0}, {1, 0, 0}, 1, 1, 3},
                              OwnStick{{0, 0, 0}, {1, 0, 0}, 1, 1, -1}, OwnStick{{0, 0, 0}, {4e38, 0, 0}, 1, 1, 0},
                              OwnStick{{0, 0, 0}, {1, 0, 0}, std::nan(""), 1, 0}})
    EXPECT_FALSE(scene.sticks.add(scene.spheres, {bad}).ok());
  EXPECT_TRUE(scene.sticks.empty());
  EXPECT_TRUE(scene.sticks.add(scene.spheres, {{{0, 0, 0}, {1, 0, 0}, 0, 0.5, 2}}).ok());
  EXPECT_EQ(scene.sticks.own_count(), 1);
}

}  // namespace
}  // namespace bihive
