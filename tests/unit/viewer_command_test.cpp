// "Copy as command": the options of a state, which are those of the table of options.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "bihive/job/picture_options.h"
#include "bihive/scene/generators.h"
#include "bihive/viewer/command_text.h"

namespace bihive {
namespace {

ShownState state() {
  ShownState state;
  state.input = "my file's.pdb";
  state.own_camera = true;
  state.width_px = 800;
  state.height_px = 600;
  return state;
}

// The request that the words after "bihive render INPUT -o OUTPUT" make.
PictureRequest request_of(const ShownState& shown) {
  std::vector<std::string> words = command_words(CommandOf::picture, shown, "out");
  EXPECT_EQ(words[1], "render");
  EXPECT_EQ(words[3], "-o");
  words.erase(words.begin(), words.begin() + 5);
  PictureRequest request;
  take_words(request, words);
  return request;
}

TEST(CommandText, words_are_quoted_where_a_shell_needs_it) {
  EXPECT_EQ(quoted_for_shell("a-b_c=1,2:3/~"), "'a-b_c=1,2:3/~'");
  EXPECT_EQ(quoted_for_shell("a-b_c=1,2:3/x.pdb"), "a-b_c=1,2:3/x.pdb");
  EXPECT_EQ(quoted_for_shell(""), "''");
  EXPECT_EQ(quoted_for_shell("it's"), "'it'\\''s'");
  EXPECT_EQ(command_text(CommandOf::picture, state(), "out"),
            "bihive render 'my file'\\''s.pdb' -o out.png --size 800x600");
  EXPECT_EQ(command_text(CommandOf::window, state(), "out"), "bihive view 'my file'\\''s.pdb'");
  EXPECT_EQ(command_text(CommandOf::page, state(), "out"), "bihive web 'my file'\\''s.pdb' --html out.html");
  EXPECT_EQ(command_text(CommandOf::scene_file, state(), "out"),
            "bihive scene save out.json 'my file'\\''s.pdb' --size 800x600");
}

TEST(CommandText, a_placed_camera_comes_back_bit_for_bit) {
  ShownState shown = state();
  shown.own_camera = false;
  Camera& camera = shown.settings.camera;
  camera.eye = {-0.1, 1.0 / 3, 7e-20};
  camera.look_at = {-1e19, 2, 3};
  camera.up = {0.1, -0.7, 1.0 / 7};
  camera.fov_deg = 29.999999999999996;
  camera.aperture = 0.3;
  camera.focus = 12.5;
  const PictureRequest request = request_of(shown);
  EXPECT_EQ(*request.eye, camera.eye);
  EXPECT_EQ(std::get<Vec3d>(*request.look_at), camera.look_at);
  EXPECT_EQ(*request.up, camera.up);
  EXPECT_EQ(*request.fov_deg, camera.fov_deg);
  EXPECT_EQ(*request.aperture, 0.3);
  EXPECT_EQ(std::get<double>(*request.focus), 12.5);
  shown.settings.focus_on = "resname LIG";
  EXPECT_EQ(std::get<std::string>(*request_of(shown).focus), "resname LIG");
}

TEST(CommandText, settings_and_look_come_back) {
  ShownState shown = state();
  shown.side = "left";
  Overrides& user = shown.settings.picture.user;
  user.set("samples_auto", true);
  user.set("outline_px", 3.5);
  user.set("ao", false);
  user.set("fog", 0.25);
  user.set("tone", std::int64_t{2});
  user.set("title", "-two words");
  user.set("ao_distance", SettingValue());
  shown.settings.view = View::normal;
  shown.settings.max_prims = 8;
  shown.settings.max_depth = kUnlimited;
  shown.settings.replicate = {2, 2, 1};
  ASSERT_TRUE(shown.reading.take("radius_scale", "1.5"));
  ASSERT_TRUE(shown.reading.take("unwrap", ""));
  ASSERT_TRUE(shown.reading.take("replicate", "1x1x3"));
  ViewerLook& look = shown.look;
  look.style = "studio";
  look.background = "none";
  look.lights = {"headlight", "from:-1,1,1::1:20"};
  look.colour_by = "b_factor:magma";
  look.crease = "chain";
  look.rows = {{"chain A", "colour", "red"},
               {"chain A", "opacity", "0.5"},
               {"", "clip", "plane:0,0,1,-3"},
               {"not (water)", "hide", ""}};
  const PictureRequest request = request_of(shown);
  EXPECT_TRUE(request.picture.is_on("samples_auto"));
  EXPECT_EQ(std::get<double>(*request.picture.find("outline_px")), 3.5);
  EXPECT_FALSE(request.picture.is_on("ao"));
  EXPECT_EQ(std::get<double>(*request.picture.find("fog")), 0.25);
  EXPECT_EQ(std::get<std::int64_t>(*request.picture.find("tone")), 2);
  EXPECT_EQ(std::get<std::string>(*request.picture.find("title")), "-two words");
  EXPECT_FALSE(request.picture.has("ao_distance"));
  EXPECT_EQ(request.view, View::normal);
  EXPECT_EQ(request.view_from, ViewFrom::left);
  EXPECT_EQ(*request.tree.max_prims, 8);
  EXPECT_EQ(*request.tree.max_depth, kUnlimited);
  EXPECT_EQ(request.input.reading.options().radius_scale, 1.5);
  EXPECT_TRUE(request.input.reading.has("unwrap"));
  EXPECT_EQ(request.input.reading.options().replicate, (std::array<std::int32_t, 3>{2, 2, 1}));
  EXPECT_EQ(request.style.name, "studio");
  EXPECT_EQ(*request.background, "none");
  EXPECT_EQ(request.style.light_words, look.lights);
  const std::vector<LookRow> rows{{"all", "colour-by", "b_factor:magma"}, {"all", "crease", "chain"},
                                  {"chain A", "colour", "red"},           {"chain A", "opacity", "0.5"},
                                  {"all", "clip", "plane:0,0,1,-3"},      {"not (water)", "hide", ""}};
  EXPECT_EQ(request.looks.rows, rows);
}

}  // namespace
}  // namespace bihive
