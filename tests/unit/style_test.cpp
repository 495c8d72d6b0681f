// Styles: the shipped ones, files of users, and what a style does to a scene.
#include "bihive/scene/style.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bihive/scene/builtin_styles.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/named_materials.h"

namespace bihive {
namespace {

using ::testing::HasSubstr;

// The program does not ask the schema about its own texts.
TEST(Style, TheProgramsOwnTextsFitTheSchema) {
  for (const std::string_view text : {style_text_default(), style_text_plain(), style_text_illustrative(),
                                      style_text_studio(), style_text_glossy(), style_text_flat(), style_text_xray(),
                                      style_text_density(), style_text_ball_and_stick(), style_text_licorice()}) {
    const Result<Style> style = parse_style(text, "own");
    EXPECT_TRUE(style.ok()) << style.error().to_string();
  }
}

TEST(Style, the_shipped_ones_are_valid_and_say_what_they_are) {
  EXPECT_EQ(style_names().front(), "default");
  for (const std::string& name : style_names()) {
    const Result<Style> style = style_named(name);
    ASSERT_TRUE(style) << name << ": " << style.error().to_string();
    EXPECT_EQ(style->name, name);
    EXPECT_GT(style->description.size(), 10u);
  }
  const Result<Style> unknown = style_named("pretty");
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().to_string(), HasSubstr("there is no style \"pretty\""));
  EXPECT_THAT(style_named("ilustrative").error().hint, HasSubstr("did you mean \"illustrative\"?"));
  EXPECT_THAT(unknown.error().hint, HasSubstr("default, plain, illustrative"));
}

TEST(Style, plain_changes_nothing) {
  const Style plain = style_named("plain").value();
  LoadedScene without = built_in_scene("demo").value();
  without.scene.picture.line_unit = LineUnit::picture;  // of every style
  const LoadedScene with = built_in_scene("demo", {}, {}, &plain).value();
  EXPECT_EQ(scene_to_json(with.scene), scene_to_json(without.scene));
  const Camera camera;
  const std::vector<PointLight> lights = lights_around(plain.lights, camera);
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_EQ(lights[0].position, light_behind(camera).position);
}

TEST(Style, a_file_states_every_part) {
  const Style style =
      parse_style(R"({"bihive_style": 1, "material": {"diffuse": 0.5, "bands": 2, "tint": 0.25, "glow": 0.125},
      "colour": [0.1, 0.2, 0.3], "element_colours": "soft", "background": [0, 0.5, 1], "ambient_light": [1, 2, 3],
      "lights": [{"direction": [0, 2, 0], "colour": [0.5, 0.5, 0.5], "angle_deg": 20}],
      "picture": {"samples_per_pixel": 9, "recursion": 2, "shadows": false, "light_points": 3,
                  "exposure": 0.5, "tone": "soft",
                  "ambient_occlusion": {"distance": 4, "directions": 5},
                  "outline": {"width_px": 2, "step": 1.5, "colour": [1, 0, 0]},
                  "fog": {"start": 0.25, "end": 0.75, "strength": 1}}})",
                  "a.json")
          .value();
  EXPECT_EQ(style.name, "a.json");
  EXPECT_EQ(style.material.diffuse, 0.5);
  EXPECT_EQ(style.material.bands, 2);
  EXPECT_EQ(style.material.tint, 0.25);
  EXPECT_EQ(style.material.glow, 0.125);
  EXPECT_EQ(style.material.colour, (Vec3d{0.1, 0.2, 0.3}));
  EXPECT_EQ(style.element_colours, ElementScheme::soft);
  EXPECT_EQ(style.background, (Vec3d{0, 0.5, 1}));
  EXPECT_EQ(style.lights.ambient_light, (Vec3d{1, 2, 3}));
  EXPECT_FALSE(style.lights.light_behind);
  EXPECT_EQ(style.picture.samples_per_pixel, 9);
  EXPECT_EQ(style.picture.tone.exposure_stops, 0.5);
  EXPECT_EQ(style.picture.tone.curve, ToneCurve::soft);
  EXPECT_EQ(style.picture.recursion, 2);
  EXPECT_FALSE(style.picture.shadows);
  EXPECT_EQ(style.picture.light_points, 3);
  EXPECT_EQ(style.picture.ambient_occlusion->distance, 4);
  EXPECT_EQ(style.picture.outline->step, 1.5);
  EXPECT_EQ(style.picture.fog->end, 0.75);

  // The light stands above the camera that looks along -z, eight times as far away, and fills 20 degrees.
  const std::vector<PointLight> lights = lights_around(style.lights, {{0, 0, 10}, {0, 0, 0}, {0, 1, 0}, 30});
  ASSERT_EQ(lights.size(), 1u);
  EXPECT_NEAR(lights[0].position.y, 80, 1e-9);
  EXPECT_NEAR(lights[0].radius, 80 * 0.17632698, 1e-5);
}

TEST(Style, a_bad_file_is_refused_with_the_place) {
  const auto fault = [](const std::string& text) { return parse_style(text, "a.json").error().to_string(); };
  EXPECT_THAT(fault("{"), HasSubstr("a.json:1:"));
  EXPECT_THAT(fault("{}"), HasSubstr("bihive_style"));
  EXPECT_THAT(fault(R"({"bihive_style": 1, "colur": "red"})"), HasSubstr("unknown key \"colur\""));
  EXPECT_THAT(fault(R"({"bihive_style": 1, "material": "wood"})"), HasSubstr("matte, plastic, metal"));
  EXPECT_THAT(fault(R"({"bihive_style": 1, "lights": [{"direction": [0, 0, 0]}]})"), HasSubstr("/lights"));
  EXPECT_THAT(fault(R"({"bihive_style": 1, "picture": {"fog": {"start": 1, "end": 1}}})"), HasSubstr("/picture/fog"));
  EXPECT_THAT(fault(R"({"bihive_style": 1, "picture": {"outline": {"width_px": 0.5}}})"),
              HasSubstr("/picture/outline/width_px: expected a number from 1 to 16"));
}

TEST(Style, a_scene_file_goes_before_the_style) {
  const Style style = style_named("studio").value();
  const std::string text =
      R"({"bihive_scene": 2, "background": [1, 0, 0], "picture": {"ambient_occlusion": {"directions": 7}}, "spheres": [[0, 0, 0, 1]]})";
  const Scene scene = load_scene(text, "a.json", {}, LooksOfFile::apply, &style)->scene;
  EXPECT_EQ(scene.background, (Vec3d{1, 0, 0}));
  EXPECT_EQ(scene.picture.ambient_occlusion->directions, 7);
  EXPECT_EQ(scene.picture.light_points, style.picture.light_points);
  EXPECT_EQ(scene.materials.front().specular, style.material.specular);
}

TEST(LightPresets, all_give_lights) {
  for (const auto& [name, rig] : light_presets()) EXPECT_FALSE(lights_around(rig, Camera{}).empty()) << name;
}

TEST(NamedMaterials, exist) {
  for (const char* name : {"matte", "plastic", "metal", "glass", "flat", "toon"})
    EXPECT_NE(value_named(named_materials(), name), nullptr) << name;
}

}  // namespace
}  // namespace bihive
