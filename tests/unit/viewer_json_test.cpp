// Settings as JSON: exact in both directions, with clear errors.
#include "bihive/viewer/viewer_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "bihive/bih/tree.h"

namespace bihive {
namespace {

using testing::HasSubstr;

std::string error_of(std::string_view json) {
  const Result<ViewerSettings> settings = settings_from_json(json);
  return settings ? "no error" : settings.error().to_string();
}

TEST(ViewerJson, comes_back_exactly) {
  ViewerSettings settings;
  settings.engine = ViewerEngine::gpu;
  settings.view = View::distance;
  settings.picture.user.set("recursion", 16);
  settings.picture.user.set("samples_per_pixel", 64);
  settings.picture.user.set("shadows", false);
  settings.max_prims = 3;
  settings.max_depth = kUnlimited;
  constexpr double kTiny = std::numeric_limits<double>::denorm_min();
  settings.camera = {{0.1, 1.0 / 3, -1e20}, {kTiny, 1e-20, 3.4028234663852886e38}, {-0.0, 1, 1e-9}, 29.999999999999996};
  settings.camera.projection = Projection::orthographic;
  settings.camera.shorter_side = 1.0 / 3;
  const Result<ViewerSettings> back = settings_from_json(settings_to_json(settings));
  ASSERT_TRUE(back) << back.error().to_string();
  EXPECT_EQ(back->engine, settings.engine);
  EXPECT_EQ(back->view, settings.view);
  const PictureSettings picture = back->picture.result();
  EXPECT_EQ(picture.recursion, 16);
  EXPECT_EQ(picture.samples_per_pixel, 64);
  EXPECT_FALSE(picture.shadows);
  EXPECT_EQ(back->max_prims, settings.max_prims);
  EXPECT_EQ(back->max_depth, settings.max_depth);
  EXPECT_EQ(back->camera.eye, settings.camera.eye);
  EXPECT_EQ(back->camera.look_at, settings.camera.look_at);
  EXPECT_EQ(back->camera.up, settings.camera.up);
  EXPECT_EQ(back->camera.fov_deg, settings.camera.fov_deg);
  EXPECT_EQ(back->camera.projection, Projection::orthographic);
  EXPECT_EQ(back->camera.shorter_side, 1.0 / 3);
  EXPECT_EQ(settings_to_json(*back), settings_to_json(settings));
}

TEST(ViewerJson, effects_and_lens_come_back_exactly) {
  ViewerSettings settings;
  settings.picture.user.set("samples_auto", true);
  settings.picture.user.set("ao", true);
  settings.picture.user.set("ao_distance", 1.0 / 3);
  settings.picture.user.set("ao_directions", 4096);
  settings.picture.user.set("light_points", 1024);
  settings.picture.user.set("opacity_rule", 1);
  settings.picture.user.set("fog", 0.1);
  settings.picture.user.set("outline_px", 1.5);
  settings.picture.user.set("exposure", -32);
  settings.picture.user.set("tone", 2);
  for (const char* label : {"legend", "scale_bar", "axes"}) settings.picture.user.set(label, true);
  settings.picture.user.set("title", std::string("a \"title\" of \u00C5"));
  settings.picture.user.set("length_unit", std::string("nm"));
  settings.focus_on = "resname LIG";
  settings.camera.aperture = 0.7;
  settings.camera.focus = 12.3;
  const Result<ViewerSettings> back = settings_from_json(settings_to_json(settings));
  ASSERT_TRUE(back) << back.error().to_string();
  const PictureSettings picture = back->picture.result();
  EXPECT_TRUE(picture.adaptive_samples);
  ASSERT_TRUE(picture.ambient_occlusion && picture.fog && picture.outline);
  EXPECT_EQ(picture.ambient_occlusion->distance, 1.0 / 3);
  EXPECT_EQ(picture.ambient_occlusion->directions, 4096);
  EXPECT_EQ(picture.light_points, 1024);
  EXPECT_EQ(picture.opacity_rule, OpacityRule::once);
  EXPECT_EQ(picture.fog->strength, 0.1);
  EXPECT_EQ(picture.outline->width_px, 1.5);
  EXPECT_EQ(picture.tone.exposure_stops, -32);
  EXPECT_EQ(picture.tone.curve, ToneCurve::filmic);
  EXPECT_TRUE(picture.labels.legend && picture.labels.scale_bar && picture.labels.axes);
  EXPECT_EQ(picture.labels.title, "a \"title\" of \u00C5");
  EXPECT_EQ(picture.labels.length_unit, "nm");
  EXPECT_EQ(back->focus_on, "resname LIG");
  EXPECT_EQ(back->camera, settings.camera);

  // No limit of distance, and the input's own unit, are null.
  const Result<ViewerSettings> none = settings_from_json(R"({"ao_distance": null, "length_unit": null})", settings);
  ASSERT_TRUE(none);
  EXPECT_EQ(none->picture.result().ambient_occlusion->distance, std::numeric_limits<double>::infinity());
  EXPECT_EQ(none->picture.result().labels.length_unit, std::nullopt);
  EXPECT_THAT(settings_to_json(*none), HasSubstr("\"ao_distance\":null"));
  EXPECT_THAT(settings_to_json(*none), HasSubstr("\"length_unit\":null"));
  EXPECT_EQ(none->picture.result().fog->strength, 0.1) << "what is left out stays";

  EXPECT_THAT(error_of(R"({"fog": 1.5})"), HasSubstr("/fog: expected a number from 0 to 1, found 1.5"));
  EXPECT_THAT(error_of(R"({"ao_distance": 0})"), HasSubstr("/ao_distance: expected a number above 0, or null"));
  EXPECT_THAT(error_of(R"({"ao_directions": 0})"), HasSubstr("/ao_directions: expected a whole number from 1 to 4096"));
  EXPECT_THAT(error_of(R"({"light_points": 1025})"), HasSubstr("/light_points"));
  EXPECT_THAT(error_of(R"({"outline_px": 17})"), HasSubstr("/outline_px"));
  EXPECT_THAT(error_of(R"({"exposure": "bright"})"), HasSubstr("/exposure: expected a number from -32 to 32"));
  EXPECT_THAT(error_of(R"({"tone": "loud"})"), HasSubstr("/tone: expected one of none, soft, filmic"));
  EXPECT_THAT(error_of(R"({"opacity_rule": 1})"),
              HasSubstr("/opacity_rule: expected one of each_surface, once, first"));
  EXPECT_THAT(error_of(R"({"legend": "on"})"), HasSubstr("/legend: expected true or false"));
  EXPECT_THAT(error_of(R"({"length_unit": 1})"), HasSubstr("/length_unit: expected a text or null"));
  EXPECT_THAT(error_of(R"({"camera": {"aperture": "wide"}})"), HasSubstr("/camera/aperture: expected a number"));
}

// A state names what its user has set; the rest of it is the scene's, which may be another one now.
TEST(ViewerJson, values_of_the_scene_are_not_the_users) {
  ViewerSettings settings;
  settings.picture.below.fog = Fog{};
  settings.picture.user.set("light_points", 8);
  const std::string json = settings_to_json(settings);
  EXPECT_THAT(json, HasSubstr("\"set\":[\"light_points\"]"));
  EXPECT_THAT(json, HasSubstr("\"fog\":0.5"));
  const Result<ViewerSettings> back = settings_from_json(json);
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->picture.user.has("light_points")) << "also where it is as the scene has it";
  EXPECT_FALSE(back->picture.user.has("fog"));
  EXPECT_FALSE(back->picture.result().fog.has_value());
  // A state that is restored takes back what was set after it.
  ViewerSettings later = settings;
  later.picture.user.set("shadows", true);
  const Result<ViewerSettings> restored = settings_from_json(json, later);
  ASSERT_TRUE(restored);
  EXPECT_FALSE(restored->picture.user.has("shadows"));
  EXPECT_TRUE(restored->picture.user.has("light_points"));
  // A change without the list is the user's.
  EXPECT_TRUE(settings_from_json(R"({"fog": 0.5})", settings)->picture.user.has("fog"));
}

TEST(ViewerJson, what_is_left_out_stays) {
  ViewerSettings base;
  base.picture.user.set("recursion", 7);
  base.max_prims = 2;
  base.max_depth = 9;
  const Result<ViewerSettings> some =
      settings_from_json(R"({"view": "id", "max_prims": null, "camera": {"fov_deg": 12}})", base);
  ASSERT_TRUE(some);
  EXPECT_EQ(some->view, View::id);
  EXPECT_EQ(some->picture.result().recursion, 7);
  EXPECT_EQ(some->max_prims, std::nullopt);
  EXPECT_EQ(some->max_depth, 9);
  EXPECT_EQ(some->camera.fov_deg, 12);
  EXPECT_EQ(some->camera.eye, base.camera.eye);
}

TEST(ViewerJson, a_projection_alone_keeps_the_size) {
  ViewerSettings base;
  base.camera = {{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 30};
  const Result<ViewerSettings> changed = settings_from_json(R"({"camera": {"projection": "orthographic"}})", base);
  ASSERT_TRUE(changed);
  EXPECT_EQ(changed->camera, with_projection(base.camera, Projection::orthographic));
  EXPECT_GT(changed->camera.shorter_side, 5);
}

TEST(ViewerJson, looks_come_back) {
  ViewerLook look;
  look.style = "studio";
  look.element_colours = "cpk";
  look.background = "none";
  look.lights = {"studio", "from:-1,1,1::2:20"};
  look.colour_by = "charge:magma:0,1:log";
  look.nan_colour = "#112233";
  look.crease = "chain";
  look.floor = "#ff8800";
  look.floor_up = {0, 0, 2};
  look.rows = {{"chain \"A\"", "colour", "0.1,0.2,0.3"}, {"", "hide", ""}};
  const Result<ViewerLook> back = viewer_look_from_json(viewer_look_to_json(look));
  ASSERT_TRUE(back) << back.error().to_string();
  EXPECT_EQ(*back, look);

  // What is left out stays; rows come as a whole.
  const Result<ViewerLook> some = viewer_look_from_json(R"({"style": "", "rows": [{"action": "show"}]})", look);
  ASSERT_TRUE(some);
  EXPECT_EQ(some->style, "");
  EXPECT_EQ(some->background, "none");
  EXPECT_EQ(some->rows, (std::vector<LookRow>{{"", "show", ""}}));

  const auto look_error = [](std::string_view json) {
    const Result<ViewerLook> bad = viewer_look_from_json(json);
    return bad ? "no error" : bad.error().to_string();
  };
  EXPECT_THAT(look_error("["), HasSubstr("look:1:"));
  EXPECT_THAT(look_error(R"({"style": 1})"), HasSubstr("/style: expected a text, found 1"));
  EXPECT_THAT(look_error(R"({"lights": "studio"})"), HasSubstr("/lights: expected a list of texts, found"));
  EXPECT_THAT(look_error(R"({"lights": [1]})"), HasSubstr("/lights: expected a list of texts, found [1]"));
  EXPECT_THAT(look_error(R"({"floor_up": [1, 2]})"), HasSubstr("/floor_up: expected three numbers, found [1,2]"));
  EXPECT_THAT(look_error(R"({"floor_up": [0, 0, 0]})"), HasSubstr("/floor_up: expected a direction, or null, found"));
  EXPECT_THAT(look_error(R"({"rows": {}})"), HasSubstr("/rows: expected an array"));
  EXPECT_THAT(look_error(R"({"rows": [{}, 5, {}]})"), HasSubstr("/rows/1: expected an object, found 5"));
  EXPECT_THAT(look_error(R"({"rows": [{"select": null}]})"), HasSubstr("/rows/0/select: expected a text"));
  EXPECT_THAT(look_error(R"({"rows": [{"selects": ""}]})"), HasSubstr("/rows/0/\"selects\": unknown key"));
  EXPECT_THAT(look_error(R"({"styles": ""})"), HasSubstr("unknown key; there are style, element_colours"));
}

TEST(ViewerJson, says_what_is_wrong_and_where) {
  EXPECT_THAT(error_of("{"), HasSubstr("settings:1:"));
  EXPECT_THAT(error_of("[]"), HasSubstr("expected an object, found []"));
  EXPECT_THAT(error_of(R"({"recursion": 17})"),
              HasSubstr("/recursion: expected a whole number from 1 to 16, found 17"));
  EXPECT_THAT(error_of(R"({"recursion": 2.0})"), HasSubstr("/recursion: expected a whole number"));
  EXPECT_THAT(error_of(R"({"recursion": 18446744073709551615})"), HasSubstr("/recursion"));
  EXPECT_THAT(error_of(R"({"samples_per_pixel": 65})"),
              HasSubstr("/samples_per_pixel: expected a whole number from 1 to 64"));
  EXPECT_THAT(error_of(R"({"max_prims": 0})"), HasSubstr("/max_prims"));
  EXPECT_THAT(error_of(R"({"max_depth": "deep"})"), HasSubstr("/max_depth"));
  EXPECT_THAT(error_of(R"({"shadows": 1})"), HasSubstr("/shadows: expected true or false, found 1"));
  EXPECT_THAT(error_of(R"({"engine": "tpu"})"), HasSubstr("/engine: expected one of cpu, gpu, found \"tpu\""));
  EXPECT_THAT(error_of(R"({"view": 3})"), HasSubstr("/view: expected one of shaded, "));
  EXPECT_THAT(error_of(R"({"camera": []})"), HasSubstr("/camera: expected an object"));
  EXPECT_THAT(error_of(R"({"camera": {"eye": [1, 2]}})"),
              HasSubstr("/camera/eye: expected three numbers, found [1,2]"));
  EXPECT_THAT(error_of(R"({"camera": {"eye": [1, 2, "3"]}})"), HasSubstr("/camera/eye"));
  EXPECT_THAT(error_of(R"({"camera": {"fov_deg": true}})"),
              HasSubstr("/camera/fov_deg: expected a number, found true"));
  EXPECT_THAT(error_of(R"({"camera": {"fov_deg": 1e999}})"), HasSubstr("settings:1:"));
  EXPECT_THAT(error_of(R"({"camera": {"roll": 1}})"), HasSubstr("/camera/\"roll\": unknown key"));
  EXPECT_THAT(error_of(R"({"recursions": 1})"), HasSubstr("/\"recursions\": unknown key; there are engine, view,"));
  EXPECT_THAT(error_of(R"({"recursion": 1, "recursion": 2})"), HasSubstr("occurs twice"));
}

}  // namespace
}  // namespace bihive
