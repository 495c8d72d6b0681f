// Lights by text: bihive render --light.
// ctest: asan-long
#include "bihive/scene/light_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "bihive/image/colour_text.h"
#include "bihive/image/transfer.h"

namespace bihive {
namespace {

using testing::HasSubstr;

LightChoice choice_of(const std::vector<std::string>& texts) {
  LightChoice choice;
  for (const std::string& text : texts) EXPECT_TRUE(add_light(text, choice).ok()) << text;
  return choice;
}

TEST(LightText, lights_around_the_camera_and_in_the_world) {
  const LightChoice choice =
      choice_of({"from:-1,2,0.5", "at:10,-20,30:red:0.5:2", "from:0,0,1:0.5,0.25,1:2:14", "at:1,2,3::4"});
  EXPECT_FALSE(choice.preset);
  ASSERT_EQ(choice.around.size(), 2U);
  EXPECT_EQ(choice.around[0].direction, (Vec3d{-1, 2, 0.5}));
  EXPECT_EQ(choice.around[0].colour, (Vec3d{1, 1, 1}));
  EXPECT_EQ(choice.around[0].angle_deg, 0);
  EXPECT_EQ(choice.around[1].colour, (Vec3d{1, 0.5, 2})) << "numbers are linear, as in --colour";
  EXPECT_EQ(choice.around[1].angle_deg, 14);
  ASSERT_EQ(choice.placed.size(), 2U);
  EXPECT_EQ(choice.placed[0].position, (Vec3d{10, -20, 30}));
  EXPECT_EQ(choice.placed[0].colour, 0.5 * *colour_from_text("red", Transfer::srgb));
  EXPECT_EQ(choice.placed[0].radius, 2);
  EXPECT_EQ(choice.placed[1].colour, (Vec3d{4, 4, 4}));
}

TEST(LightText, a_preset_goes_with_single_lights) {
  const LightChoice choice = choice_of({"from:1,0,0", "studio", "at:0,0,9"});
  const LightRig studio = *value_named(light_presets(), "studio");
  const LightRig rig = rig_of(choice, {9, 9, 9});
  EXPECT_EQ(rig.ambient_light, studio.ambient_light);
  EXPECT_EQ(rig.lights.size(), studio.lights.size() + 1);
  ASSERT_EQ(rig.placed.size(), 1U);

  Camera camera;
  const std::vector<PointLight> lights = lights_around(rig, camera);
  ASSERT_EQ(lights.size(), studio.lights.size() + 2);
  EXPECT_EQ(lights.back().position, (Vec3d{0, 0, 9}));
}

TEST(LightText, single_lights_keep_the_ambient_light) {
  const LightRig rig = rig_of(choice_of({"at:0,0,9"}), {0.25, 0.5, 1});
  EXPECT_EQ(rig.ambient_light, (Vec3d{0.25, 0.5, 1}));
  EXPECT_FALSE(rig.light_behind);
  EXPECT_TRUE(rig.lights.empty());
}

TEST(LightText, what_is_no_light_is_said) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"disco", "studio"},
      {"", "from:RIGHT,UP,TOWARDS"},
      {"at", "at:X,Y,Z"},
      {"at:1,2,3:white:1:2:3", "at:X,Y,Z"},
      {"at:1,2", "three numbers"},
      {"at:1,2,nan", "three numbers"},
      {"at:1,2,3,4", "three numbers"},
      {"at:1,2,3:mauve", "mauve"},
      {"at:1,2,3:white:-1", "a strength from 0"},
      {"at:1,2,3:white:1:-2", "a radius from 0"},
      {"from:0,0,0", "a direction"},
      {"from:0,0,1:white:1:91", "an angle from 0 to 90"},
      {"from:0,0,1:white:x", "a strength"},
  };
  for (const auto& [text, expected] : faults) {
    LightChoice choice;
    const Status status = add_light(text, choice);
    ASSERT_FALSE(status.ok()) << text;
    EXPECT_THAT(status.error().message, HasSubstr(expected)) << text;
    EXPECT_TRUE(choice.empty()) << text;
  }
  LightChoice two = choice_of({"studio"});
  EXPECT_FALSE(add_light("cloudy", two).ok());
}

}  // namespace
}  // namespace bihive
