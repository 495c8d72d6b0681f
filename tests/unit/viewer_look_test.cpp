// The looks of the viewer: the pictures that `bihive render` draws with the same choices.
// ctest: asan-long
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "bihive/image/colour_text.h"
#include "bihive/render/draw_labels.h"
#include "bihive/render/renderer.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/bonds.h"
#include "bihive/scene/camera_lights.h"
#include "bihive/scene/element_colours.h"
#include "bihive/scene/floor.h"
#include "bihive/scene/focus.h"
#include "bihive/scene/light_text.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/look_text.h"
#include "bihive/viewer/viewer.h"

namespace bihive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr int kViewWidth = 96, kViewHeight = 64;

constexpr const char* kThree = "x,y,z,r,charge\n0,0,0,1,-1\n2.5,0,0,1,0\n0,2.5,1,1,1\n";

void settle_look(Viewer& viewer) {
  for (int i = 0; i < 100000; ++i) {
    const Result<FrameReport> report = viewer.frame(20);
    ASSERT_TRUE(report) << report.error().to_string();
    if (report->settled) return;
  }
  FAIL() << "never settled";
}

std::uint64_t shown(Viewer& viewer) {
  settle_look(viewer);
  return picture_hash(viewer.image());
}

// The picture of `bihive render` of a scene in a style, in front of the viewer's camera; by the library's own parts.
std::uint64_t rendered(LoadedScene loaded, const Camera& camera, const std::vector<Look>& looks = {}) {
  Scene& scene = loaded.scene;
  for (const Look& look : looks) loaded.looks.push_back(look);
  const Sticks sticks = scene.picture.sticks;
  if (sticks.bonds != Bonds::none) {
    EXPECT_TRUE(scale_balls(scene, sticks));
  }
  EXPECT_TRUE(apply_looks(scene, loaded.looks));
  if (sticks.bonds != Bonds::none) {
    EXPECT_TRUE(find_bonds(scene, sticks));
  }
  scene.camera = camera;
  if (!loaded.has_lights) scene.lights = lights_around(loaded.rig, camera);
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = kViewWidth;
  settings.height_px = kViewHeight;
  const Result<Tracer> tracer = Tracer::build(scene, Engine::wide);
  const Result<Rendered> picture = render(scene, *tracer, settings);
  return picture_hash(image_from_film(picture->film, View::shaded, scene.picture.transfer));
}

LoadedScene demo_in(const std::string& style) {
  const Style named = *style_named(style);
  return *built_in_scene("demo", {}, {}, &named);
}

Look look_of(const std::string& select, const std::string& action, const std::string& value) {
  return {select, {*look_action_from_text(action, value)}};
}

TEST(ViewerLook, every_style_is_the_programs) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  EXPECT_EQ(viewer.look(), ViewerLook{});
  EXPECT_EQ(shown(viewer), rendered(demo_in("default"), viewer.settings().camera)) << "without a choice";
  for (const std::string& style : style_names()) {
    ViewerLook look;
    look.style = style;
    ASSERT_TRUE(viewer.set_look(look)) << style;
    EXPECT_EQ(viewer.settings().picture.result().recursion, style_named(style)->picture.recursion) << style;
    EXPECT_EQ(viewer.settings().picture.result().shadows, style_named(style)->picture.shadows) << style;
    EXPECT_EQ(shown(viewer), rendered(demo_in(style), viewer.settings().camera)) << style;
  }

  // Another file keeps the style, from any side.
  ViewerLook xray;
  xray.style = "xray";
  ASSERT_TRUE(viewer.set_look(xray));
  ASSERT_TRUE(viewer.load(kThree, "three.csv"));
  EXPECT_EQ(viewer.look(), xray);
  EXPECT_THAT(viewer.facts().warnings, testing::IsEmpty());
  viewer.orbit(20, 10);
  const Style style = *style_named("xray");
  EXPECT_EQ(shown(viewer),
            rendered(*load_scene(kThree, "three.csv", {}, LooksOfFile::keep, &style), viewer.settings().camera));
}

TEST(ViewerLook, sticks_are_picked_as_their_atoms_and_have_no_tree_view) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load("2\n\nC 0 0 0\nO 1.4 0 0\n", "two.xyz"));
  ViewerLook look;
  look.style = "licorice";
  ASSERT_TRUE(viewer.set_look(look));
  ASSERT_EQ(viewer.scene().sticks.size(), 1);
  settle_look(viewer);
  std::set<std::int64_t> picked;
  for (int x = 0; x < kViewWidth; ++x)
    for (int y = 0; y < kViewHeight; y += 4)
      if (const auto at = viewer.pick(x + 0.5, y + 0.5); at && *at) picked.insert((*at)->sphere);
  EXPECT_EQ(picked, (std::set<std::int64_t>{0, 1}));
  ViewerSettings settings = viewer.settings();
  settings.view = View::traversal;
  const Status refused = viewer.set(settings);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().to_string(), HasSubstr("style without bonds"));
  // A style without bonds has the balls back.
  ASSERT_TRUE(viewer.set_look({}));
  EXPECT_TRUE(viewer.scene().sticks.empty());
}

TEST(ViewerLook, the_user_chooses_sticks) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load("5\n\nC 0 0 0\nO 1.4 0 0\nO 4.2 0 0\nH 3.25 0 0\nN 9 0 0\n", "five.xyz"));
  const double radius = viewer.scene().spheres.radius(0);
  const auto set = [&](const char* id, const SettingValue& value) {
    ViewerSettings settings = viewer.settings();
    settings.picture.user.set(id, value);
    return viewer.set(settings);
  };
  ASSERT_TRUE(set("bonds", std::int64_t{1}));
  EXPECT_EQ(viewer.scene().sticks.size(), 2);
  ASSERT_TRUE(set("ball_scale", 0.5));
  EXPECT_EQ(viewer.scene().spheres.radius(0), 0.5 * radius);
  ASSERT_TRUE(set("hbonds", true));
  EXPECT_GT(viewer.scene().sticks.size(), 4);
  // An arrow along x, of a shaft and a head, at all atoms but the one at 0.
  ASSERT_TRUE(set("hbonds", false));
  ASSERT_TRUE(set("arrows", std::string("x*9,0*x,0*x")));
  EXPECT_EQ(viewer.scene().sticks.size(), 2 + 4 * 2);
  // What the spheres lack is refused, and nothing changes.
  const Status refused = set("trace", std::int64_t{1});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().to_string(), HasSubstr("chain"));
  EXPECT_EQ(viewer.scene().sticks.size(), 2 + 4 * 2);

  // The look keeps them, other settings do not make them anew, and the next file has those of its own.
  ViewerLook look;
  look.background = "black";
  ASSERT_TRUE(viewer.set_look(look));
  EXPECT_EQ(viewer.scene().sticks.size(), 2 + 4 * 2);
  ViewerSettings settings = viewer.settings();
  settings.picture.user.reset("arrows");
  settings.picture.user.reset("bonds");
  settings.picture.user.reset("ball_scale");
  ASSERT_TRUE(viewer.set(settings));
  EXPECT_TRUE(viewer.scene().sticks.empty());
  EXPECT_EQ(viewer.scene().spheres.radius(0), radius);
  ASSERT_TRUE(set("bonds", std::int64_t{1}));
  ASSERT_TRUE(viewer.load("1\n\nC 0 0 0\n", "one.xyz"));
  EXPECT_TRUE(viewer.scene().sticks.empty());
  EXPECT_FALSE(viewer.settings().picture.user.has("bonds"));
}

TEST(ViewerLook, contacts_are_links_of_the_radii_as_read) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load("x,y,z,r\n0,0,0,1\n1.5,0,0,1\n4,0,0,1\n", "three.csv"));
  const auto set = [&](const char* id, const SettingValue& value) {
    ViewerSettings settings = viewer.settings();
    settings.picture.user.set(id, value);
    return viewer.set(settings);
  };
  // Two halves of one link; with a probe the gap of 0.5 is a contact too.
  ASSERT_TRUE(set("show_contacts", 0.0));
  EXPECT_EQ(viewer.scene().sticks.size(), 2);
  ASSERT_TRUE(set("show_contacts", 0.5));
  EXPECT_EQ(viewer.scene().sticks.size(), 4);
  ViewerLook look;
  look.rows.push_back({"", "radius-scale", "0.2"});
  ASSERT_TRUE(viewer.set_look(look));
  EXPECT_EQ(viewer.scene().sticks.size(), 4);

  // Radius and colour by the column area.
  ASSERT_TRUE(set("link_radius", std::string("area:0.01")));
  ASSERT_TRUE(set("link_colour", std::string("area:magma")));
  ASSERT_EQ(viewer.scene().sticks_coloured_by.size(), 1u);
  EXPECT_EQ(viewer.scene().sticks_coloured_by[0].attribute, "area");
  const Status refused = set("link_radius", std::string("force"));
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().to_string(), HasSubstr("there are area"));
  ASSERT_TRUE(set("link_radius", std::string()));
  ASSERT_TRUE(set("link_dashes", true));
  EXPECT_GT(viewer.scene().sticks.size(), 4);
  ASSERT_TRUE(set("show_contacts", SettingValue()));
  EXPECT_TRUE(viewer.scene().sticks.empty());
}

TEST(ViewerLook, the_scene_tells_what_is_not_drawn) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  const std::string document =
      R"({"bihive_scene": 2, "picture": {"trail": 3}, "spheres": [[0, 0, 0, 1], [3, 0, 0, 1]]})";
  ASSERT_TRUE(viewer.load(document, "s.json"));
  EXPECT_THAT(viewer.facts().warnings, testing::ElementsAre(HasSubstr("trails")));
}

TEST(ViewerLook, a_style_that_does_not_suit_the_next_file_is_dropped_with_a_warning) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  ViewerLook look;
  look.style = "licorice";
  ASSERT_TRUE(viewer.set_look(look));
  const std::int64_t bonds = viewer.scene().sticks.size();
  EXPECT_GT(bonds, 1000);
  // Bonds need elements.
  const Result<SceneFacts> loaded = viewer.load(kThree, "three.csv");
  ASSERT_TRUE(loaded) << loaded.error().to_string();
  EXPECT_THAT(loaded->warnings, ElementsAre(HasSubstr("not in the style licorice: bonds are found between atoms of")));
  EXPECT_EQ(viewer.look(), ViewerLook{});
  EXPECT_TRUE(viewer.scene().sticks.empty());
  const Style style = *style_named("default");
  EXPECT_EQ(shown(viewer),
            rendered(*load_scene(kThree, "three.csv", {}, LooksOfFile::keep, &style), viewer.settings().camera));
  // A file that is bad in any style is still refused, and leaves what is shown.
  EXPECT_FALSE(viewer.load("x,y,z\n1,2\n", "bad.csv"));
  EXPECT_EQ(viewer.scene().spheres.size(), 3);
  // Chosen by hand the style is refused, and says why.
  const auto unknown = viewer.set_look(look);
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().to_string(), HasSubstr("known elements"));
}

TEST(ViewerLook, what_the_user_changed_stays_when_the_style_changes) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  ViewerSettings settings = viewer.settings();
  settings.picture.user.set("recursion", 2);
  ASSERT_TRUE(viewer.set(settings));
  ViewerLook look;
  look.style = "xray";
  ASSERT_TRUE(viewer.set_look(look));
  EXPECT_EQ(viewer.settings().picture.result().recursion, 2);
  EXPECT_FALSE(viewer.settings().picture.result().shadows) << "not touched: the style's";
}

TEST(ViewerLook, rows_are_done_in_order_and_counted) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load(kThree, "three.csv"));
  EXPECT_THAT(viewer.facts().attributes, testing::Contains("charge"));
  EXPECT_TRUE(viewer.facts().takes_style);
  EXPECT_FALSE(viewer.facts().has_elements);
  ViewerLook look;
  look.rows = {{"", "colour-by", "charge:coolwarm"},
               {"charge > 0", "opacity", "0.5"},
               {"charge < 0", "material", "metal"},
               {"index 1", "colour", "orange"},
               {"index 1", "radius-scale", "0.5"}};
  const Result<std::vector<std::int64_t>> counts = viewer.set_look(look);
  ASSERT_TRUE(counts) << counts.error().to_string();
  EXPECT_THAT(*counts, ElementsAre(3, 1, 1, 1, 1));
  std::vector<Look> looks;
  for (const LookRow& row : look.rows)
    looks.push_back(look_of(row.select.empty() ? "all" : row.select, row.action, row.value));
  const Style style = *style_named("default");
  const LoadedScene file = *load_scene(kThree, "three.csv", {}, LooksOfFile::keep, &style);
  EXPECT_EQ(shown(viewer), rendered(file, viewer.settings().camera, looks));

  // Without the change of a radius the trees stay; hiding makes others, and the camera shows what is left.
  look.rows = {{"index 1", "colour", "#ff0000"}};
  ASSERT_TRUE(viewer.set_look(look));
  EXPECT_EQ(shown(viewer), rendered(file, viewer.settings().camera, {look_of("index 1", "colour", "#ff0000")}));
  const Camera before = viewer.settings().camera;
  look.rows = {{"index 1", "hide", ""}};
  ASSERT_TRUE(viewer.set_look(look));
  EXPECT_EQ(viewer.scene().spheres.size(), 2);
  EXPECT_FALSE(viewer.settings().camera == before);
  EXPECT_EQ(shown(viewer), rendered(file, viewer.settings().camera, {look_of("index 1", "hide", "")}));

  // No rows: as in the beginning.
  ASSERT_TRUE(viewer.set_look({}));
  EXPECT_EQ(viewer.settings().camera, before);
  EXPECT_EQ(shown(viewer), rendered(file, before));
}

TEST(ViewerLook, a_bad_choice_names_its_row_and_changes_nothing) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  EXPECT_FALSE(viewer.set_look({})) << "no scene yet";
  ASSERT_TRUE(viewer.load(kThree, "three.csv"));
  ViewerLook good;
  good.rows = {{"", "colour", "red"}};
  ASSERT_TRUE(viewer.set_look(good));
  const std::uint64_t before = shown(viewer);
  const auto expect_refused = [&](const ViewerLook& look, std::size_t row, int column, const char* words) {
    std::size_t failed = 99;
    const Result<std::vector<std::int64_t>> counts = viewer.set_look(look, &failed);
    ASSERT_FALSE(counts) << words;
    EXPECT_EQ(failed, row) << words;
    EXPECT_EQ(counts.error().column, column) << words;
    EXPECT_THAT(counts.error().to_string(), HasSubstr(words));
  };
  const LookRow fine{"", "show", ""};
  expect_refused({"nice", "", "", {}}, 0, 0, "there is no style \"nice\"");
  expect_refused({"", "pink", "", {fine}}, 1, 0, "soft, jmol and cpk");
  expect_refused({"", "cpk", "", {fine}}, 1, 0, "the input has no elements");
  expect_refused({"", "", "blau", {fine}}, 1, 0, "background: expected #rrggbb");
  expect_refused({"", "", "", {fine, {"chrage > 0", "hide", ""}}}, 1, 1, "did you mean 'charge'?");
  expect_refused({"", "", "", {{"index 0 and", "hide", ""}}}, 0, 12, "expected");
  expect_refused({"", "", "", {fine, fine, {"all", "colour", "blau"}}}, 2, 0, "expected #rrggbb");
  expect_refused({"", "", "", {{"all", "colour-by", "chrage"}}}, 0, 0, "charge");
  expect_refused({"", "", "", {{"all", "opacity", "2"}}}, 0, 0, "expected a number from 0 to 1, found \"2\"");
  expect_refused({"", "", "", {{"all", "radius-scale", "-1"}}}, 0, 0, "expected a number from 0 to 3.4e38, found");
  expect_refused({"", "", "", {{"all", "material", "wood"}}}, 0, 0, "expected one of matte");
  expect_refused({"", "", "", {{"all", "paint", "red"}}}, 0, 0, "there are hide, show, colour");
  expect_refused({"", "", "", {{"all", "hide", ""}}}, 1, 0, "every sphere is hidden");
  EXPECT_EQ(viewer.look(), good);
  EXPECT_TRUE(viewer.frame(1)->settled) << "nothing was started anew";
  EXPECT_EQ(picture_hash(viewer.image()), before);
}

TEST(ViewerLook, a_scene_file_keeps_what_it_says) {
  const std::string text = R"({"bihive_scene": 2, "background": "black",
    "spheres": [[0, 0, 0, 1], [2, 0, 0, 1]], "looks": [{"select": "index 1", "colour": "red"}]})";
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load(text, "two.json"));
  EXPECT_EQ(shown(viewer), rendered(*load_scene(text, "two.json", {}, LooksOfFile::keep), viewer.settings().camera));
  ViewerLook look;
  look.style = "studio";
  look.rows = {{"index 0", "colour", "blue"}};
  ASSERT_TRUE(viewer.set_look(look));
  const Style studio = *style_named("studio");
  EXPECT_EQ(shown(viewer), rendered(*load_scene(text, "two.json", {}, LooksOfFile::keep, &studio),
                                    viewer.settings().camera, {look_of("index 0", "colour", "blue")}));

  // A scene with a look of its own takes no style, but takes looks.
  ASSERT_TRUE(viewer.load_built_in("four-spheres"));
  EXPECT_EQ(viewer.look(), ViewerLook{});
  EXPECT_FALSE(viewer.facts().takes_style);
  EXPECT_THAT(viewer.set_look(look).error().to_string(), HasSubstr("a look of its own"));
  look.style = "";
  EXPECT_TRUE(viewer.set_look(look));
}

TEST(ViewerLook, element_colours_and_background) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  EXPECT_TRUE(viewer.facts().has_elements);
  ViewerLook look;
  look.element_colours = "cpk";
  look.background = "#204060";
  ASSERT_TRUE(viewer.set_look(look));
  LoadedScene expected = demo_in("default");
  ASSERT_TRUE(recolour_elements(expected.scene, *element_colours_called("cpk")));
  expected.scene.background = *colour_from_text("#204060", Transfer::srgb);
  EXPECT_EQ(shown(viewer), rendered(expected, viewer.settings().camera));

  // Transparent: the saved picture has opacity, the screen shows checks.
  look.background = "none";
  ASSERT_TRUE(viewer.set_look(look));
  const Result<PngPixels> saved = viewer.picture(kViewWidth, kViewHeight, samples_at_rest(viewer.settings()));
  ASSERT_TRUE(saved);
  ASSERT_EQ(saved->channels, 4);
  EXPECT_EQ(saved->bytes[3], 0) << "the corner is clear";
  settle_look(viewer);
  EXPECT_EQ(viewer.image().rgb[0], 235);
  EXPECT_EQ(viewer.image().rgb[3 * 12], 205);
  ASSERT_TRUE(viewer.set_look({}));
  EXPECT_EQ(viewer.picture(kViewWidth, kViewHeight, 4)->channels, 3);

  // Views of the tree have no transparent background.
  ASSERT_TRUE(viewer.set_look(look));
  ViewerSettings settings = viewer.settings();
  settings.view = View::tree;
  ASSERT_TRUE(viewer.set(settings));
  EXPECT_EQ(viewer.picture(kViewWidth, kViewHeight, 1)->channels, 3);
}

TEST(ViewerLook, a_moving_picture_with_one_sample_is_still_the_programs_at_rest) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  ViewerSettings settings = viewer.settings();
  settings.picture.user.set("samples_per_pixel", 1);
  ASSERT_TRUE(viewer.set(settings));
  double done = 0;
  for (int i = 0; i < 100000; ++i) {
    const Result<FrameReport> report = viewer.frame(1000);
    ASSERT_TRUE(report);
    EXPECT_GE(report->done, done);
    done = report->done;
    if (report->settled) break;
  }
  LoadedScene expected = demo_in("default");
  expected.scene.picture.samples_per_pixel = 1;
  EXPECT_EQ(picture_hash(viewer.image()), rendered(expected, viewer.settings().camera));
}

TEST(LookText, light_may_be_three_numbers) {
  EXPECT_EQ(std::get<Vec3d>(*colour_choice_from_text("0.5,0,1")), (Vec3d{0.5, 0, 1}));
  EXPECT_EQ(std::get<std::string>(*colour_choice_from_text("orange")), "orange");
  for (const char* bad : {"", "1,2,3", "0,0", "0,0,0,0", "0,0,", "a,b,c", "#12345"})
    EXPECT_FALSE(colour_choice_from_text(bad)) << bad;
}

// The picture of `bihive render` of the demo with these settings, by the library's own parts; labels over it.
std::uint64_t demo_with(const Camera& camera, const std::function<void(Scene&, RenderSettings&)>& change) {
  LoadedScene loaded = demo_in("default");
  Scene& scene = loaded.scene;
  scene.camera = camera;
  scene.lights = lights_around(loaded.rig, camera);
  RenderSettings settings = settings_from(scene.picture);
  settings.width_px = kViewWidth;
  settings.height_px = kViewHeight;
  change(scene, settings);
  const Result<Tracer> tracer = Tracer::build(scene.spheres, Engine::wide);
  const Result<Rendered> picture = render(scene, *tracer, settings);
  PngPixels pixels = png_pixels_from_film(picture->film, scene.picture.transfer, 8);
  EXPECT_TRUE(check_labels(scene, settings));
  draw_labels(pixels, scene, settings);
  return picture_hash(Image{pixels.width, pixels.height, pixels.bytes});
}

struct EffectCase {
  std::string name;
  std::function<void(ViewerSettings&)> choose;
  std::function<void(Scene&, RenderSettings&)> as_rendered;
};

TEST(ViewerLook, every_effect_is_the_programs) {
  const std::vector<EffectCase> cases{
      {"no ao", [](ViewerSettings& s) { s.picture.user.set("ao", false); },
       [](Scene&, RenderSettings& r) { r.ambient_occlusion.reset(); }},
      {"ao",
       [](ViewerSettings& s) {
         s.picture.user.set("ao_distance", 3);
         s.picture.user.set("ao_directions", 20);
       },
       [](Scene&, RenderSettings& r) {
         r.ambient_occlusion = AmbientOcclusion{3, 20};
       }},
      {"light points", [](ViewerSettings& s) { s.picture.user.set("light_points", 3); },
       [](Scene&, RenderSettings& r) { r.light_points = 3; }},
      {"samples", [](ViewerSettings& s) { s.picture.user.set("samples_auto", true); },
       [](Scene&, RenderSettings& r) { r.adaptive_samples = true; }},
      {"fog", [](ViewerSettings& s) { s.picture.user.set("fog", 0.8); },
       [](Scene&, RenderSettings& r) {
         r.fog = r.fog.value_or(Fog{});
         r.fog->strength = 0.8;
       }},
      {"outline", [](ViewerSettings& s) { s.picture.user.set("outline_px", 2); },
       [](Scene&, RenderSettings& r) {
         r.outline = r.outline.value_or(Outline{});
         r.outline->width_px = 2;
       }},
      {"tone",
       [](ViewerSettings& s) {
         s.picture.user.set("exposure", 0.5);
         s.picture.user.set("tone", 2);
       },
       [](Scene&, RenderSettings& r) {
         r.tone = {0.5, ToneCurve::filmic};
       }},
      {"lens",
       [](ViewerSettings& s) {
         s.camera.aperture = 3;
         s.camera.focus = 60;
       },
       [](Scene& scene, RenderSettings& r) {
         use_lens_samples(r);
         scene.camera.aperture = 3;
         scene.camera.focus = 60;
       }},
      {"focus on a selection",
       [](ViewerSettings& s) {
         s.camera.aperture = 3;
         s.focus_on = "resname 478";
       },
       [](Scene& scene, RenderSettings& r) {
         use_lens_samples(r);
         scene.camera.aperture = 3;
         scene.camera.focus = *focus_on(scene.spheres, scene.camera, "resname 478");
       }},
      {"labels",
       [](ViewerSettings& s) {
         for (const char* label : {"legend", "axes"}) s.picture.user.set(label, true);
         s.picture.user.set("title", std::string("HIV-1"));
       },
       [](Scene&, RenderSettings& r) {
         r.labels = {true, false, true, "HIV-1", std::nullopt};
         r.fog.reset();
       }},
      {"scale bar",
       [](ViewerSettings& s) {
         s.camera = with_projection(s.camera, Projection::orthographic);
         s.picture.user.set("scale_bar", true);
         s.picture.user.set("length_unit", std::string("nm"));
       },
       [](Scene&, RenderSettings& r) {
         r.labels.scale_bar = true;
         r.labels.length_unit = "nm";
       }},
  };
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  const ViewerSettings first = viewer.settings();
  const std::uint64_t plain = shown(viewer);
  for (const EffectCase& one : cases) {
    ViewerSettings settings = first;
    one.choose(settings);
    const Status set = viewer.set(settings);
    ASSERT_TRUE(set) << one.name << set.error().to_string();
    Camera camera = viewer.settings().camera;
    camera.aperture = camera.focus = 0;
    const std::uint64_t hash = shown(viewer);
    EXPECT_EQ(hash, demo_with(camera, one.as_rendered)) << one.name;
    EXPECT_NE(hash, plain) << one.name;
    // As a file too.
    const Result<PngPixels> saved = viewer.picture(kViewWidth, kViewHeight, samples_at_rest(viewer.settings()));
    ASSERT_TRUE(saved);
    EXPECT_EQ(picture_hash(Image{saved->width, saved->height, saved->bytes}), hash) << one.name;
    viewer.look_from(ViewFrom::front);
    ASSERT_TRUE(viewer.set(first)) << one.name;
  }
  EXPECT_EQ(shown(viewer), plain) << "all of it goes again";
}

TEST(ViewerLook, a_floor_lies_below_what_is_left) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  const std::uint64_t plain = shown(viewer);
  const Camera camera = viewer.settings().camera;
  const std::optional<Vec3d> blue = *colour_from_text("#3366cc", Transfer::srgb);
  struct Case {
    ViewerLook look;
    std::optional<Vec3d> colour;
    Vec3d up;
  };
  std::vector<Case> cases(3);
  cases[0] = {{}, std::nullopt, {0, 1, 0}};
  cases[0].look.floor = kFloorOfShadows;
  cases[1] = {{}, blue, {0, 1, 0}};
  cases[1].look.floor = "#3366cc";
  cases[2] = {cases[1].look, blue, {0, 0, 1}};
  cases[2].look.floor_up = {0, 0, 5};
  std::set<std::uint64_t> hashes{plain};
  for (const Case& one : cases) {
    ASSERT_TRUE(viewer.set_look(one.look));
    const std::uint64_t with_floor = shown(viewer);
    EXPECT_TRUE(hashes.insert(with_floor).second) << one.look.floor;
    EXPECT_EQ(with_floor, demo_with(camera,
                                    [&](Scene& scene, RenderSettings&) {
                                      scene.plane = floor_in(plane_below(scene, one.up), one.colour, scene);
                                    }))
        << one.look.floor;
  }
  ViewerLook bad;
  bad.floor = "shadows";
  const auto refused = viewer.set_look(bad);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().to_string(), HasSubstr("floor: "));
  EXPECT_THAT(refused.error().to_string(), HasSubstr("or \"shadow\""));
  ASSERT_TRUE(viewer.set_look({}));
  EXPECT_EQ(shown(viewer), plain);

  // Beside a plane of the scene's own.
  ASSERT_TRUE(viewer.load_built_in("scenario1"));
  bad.floor = kFloorOfShadows;
  const auto twice = viewer.set_look(bad);
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().to_string(), HasSubstr("plane of its own"));
}

TEST(ViewerLook, lights_colours_and_creases_of_all_spheres) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  ViewerLook look;
  look.lights = {"cloudy", "from:1,0,0:orange:0.5:10"};
  ASSERT_TRUE(viewer.set_look(look));
  const Camera camera = viewer.settings().camera;
  LightChoice choice;
  for (const std::string& text : look.lights) ASSERT_TRUE(add_light(text, choice));
  EXPECT_EQ(shown(viewer), demo_with(camera, [&](Scene& scene, RenderSettings&) {
              const LightRig rig = rig_of(choice, scene.ambient_light);
              scene.lights = lights_around(rig, scene.camera);
              scene.ambient_light = rig.ambient_light;
            }));

  // A scene file's own lights give way, and come back.
  const std::string lit = R"({"bihive_scene": 1, "camera": {"eye": [0, 0, 9], "look_at": [0, 0, 0]},
      "lights": [{"position": [9, 9, 9]}], "spheres": [[0, 0, 0, 1]]})";
  ASSERT_TRUE(viewer.load(lit, "lit.json"));
  const std::uint64_t own = shown(viewer);
  ViewerLook other;
  other.lights = {"headlight"};
  ASSERT_TRUE(viewer.set_look(other));
  EXPECT_NE(shown(viewer), own);
  ASSERT_TRUE(viewer.set_look({}));
  EXPECT_EQ(shown(viewer), own);

  // Colours by an attribute before the rows, and one colour of unknown numbers for all.
  constexpr const char* kUnknown = "x,y,z,r,charge\n0,0,0,1,-1\n2.5,0,0,1,nan\n0,2.5,1,1,1\n";
  ASSERT_TRUE(viewer.load(kUnknown, "unknown.csv"));
  ViewerLook by;
  by.colour_by = "charge:magma:-2,2";
  by.nan_colour = "lime";
  by.crease = "charge";
  by.rows = {{"index 2", "colour", "red"}};
  Result<std::vector<std::int64_t>> counts = viewer.set_look(by);
  ASSERT_FALSE(counts);
  by.nan_colour = "magenta";
  counts = viewer.set_look(by);
  ASSERT_TRUE(counts) << counts.error().to_string();
  EXPECT_THAT(*counts, ElementsAre(1)) << "of the rows alone";
  const Style style = *style_named("default");
  Look all{"all", {*look_action_from_text("crease", "charge"), *look_action_from_text("colour-by", by.colour_by)}};
  std::get<ColourBy>(all.actions[1]).nan_colour = *colour_choice_from_text("magenta");
  EXPECT_EQ(shown(viewer), rendered(*load_scene(kUnknown, "unknown.csv", {}, LooksOfFile::keep, &style),
                                    viewer.settings().camera, {all, look_of("index 2", "colour", "red")}));

  const auto refused = [&](const ViewerLook& bad) {
    std::size_t row = 7;
    const auto answer = viewer.set_look(bad, &row);
    EXPECT_EQ(row, bad.rows.size()) << "no row is to blame";
    EXPECT_EQ(viewer.look(), by);
    return answer ? std::string("no error") : answer.error().to_string();
  };
  ViewerLook bad;
  bad.lights = {"candle"};
  EXPECT_THAT(refused(bad), HasSubstr("light: expected one of thesis, studio"));
  bad = {};
  bad.colour_by = "mass";
  EXPECT_THAT(refused(bad), HasSubstr("mass"));
  bad.colour_by = "charge:rainbow";
  EXPECT_THAT(refused(bad), HasSubstr("rainbow"));
  bad = {};
  bad.crease = "mass";
  EXPECT_THAT(refused(bad), HasSubstr("mass"));
}

TEST(ViewerLook, effects_follow_the_style_unless_they_were_changed) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  EXPECT_TRUE(viewer.settings().picture.result().ambient_occlusion.has_value()) << "of the style default";
  ViewerSettings settings = viewer.settings();
  settings.picture.user.set("fog", 0.25);
  ASSERT_TRUE(viewer.set(settings));
  ViewerLook look;
  look.style = "illustrative";
  ASSERT_TRUE(viewer.set_look(look));
  const PictureSettings style = style_named("illustrative")->picture;
  EXPECT_EQ(viewer.settings().picture.result().ambient_occlusion.has_value(), style.ambient_occlusion.has_value());
  EXPECT_EQ(viewer.settings().picture.result().outline->width_px, style.outline->width_px);
  EXPECT_EQ(viewer.settings().picture.result().fog->strength, 0.25) << "the user's";

  // Those of a scene file are shown, and kept by a change of something else.
  const std::string document = R"({"bihive_scene": 2, "camera": {"eye": [0, 0, 9], "look_at": [0, 0, 0]},
      "picture": {"ambient_occlusion": {"distance": 2, "directions": 12}, "fog": {"strength": 0.75, "start": 0.5},
                  "outline": {"width_px": 3}}, "spheres": [[0, 0, 0, 1], [1, 0, -3, 1]]})";
  ASSERT_TRUE(viewer.load(document, "a.json"));
  settings = viewer.settings();
  EXPECT_EQ(settings.picture.result().ambient_occlusion->distance, 2);
  EXPECT_EQ(settings.picture.result().ambient_occlusion->directions, 12);
  EXPECT_EQ(settings.picture.result().fog->strength, 0.75);
  EXPECT_EQ(settings.picture.result().outline->width_px, 3);
  settings.picture.user.set("outline_px", 2);
  ASSERT_TRUE(viewer.set(settings));
  LoadedScene file = *load_scene(document, "a.json", {}, LooksOfFile::keep);
  file.scene.picture.outline->width_px = 2;
  EXPECT_EQ(shown(viewer), rendered(std::move(file), viewer.settings().camera));
}

TEST(ViewerLook, labels_that_a_picture_cannot_have) {
  Viewer viewer;
  viewer.resize(kViewWidth, kViewHeight);
  ASSERT_TRUE(viewer.load_built_in("four-spheres"));
  const std::uint64_t without = shown(viewer);
  ViewerSettings settings = viewer.settings();
  settings.picture.user.set("scale_bar", true);
  Status refused = viewer.set(settings);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().to_string(), HasSubstr("orthographic"));
  settings = viewer.settings();
  settings.picture.user.set("legend", true);
  refused = viewer.set(settings);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().to_string(), HasSubstr("legend"));
  EXPECT_FALSE(viewer.settings().picture.result().labels.legend);

  // A scale bar in parallel rays; it is left out in perspective, and comes back.
  settings = viewer.settings();
  settings.picture.user.set("scale_bar", true);
  settings.camera = with_projection(settings.camera, Projection::orthographic);
  ASSERT_TRUE(viewer.set(settings));
  settings = viewer.settings();
  settings.camera = with_projection(settings.camera, Projection::perspective);
  ASSERT_TRUE(viewer.set(settings));
  EXPECT_TRUE(viewer.settings().picture.result().labels.scale_bar);
  EXPECT_EQ(shown(viewer), without);

  settings.camera.aperture = 1;
  settings.picture.user.set("samples_auto", true);
  refused = viewer.set(settings);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().to_string(), HasSubstr("give a number: samples 64"));
  settings.picture.user.set("samples_auto", false);
  settings.focus_on = "chain Q";
  EXPECT_FALSE(viewer.set(settings));
}

// Labels stay as they are while the picture under them is coarse.
TEST(ViewerLook, labels_are_sharp_in_coarse_pictures) {
  Viewer viewer;
  viewer.resize(400, 800);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  ViewerSettings settings = viewer.settings();
  settings.picture.user.set("title", std::string("a title"));
  ASSERT_TRUE(viewer.set(settings));
  FrameReport report;
  for (int i = 0; i < 1000 && !report.drawn; ++i) report = *viewer.frame(1e-3);
  ASSERT_TRUE(report.drawn);
  EXPECT_GT(report.divisor, 1);
  EXPECT_EQ(viewer.image().width, 400);
  const auto top = [&] {
    return std::vector<std::uint8_t>(viewer.image().rgb.begin(), viewer.image().rgb.begin() + 400 * 3 * 60);
  };
  const std::vector<std::uint8_t> coarse = top();
  settle_look(viewer);
  EXPECT_TRUE(top() == coarse) << "above the molecule there is the title alone";
  settings.picture.user.reset("title");
  ASSERT_TRUE(viewer.set(settings));
  settle_look(viewer);
  EXPECT_FALSE(top() == coarse) << "the title was there";
}

}  // namespace
}  // namespace bihive
