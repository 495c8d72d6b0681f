// JSON that is deeper than any document of ours is refused by every parser before a document is made.
#include "bihive/base/json_text.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>

#include "bihive/scene/camera_path.h"
#include "bihive/scene/scene_file.h"
#include "bihive/scene/style.h"
#include "bihive/thesis/frame_rates_report.h"
#include "bihive/thesis/stated_values.h"
#include "bihive/viewer/viewer_json.h"

namespace bihive {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;
using testing::HasSubstr;

std::string nested(int depth) {
  const auto count = static_cast<std::size_t>(depth);
  return std::string(count, '[') + std::string(count, ']');
}

TEST(JsonText, LimitsItsDepth) {
  EXPECT_TRUE(json_from_text<json>(nested(kMostJsonDepth)).ok());
  EXPECT_EQ(json_from_text<json>("[\n " + nested(kMostJsonDepth), "a.json").error().to_string(),
            "a.json:2:" + std::to_string(kMostJsonDepth + 1) + ": arrays and objects lie more than " +
                std::to_string(kMostJsonDepth) + " deep in each other");
  std::string objects;
  for (int i = 0; i <= kMostJsonDepth; ++i) objects += R"({"a":)";
  EXPECT_THAT(json_from_text<ordered_json>(objects).error().message, HasSubstr("deep in each other"));
  EXPECT_EQ(json_from_text<json>("[1", "a.json").error().to_string(), "a.json: it is not valid JSON");
  EXPECT_EQ(json_from_text<ordered_json>(R"({"b": 1, "a": [2]})")->dump(), R"({"b":1,"a":[2]})");
}

TEST(JsonText, BracketsInTextsDoNotCount) {
  const std::string brackets(1000, '[');
  const Result<json> document = json_from_text<json>(R"(["\"\\)" + brackets + R"(\\\"", [], [], {}])");
  ASSERT_TRUE(document.ok()) << document.error().to_string();
  EXPECT_EQ(document->at(0).get<std::string>(), "\"\\" + brackets + "\\\"");
  // One after the other is not deep.
  std::string flat = "[[]";
  for (int i = 0; i < 1000; ++i) flat += ",[]";
  EXPECT_TRUE(json_from_text<json>(flat + "]").ok());
}

TEST(JsonText, EveryParserOfTheLibraryRefusesDepth) {
  const std::string deep = nested(300000);
  const std::string in_object = R"({"keys": )" + deep + R"(, "values": )" + deep + R"(, "bihive_scene": )" + deep + "}";
  for (const std::string& text : {deep, in_object}) {
    const auto fault = [](const auto& result) { return result ? std::string("none") : result.error().message; };
    EXPECT_THAT(fault(parse_scene(text, "a.json", {})), HasSubstr("deep in each other"));
    EXPECT_THAT(fault(parse_style(text, "a.json")), HasSubstr("deep in each other"));
    EXPECT_THAT(fault(parse_camera_keys(text, "a.json")), HasSubstr("deep in each other"));
    EXPECT_THAT(fault(settings_from_json(text, {})), HasSubstr("deep in each other"));
    EXPECT_THAT(fault(viewer_look_from_json(text, {})), HasSubstr("deep in each other"));
    EXPECT_THAT(fault(StatedValues::parse(text, "a.json")), HasSubstr("deep in each other"));
    EXPECT_FALSE(saved_frame_rates(text).has_value());
  }
}

}  // namespace
}  // namespace bihive
