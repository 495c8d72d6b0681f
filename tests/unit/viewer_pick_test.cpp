// What a point of the picture shows, and pictures whose background is left transparent.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "bihive/viewer/pick.h"
#include "bihive/viewer/viewer.h"

namespace bihive {
namespace {

constexpr int kWidth = 120, kHeight = 80;

// Two spheres of radius 1 at x = -2 and 2, the left one with texts and without a charge.
constexpr const char* kTwo =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n-3 3\n-1 1\n-1 1\n"
    "ITEM: ATOMS id element x y z radius q\n7 C -2 0 0 1 nan\n9 O 2 0 0 1 -0.5\n";

Viewer& two_spheres(Viewer& viewer) {
  viewer.resize(kWidth, kHeight);
  const Result<SceneFacts> facts = viewer.load(kTwo, "two.dump");
  EXPECT_TRUE(facts) << facts.error().to_string();
  ViewerSettings settings = viewer.settings();
  settings.camera.eye = {0, 0, 10};
  settings.camera.look_at = {0, 0, 0};
  settings.camera.up = {0, 1, 0};
  settings.camera.fov_deg = 40;
  EXPECT_TRUE(viewer.set(settings));
  return viewer;
}

void settle(Viewer& viewer) {
  for (;;) {
    const Result<FrameReport> report = viewer.frame(5);
    ASSERT_TRUE(report) << report.error().to_string();
    if (report->settled) return;
  }
}

// Where a point of the plane z = 1 lies in the picture.
double column_of(double x) {
  const double half = std::tan(20 * 3.14159265358979323846 / 180) * 9;
  return kWidth / 2.0 + x / half * (kHeight / 2.0);
}

TEST(Pick, finds_the_sphere_under_a_point_and_what_is_known_of_it) {
  Viewer viewer;
  two_spheres(viewer);
  const Result<std::optional<Picked>> right = viewer.pick(column_of(2), kHeight / 2.0);
  ASSERT_TRUE(right) << right.error().to_string();
  ASSERT_TRUE(*right);
  EXPECT_EQ((*right)->sphere, 1);
  EXPECT_NEAR((*right)->point.x, 1.97, 0.1);
  EXPECT_NEAR((*right)->distance, std::hypot((*right)->point.x, (*right)->point.y, 10 - (*right)->point.z), 1e-5);
  const auto json = nlohmann::json::parse(picked_to_json(**right, viewer.scene()));
  EXPECT_EQ(json.at("centre"), (nlohmann::json{2.0, 0.0, 0.0}));
  EXPECT_EQ(json.at("radius"), 1.0);
  EXPECT_EQ(json.at("attributes").at("id"), 9);
  EXPECT_EQ(json.at("attributes").at("element"), "O");
  EXPECT_EQ(json.at("attributes").at("q"), -0.5);
  EXPECT_FALSE(json.at("attributes").contains("x"));

  const Result<std::optional<Picked>> left = viewer.pick(column_of(-2), kHeight / 2.0);
  ASSERT_TRUE(left && *left);
  EXPECT_TRUE(nlohmann::json::parse(picked_to_json(**left, viewer.scene())).at("attributes").at("q").is_null());
  const Result<std::optional<Picked>> between = viewer.pick(kWidth / 2.0, kHeight / 2.0);
  ASSERT_TRUE(between);
  EXPECT_FALSE(*between);
}

TEST(Pick, finds_nothing_without_a_scene_or_in_the_view_of_the_tree) {
  Viewer viewer;
  const Result<std::optional<Picked>> nothing = viewer.pick(1, 1);
  ASSERT_TRUE(nothing);
  EXPECT_FALSE(*nothing);
  two_spheres(viewer);
  ViewerSettings settings = viewer.settings();
  settings.view = View::tree;
  ASSERT_TRUE(viewer.set(settings));
  const Result<std::optional<Picked>> in_tree = viewer.pick(column_of(2), kHeight / 2.0);
  ASSERT_TRUE(in_tree);
  EXPECT_FALSE(*in_tree);
}

TEST(ViewerOpacity, is_that_of_the_saved_picture_where_no_checks_are_wanted) {
  Viewer viewer;
  viewer.show_checks(false);
  two_spheres(viewer);
  settle(viewer);
  EXPECT_TRUE(viewer.opacity().empty()) << "the background is opaque";
  ViewerLook look = viewer.look();
  look.background = "none";
  ASSERT_TRUE(viewer.set_look(look));
  settle(viewer);
  const Result<PngPixels> saved = viewer.picture(kWidth, kHeight, samples_at_rest(viewer.settings()));
  ASSERT_TRUE(saved);
  ASSERT_EQ(saved->channels, 4);
  ASSERT_EQ(viewer.opacity().size(), std::size_t(kWidth) * kHeight);
  for (std::size_t i = 0; i < viewer.opacity().size(); ++i) {
    ASSERT_EQ(viewer.opacity()[i], saved->bytes[4 * i + 3]) << i;
    for (std::size_t channel = 0; channel < 3; ++channel)
      ASSERT_EQ(viewer.image().rgb[3 * i + channel], saved->bytes[4 * i + channel]) << i;
  }
  EXPECT_EQ(viewer.opacity().front(), 0);
  look.background = "white";
  ASSERT_TRUE(viewer.set_look(look));
  settle(viewer);
  EXPECT_TRUE(viewer.opacity().empty());
}

// While something moves the coarse picture is enlarged below the letters.
TEST(ViewerOpacity, stays_with_labels_on_coarse_pictures) {
  Viewer viewer;
  viewer.show_checks(false);
  two_spheres(viewer);
  ViewerLook look = viewer.look();
  look.background = "none";
  ASSERT_TRUE(viewer.set_look(look));
  ViewerSettings settings = viewer.settings();
  settings.picture.user.set("title", std::string("Two"));
  ASSERT_TRUE(viewer.set(settings));
  const Result<FrameReport> first = viewer.frame(0.001);
  ASSERT_TRUE(first);
  settle(viewer);
  ASSERT_EQ(viewer.opacity().size(), std::size_t(kWidth) * kHeight);
  EXPECT_EQ(viewer.opacity().back(), 0);
}

}  // namespace
}  // namespace bihive
