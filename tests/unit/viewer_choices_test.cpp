// The lists of the page's controls.
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "bihive/io/reading_settings.h"
#include "bihive/scene/element_colours.h"
#include "bihive/scene/load_scene.h"
#include "bihive/scene/look_text.h"
#include "bihive/scene/names.h"
#include "bihive/viewer/choices.h"

namespace bihive {
namespace {

using Json = nlohmann::json;

Json choices() {
  return Json::parse(choices_to_json());
}

TEST(Choices, every_name_is_one_that_the_library_takes) {
  const Json all = choices();
  for (const Json& one : all["built_ins"]) EXPECT_TRUE(is_built_in_scene(one["name"])) << one;
  for (const Json& one : all["views"]) EXPECT_NE(value_named(kViews, one["name"].get<std::string>()), nullptr) << one;
  for (const Json& name : all["sides"]) EXPECT_NE(value_named(kSides, name.get<std::string>()), nullptr) << name;
  for (const Json& name : all["element_colours"]) EXPECT_TRUE(element_colours_called(name.get<std::string>())) << name;
  for (const Json& name : all["colours"]) EXPECT_TRUE(colour_choice_from_text(name)) << name;
  for (const Json& name : all["materials"]) EXPECT_TRUE(look_action_from_text("material", name)) << name;
  for (const Json& row : all["reading"]) EXPECT_NE(reading_setting(row["id"].get<std::string>()), nullptr) << row;
}

TEST(Choices, whoever_chooses_from_a_list_reads_a_label) {
  const Json all = choices();
  for (const char* list : {"built_ins", "views", "actions", "reading"})
    for (const Json& one : all[list]) EXPECT_FALSE(one["label"].get<std::string>().empty()) << one;
}

TEST(Choices, actions_have_an_example_where_they_have_a_value) {
  const Json all = choices();
  for (const Json& one : all["actions"]) {
    const std::string name = one["name"], value = one["value"], example = one["example"];
    EXPECT_EQ(value.empty(), example.empty()) << name;
    EXPECT_EQ(value.empty(), bool(look_action_from_text(name, "")))
        << name << ": what has a value refuses an empty one";
    const std::string first = example.substr(0, example.find(' '));
    EXPECT_TRUE(first.empty() || look_action_from_text(name, first)) << name << " " << first;
  }
}

TEST(Choices, maps_of_numbers_have_colours) {
  const Json maps = choices()["maps"];
  EXPECT_TRUE(std::all_of(maps.begin(), maps.end() - 1, [](const Json& map) { return map["colours"].size() == 17; }));
  EXPECT_EQ(maps.back(), (Json{{"name", "okabe-ito"}, {"colours", Json::array()}}));
}

}  // namespace
}  // namespace bihive
