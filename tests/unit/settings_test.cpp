// The table of parameters and the layers of settings.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "bihive/settings/overrides.h"
#include "bihive/settings/parameter.h"
#include "bihive/settings/parameter_json.h"
#include "bihive/settings/parameter_text.h"
#include "bihive/settings/picture_report.h"

namespace bihive {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

// A value in range that is not the default.
SettingValue another_value(const Parameter& p) {
  const SettingValue before = p.get(PictureSettings());
  switch (p.kind) {
    case ParameterKind::flag:
      return !std::get<bool>(before);
    case ParameterKind::whole:
      return std::get<std::int64_t>(before) + 1;
    case ParameterKind::number:
      return p.most < 1e9 ? p.most / 2 + 0.25 * p.least : 0.75;
    case ParameterKind::choice:
      return 1 - std::min<std::int64_t>(1, std::get<std::int64_t>(before));
    case ParameterKind::text:
      return std::string("A \"text\"");
    case ParameterKind::colour:
      break;
  }
  return Vec3d{0.25, 0.5, 0.75};
}

// All parameters with other values than the defaults.
PictureSettings all_changed() {
  PictureSettings settings;
  Overrides all;
  for (const Parameter& p : picture_parameters()) {
    const SettingValue value = another_value(p);
    EXPECT_TRUE(fits(p, value)) << p.id;
    all.set(p.id, value);
  }
  all.apply_to(settings);
  return settings;
}

TEST(Parameters, names_are_unique_and_rows_complete) {
  std::set<std::string_view> ids, paths;
  for (const Parameter& p : picture_parameters()) {
    EXPECT_TRUE(ids.insert(p.id).second) << p.id;
    EXPECT_TRUE(p.path.empty() || paths.insert(p.path).second) << p.path;
    EXPECT_FALSE(p.help.empty()) << p.id;
    EXPECT_NE(p.help.back(), '.') << p.id;
    ASSERT_TRUE(p.get != nullptr && p.set != nullptr) << p.id;
    EXPECT_TRUE(fits(p, p.get(PictureSettings()))) << p.id << ": its default is in range";
    const Parameter* const implied = p.implies.empty() ? &p : parameter_named(p.implies);
    ASSERT_NE(implied, nullptr) << p.id;
    EXPECT_LE(implied, &p) << p.id << " stands after what it implies";
    EXPECT_EQ(parameter_named(p.id), &p);
  }
  EXPECT_EQ(parameter_named("outline"), parameter_named("outline_px"));
  EXPECT_EQ(parameter_named("light-points"), nullptr);
}

TEST(Parameters, controls_are_complete) {
  std::size_t controls = 0;
  for (int group = 0; group <= static_cast<int>(ParameterGroup::cell); ++group) {
    int place = -1000;
    for (const Parameter* const p : controls_of(static_cast<ParameterGroup>(group))) {
      ++controls;
      EXPECT_GE(p->place, place) << p->id;
      place = p->place;
      EXPECT_EQ(choice_labels_of(*p).size(), names_of(*p).size()) << p->id;
      if (p->slider_least != p->slider_most) {
        EXPECT_TRUE(p->or_zero || p->slider_least >= p->least) << p->id;
        EXPECT_LE(p->slider_most, p->most) << p->id;
        EXPECT_GT(p->slider_step, 0) << p->id;
      }
      for (const std::string_view flag : {p->only_with, p->replaced_by}) {
        if (flag.empty()) continue;
        ASSERT_NE(parameter_named(flag), nullptr) << p->id;
        EXPECT_EQ(parameter_named(flag)->kind, ParameterKind::flag) << p->id;
      }
      EXPECT_TRUE(p->note.empty() || p->cpu_only || p->needs == ParameterNeeds::orthographic) << p->id;
    }
  }
  EXPECT_GT(controls, 15U);
  EXPECT_EQ(controls_of(ParameterGroup::picture).front()->id, "recursion");
}

TEST(Parameters, each_reaches_its_own_member) {
  const PictureSettings changed = all_changed();
  for (const Parameter& p : picture_parameters()) EXPECT_EQ(p.get(changed), another_value(p)) << p.id;
}

// No row that GPUs do not draw can be ignored by them.
TEST(Parameters, the_first_that_gpus_do_not_draw_is_found) {
  EXPECT_EQ(first_cpu_only(PictureSettings()), nullptr);
  int found = 0;
  for (const Parameter& p : picture_parameters()) {
    PictureSettings settings;
    Overrides one;
    one.set(p.id, another_value(p));
    one.apply_to(settings);
    const Parameter* const first = first_cpu_only(settings);
    if (!p.cpu_only || p.group == ParameterGroup::lines) continue;
    ASSERT_NE(first, nullptr) << p.id;
    EXPECT_EQ(first->id, p.id);
    ++found;
  }
  EXPECT_GE(found, 3);
}

TEST(Parameters, come_back_from_the_picture_of_a_scene_file) {
  const PictureSettings changed = all_changed();
  const std::string text = picture_to_json(changed);
  PictureSettings back;
  take_picture(json::parse(text), back);
  for (const Parameter& p : picture_parameters()) {
    if (!p.path.empty()) {
      EXPECT_EQ(p.get(back), p.get(changed)) << p.id << text;
    }
  }
  EXPECT_EQ(picture_version(changed), 2);
  EXPECT_EQ(picture_version(PictureSettings()), 1);
  EXPECT_EQ(newer_key(json::parse(text), 2), "");
  EXPECT_EQ(newer_key(json::parse(R"({"width_px": 3, "fog": {}})"), 1), "fog");
  EXPECT_EQ(newer_key(json::parse(R"({"samples_per_pixel": "auto"})"), 1), "samples_per_pixel");
}

TEST(Parameters, an_object_of_a_file_replaces_the_styles) {
  PictureSettings settings;
  settings.fog = Fog{0.25, 2, 0.75};
  settings.ambient_occlusion = AmbientOcclusion{3, 5};
  take_picture(json::parse(R"({"fog": {"end": 3}, "ambient_occlusion": {}, "outline": {}})"), settings);
  ASSERT_TRUE(settings.fog && settings.ambient_occlusion && settings.outline);
  EXPECT_EQ(settings.fog->start, 0);
  EXPECT_EQ(settings.fog->end, 3);
  EXPECT_EQ(settings.fog->strength, 0.5);
  EXPECT_EQ(settings.ambient_occlusion->directions, 64);
  EXPECT_EQ(settings.outline->width_px, 1);
}

TEST(Parameters, from_text) {
  const auto value = [](const char* id, const char* text) { return value_from_text(*parameter_named(id), text); };
  EXPECT_EQ(*value("fog", "0.25"), SettingValue(0.25));
  EXPECT_EQ(*value("tone", "filmic"), SettingValue(std::int64_t{2}));
  EXPECT_EQ(*value("shadows", "false"), SettingValue(false));
  EXPECT_EQ(*value("outline_colour", "0.5,0,1"), SettingValue(Vec3d{0.5, 0, 1}));
  EXPECT_EQ(*value("outline_px", "0"), SettingValue(0.0));
  EXPECT_THAT(value("outline_px", "0.5").error().message, HasSubstr("0, or a number from 1 to 16"));
  EXPECT_THAT(value("fog", "nan").error().message, HasSubstr("a number from 0 to 1, found \"nan\""));
  EXPECT_THAT(value("ao_distance", "0").error().message, HasSubstr("a number above 0"));
  EXPECT_THAT(value("ao_distance", "inf").error().message, HasSubstr("a number above 0"));
  EXPECT_THAT(value("light_points", "8.0").error().message, HasSubstr("a whole number from 1 to 1024"));
  EXPECT_THAT(value("tone", "loud").error().message, HasSubstr("one of none, soft, filmic"));
  EXPECT_THAT(value("cell_colour", "1,1,2").error().message, HasSubstr("#rrggbb"));
  EXPECT_THAT(value("cell_colour", "reddish").error().message, HasSubstr("#rrggbb"));
}

TEST(Overrides, what_is_set_is_known) {
  LayeredSettings layers;
  layers.below.fog = Fog{0, 1, 0.5};
  layers.user.set("fog", 0.5);  // as below
  EXPECT_TRUE(layers.user.has("fog"));
  layers.below.fog->strength = 0.75;
  EXPECT_EQ(layers.result().fog->strength, 0.5);
  layers.user.reset("fog");
  EXPECT_EQ(layers.result().fog->strength, 0.75);
}

TEST(Overrides, a_part_switches_on_what_it_belongs_to) {
  Overrides chosen;
  chosen.set("ao_distance", 3);
  PictureSettings settings;
  chosen.apply_to(settings);
  ASSERT_TRUE(settings.ambient_occlusion);
  EXPECT_EQ(settings.ambient_occlusion->distance, 3);
  // The switch itself has the last word, and the part is kept for it.
  LayeredSettings layers;
  layers.user = chosen;
  layers.user.set("ao", false);
  EXPECT_FALSE(layers.result().ambient_occlusion);
  EXPECT_EQ(layers.value(*parameter_named("ao_distance")), SettingValue(3.0));
}

TEST(Overrides, a_number_of_samples_takes_the_place_of_adaptive_ones) {
  LayeredSettings layers;
  layers.below.adaptive_samples = true;
  layers.user.set("samples_per_pixel", 9);
  EXPECT_FALSE(layers.result().adaptive_samples);
  EXPECT_EQ(layers.result().samples_per_pixel, 9);
  layers.user.set("samples_auto", true);
  EXPECT_TRUE(layers.result().adaptive_samples);
}

TEST(Overrides, a_text_that_is_no_colour_is_no_value) {
  EXPECT_FALSE(fits(*parameter_named("outline_colour"), std::string("reddish")));
  EXPECT_TRUE(fits(*parameter_named("outline_colour"), std::string("red")));
}

TEST(Overrides, colours_as_text_count_under_the_transfer) {
  for (const bool srgb : {true, false}) {
    Overrides chosen;
    chosen.set("outline_colour", std::string("#808080"));
    chosen.set("transfer", srgb ? 0 : 1);
    PictureSettings settings;
    chosen.apply_to(settings);
    EXPECT_NEAR(settings.outline->colour.x, srgb ? 0.2158605 : 128.0 / 255, 1e-6);
  }
}

TEST(Reports, say_what_matters) {
  PictureSettings settings;
  EXPECT_THAT(picture_report(settings, {}), Not(HasSubstr("light_points")));
  EXPECT_THAT(picture_report(settings, {true, false}), HasSubstr("\"light_points\":8"));
  settings.opacity_rule = OpacityRule::once;
  EXPECT_THAT(picture_report(settings, {}), Not(HasSubstr("opacity_rule")));
  EXPECT_THAT(picture_report(settings, {false, true}), HasSubstr("\"opacity_rule\":\"once\""));
  settings.ambient_occlusion.emplace();
  EXPECT_THAT(picture_report(settings, {}), HasSubstr("\"ambient_occlusion\":{\"directions\":64}"));
}

}  // namespace
}  // namespace bihive
