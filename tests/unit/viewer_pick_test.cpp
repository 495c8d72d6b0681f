// What a point of the picture shows, what the scene holds, and pictures whose background is left transparent.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bihive/select/selection.h"
#include "bihive/viewer/contents.h"
#include "bihive/viewer/pick.h"
#include "bihive/viewer/viewer.h"

namespace bihive {
namespace {

constexpr int kPickWidth = 120, kPickHeight = 80;

// Two spheres of radius 1 at x = -2 and 2, the left one with texts and without a charge.
constexpr const char* kTwo =
    "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS ff ff ff\n-3 3\n-1 1\n-1 1\n"
    "ITEM: ATOMS id element x y z radius q\n7 C -2 0 0 1 nan\n9 O 2 0 0 1 -0.5\n";

Viewer& two_spheres(Viewer& viewer) {
  viewer.resize(kPickWidth, kPickHeight);
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

void settle_pick(Viewer& viewer) {
  for (;;) {
    const Result<FrameReport> report = viewer.frame(5);
    ASSERT_TRUE(report) << report.error().to_string();
    if (report->settled) return;
  }
}

// Where a point of the plane z = 1 lies in the picture.
double column_of(double x) {
  const double half = std::tan(20 * 3.14159265358979323846 / 180) * 9;
  return kPickWidth / 2.0 + x / half * (kPickHeight / 2.0);
}

TEST(Pick, finds_the_sphere_under_a_point_and_what_is_known_of_it) {
  Viewer viewer;
  two_spheres(viewer);
  const Result<std::optional<Picked>> right = viewer.pick(column_of(2), kPickHeight / 2.0);
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

  const Result<std::optional<Picked>> left = viewer.pick(column_of(-2), kPickHeight / 2.0);
  ASSERT_TRUE(left && *left);
  EXPECT_TRUE(nlohmann::json::parse(picked_to_json(**left, viewer.scene())).at("attributes").at("q").is_null());
  const Result<std::optional<Picked>> between = viewer.pick(kPickWidth / 2.0, kPickHeight / 2.0);
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
  const Result<std::optional<Picked>> in_tree = viewer.pick(column_of(2), kPickHeight / 2.0);
  ASSERT_TRUE(in_tree);
  EXPECT_FALSE(*in_tree);
}

TEST(RayPaths, pass_the_spheres_under_a_point_by_the_ids_of_the_input) {
  Viewer viewer;
  EXPECT_FALSE(viewer.ray_paths_json(1, 1));
  two_spheres(viewer);
  ViewerLook look = viewer.look();
  look.rows = {{"index 0", "hide", ""}};
  ASSERT_TRUE(viewer.set_look(look));
  const Result<std::string> text = viewer.ray_paths_json(column_of(2), kPickHeight / 2.0);
  ASSERT_TRUE(text) << text.error().to_string();
  const auto json = nlohmann::json::parse(*text);
  ASSERT_EQ(json.at("structures").size(), 2u);
  const Result<std::optional<Picked>> picked = viewer.pick(column_of(2), kPickHeight / 2.0);
  ASSERT_TRUE(picked && *picked);
  for (const auto& path : json.at("structures")) {
    SCOPED_TRACE(path.at("name"));
    EXPECT_EQ(path.at("id"), 1);
    EXPECT_NEAR(path.at("t").get<double>(), (*picked)->distance, 1e-5);
    EXPECT_EQ(path.at("sphere_tests"), 1);
    EXPECT_EQ(path.at("steps").back().at("spheres"), nlohmann::json{1});
  }
  const Result<std::string> beside = viewer.ray_paths_json(kPickWidth / 2.0, kPickHeight / 2.0);
  ASSERT_TRUE(beside);
  for (const auto& path : nlohmann::json::parse(*beside).at("structures")) EXPECT_TRUE(path.at("t").is_null());
}

TEST(RayPaths, are_refused_where_rays_take_other_ways_than_among_whole_spheres) {
  Viewer viewer;
  two_spheres(viewer);
  ViewerLook look = viewer.look();
  look.rows = {{"", "clip", "plane:1,0,0,2"}};
  const auto set = viewer.set_look(look);
  ASSERT_TRUE(set) << set.error().to_string();
  const Result<std::string> text = viewer.ray_paths_json(column_of(2), kPickHeight / 2.0);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().message, "paths are those of rays among whole spheres");
}

TEST(Contents, lists_groups_whose_selections_mean_as_many_spheres_also_where_some_are_hidden) {
  Viewer viewer;
  ASSERT_TRUE(viewer.load_built_in("demo"));
  ViewerLook look = viewer.look();
  look.rows = {{"water", "hide", ""}};
  ASSERT_TRUE(viewer.set_look(look));
  const SphereSet& spheres = viewer.input_spheres();
  EXPECT_GT(spheres.size(), viewer.scene().spheres.size());
  const std::vector<ContentGroup> groups = contents_of(spheres);
  std::string names;
  for (const ContentGroup& group : groups) {
    names += group.of + " " + group.name + ", ";
    const Result<std::vector<std::uint8_t>> mask = select_spheres(spheres, group.selection);
    ASSERT_TRUE(mask) << group.selection;
    EXPECT_EQ(std::count(mask->begin(), mask->end(), 1), group.count) << group.selection;
  }
  EXPECT_EQ(names,
            "kind protein, kind ligand, kind water, ligand 478, chain A, chain B, chain (none), element C, element N, "
            "element O, element S, ");
}

TEST(Contents, quote_texts_that_would_mean_something_else) {
  Viewer viewer;
  ASSERT_TRUE(
      viewer.load("x,y,z,r,my part\n0,0,0,1,or\n3,0,0,1,a b\n6,0,0,1,\"\"\"x\"\"\"\n9,0,0,1,C*\n", "parts.csv"));
  const SphereSet& spheres = viewer.input_spheres();
  const std::vector<ContentGroup> groups = contents_of(spheres);
  ASSERT_EQ(groups.size(), 4u);
  for (const ContentGroup& group : groups) {
    const Result<std::vector<std::uint8_t>> mask = select_spheres(spheres, group.selection);
    ASSERT_TRUE(mask) << group.selection;
    EXPECT_EQ(std::count(mask->begin(), mask->end(), 1), 1) << group.selection;
  }
}

TEST(Contents, legends_and_histograms_say_what_colours_mean) {
  Viewer viewer;
  ASSERT_TRUE(viewer.load("x,y,z,r,q\n0,0,0,1,0\n3,0,0,1,1\n6,0,0,1,nan\n9,0,0,1,4\n", "charges.csv"));
  ViewerLook look = viewer.look();
  look.colour_by = "q:greys";
  ASSERT_TRUE(viewer.set_look(look));
  const auto legend = nlohmann::json::parse(legend_to_json(viewer.scene()));
  ASSERT_EQ(legend.size(), 1u);
  EXPECT_EQ(legend[0].at("title"), "q");
  EXPECT_EQ(legend[0].at("scale").at("least"), 0);
  EXPECT_EQ(legend[0].at("scale").at("most"), 4);
  EXPECT_EQ(legend[0].at("scale").at("colours").size(), 17u);
  EXPECT_EQ(legend[0].at("entries")[0].at("name"), "unknown");

  const Result<std::string> histogram = histogram_to_json(viewer.input_spheres(), "q", 4);
  ASSERT_TRUE(histogram);
  EXPECT_EQ(nlohmann::json::parse(*histogram), (nlohmann::json{{"least", 0}, {"most", 4}, {"counts", {1, 1, 0, 1}}}));
  const Result<std::string> wide = histogram_to_json(viewer.input_spheres(), "q * 4e307", 4);
  ASSERT_TRUE(wide);
  EXPECT_EQ(nlohmann::json::parse(*wide).at("counts"), (nlohmann::json{1, 1, 0, 1}));
  EXPECT_FALSE(histogram_to_json(viewer.input_spheres(), "nothing", 4));
}

TEST(ViewerOpacity, is_that_of_the_saved_picture_where_no_checks_are_wanted) {
  Viewer viewer;
  viewer.show_checks(false);
  two_spheres(viewer);
  settle_pick(viewer);
  EXPECT_TRUE(viewer.opacity().empty()) << "the background is opaque";
  ViewerLook look = viewer.look();
  look.background = "none";
  ASSERT_TRUE(viewer.set_look(look));
  settle_pick(viewer);
  const Result<PngPixels> saved = viewer.picture(kPickWidth, kPickHeight, samples_at_rest(viewer.settings()));
  ASSERT_TRUE(saved);
  ASSERT_EQ(saved->channels, 4);
  ASSERT_EQ(viewer.opacity().size(), std::size_t(kPickWidth) * kPickHeight);
  for (std::size_t i = 0; i < viewer.opacity().size(); ++i) {
    ASSERT_EQ(viewer.opacity()[i], saved->bytes[4 * i + 3]) << i;
    for (std::size_t channel = 0; channel < 3; ++channel)
      ASSERT_EQ(viewer.image().rgb[3 * i + channel], saved->bytes[4 * i + channel]) << i;
  }
  EXPECT_EQ(viewer.opacity().front(), 0);
  look.background = "white";
  ASSERT_TRUE(viewer.set_look(look));
  settle_pick(viewer);
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
  settle_pick(viewer);
  ASSERT_EQ(viewer.opacity().size(), std::size_t(kPickWidth) * kPickHeight);
  EXPECT_EQ(viewer.opacity().back(), 0);
}

}  // namespace
}  // namespace bihive
