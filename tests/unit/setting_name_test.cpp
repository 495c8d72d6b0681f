#include "bihive/base/setting_name.h"

#include <gtest/gtest.h>

namespace bihive {
namespace {

std::string in_capitals(std::string_view id) {
  return id == "radius" ? "RADIUS" : std::string(id);
}

TEST(SettingName, IsTheIdUntilAProgramSaysOtherwise) {
  EXPECT_EQ(setting_name("radius_scale"), "radius_scale");
  name_settings_by(&in_capitals);
  EXPECT_EQ(setting_name("radius"), "RADIUS");
  name_settings_by([](std::string_view id) { return std::string(id); });
  EXPECT_EQ(setting_name("radius"), "radius");
}

TEST(SettingName, AnOptionHasHyphensAndAnArgumentStays) {
  EXPECT_EQ(option_of_setting("radius_scale"), "--radius-scale");
  EXPECT_EQ(option_of_setting("EXPRESSION"), "EXPRESSION");
  EXPECT_EQ(setting_of_option("--radius-scale"), "radius_scale");
  EXPECT_EQ(setting_of_option("colour-by"), "colour_by");
}

}  // namespace
}  // namespace bihive
