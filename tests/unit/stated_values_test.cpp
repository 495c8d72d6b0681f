// The thesis's stated values: what a file may hold, and what is said where it does not.
// ctest: asan-long
#include "bihive/thesis/stated_values.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace bihive {
namespace {

Result<StatedValues> with(const std::string& entries) {
  return StatedValues::parse("{\"values\": {" + entries + "}}", "file.json");
}

std::string message_of(const Result<StatedValues>& values) {
  return values ? "none" : values.error().to_string();
}

TEST(StatedValues, GivesNumbersListsAndPrint) {
  const auto values = with(R"("a": {"value": 4095, "kind": "stated", "printed": "4,095", "sentence": "s"},
                              "b": {"value": [1, 2.5], "kind": "inferred", "sentence": ""},
                              "c": {"value": 7, "kind": "own_check", "printed": "8%", "sentence": ""},
                              "d": {"value": 0, "kind": "set", "printed": "did not vary", "sentence": ""},
                              "f": {"value": "only rises", "kind": "fitted", "sentence": "", "claim": "it rises"})");
  ASSERT_TRUE(values) << message_of(values);
  EXPECT_EQ(values->number("a").value(), 4095);
  EXPECT_EQ(values->integer("a").value(), 4095);
  EXPECT_EQ(values->integers("a").value(), std::vector<std::int64_t>{4095});
  EXPECT_EQ(values->numbers("b").value(), (std::vector<double>{1, 2.5}));
  EXPECT_EQ(values->printed("a").value(), "4,095");
  EXPECT_EQ(values->printed("b").value(), "[1,2.5]");
  EXPECT_EQ(values->printed("c").value(), "7") << "what is printed is out of date";
  EXPECT_EQ(values->printed("d").value(), "did not vary");
  EXPECT_FALSE(values->has("e"));
  EXPECT_EQ(values->printed("f").value(), "only rises");
  EXPECT_EQ(values->numbers("f").error().to_string(), "file.json: /values/f/value: expected numbers");
}

TEST(StatedValues, SaysWhatIsWrongWithAFile) {
  EXPECT_EQ(message_of(StatedValues::parse("{", "file.json")), "file.json: it is not valid JSON");
  EXPECT_EQ(message_of(StatedValues::parse("[]", "file.json")),
            "file.json: /values: expected an object with one entry per value");
  EXPECT_EQ(message_of(with(R"("a": {"value": {}, "sentence": ""})")),
            "file.json: /values/a/value: expected a number, a list of numbers, or a text");
  EXPECT_EQ(message_of(with(R"("a": {"value": 1})")),
            "file.json: /values/a/sentence: expected the sentence that it comes from");
  const std::string kinds =
      R"(file.json: /values/a/kind: expected "stated", "set", "fitted", "inferred" or "own_check")";
  EXPECT_EQ(message_of(with(R"("a": {"value": 1, "sentence": ""})")), kinds) << "nothing is the thesis's by default";
  EXPECT_EQ(message_of(with(R"("a": {"value": 1, "kind": "chosen", "sentence": ""})")), kinds);
  EXPECT_EQ(message_of(with(R"("a": {"value": 1, "kind": 1, "sentence": ""})")), kinds);
}

TEST(StatedValues, SaysWhatIsWrongWithAValue) {
  const auto values = with(R"("list": {"value": [1, 2.5], "kind": "stated", "sentence": ""},
                              "half": {"value": 0.5, "kind": "stated", "sentence": ""})");
  ASSERT_TRUE(values) << message_of(values);
  EXPECT_EQ(values->number("gone").error().to_string(), "file.json: /values/gone: expected a value of this name");
  EXPECT_EQ(values->number("list").error().to_string(), "file.json: /values/list/value: expected one number");
  EXPECT_EQ(values->integer("half").error().to_string(), "file.json: /values/half/value: expected a whole number");
  EXPECT_EQ(values->integers("list").error().to_string(), "file.json: /values/list: expected whole numbers");
}

TEST(StatedValues, BuiltinOnesSayWhoseTheyAre) {
  const std::string_view texts[] = {
      builtin_values_figure_4_1(), builtin_values_figure_4_2(), builtin_values_figure_4_3(), builtin_values_table_4_2(),
      builtin_values_figure_4_4(), builtin_values_figure_4_5(), builtin_values_section_d()};
  const auto kinds_of = [](std::string_view text) {
    const auto values = StatedValues::parse(text, "values.json");
    EXPECT_TRUE(values) << message_of(values);
    std::map<std::string, std::string> kinds;
    const auto document = nlohmann::json::parse(values->text());
    for (const auto& [name, entry] : document["values"].items()) kinds[name] = entry["kind"];
    return kinds;
  };
  for (const std::string_view text : texts)
    for (const auto& [name, kind] : kinds_of(text))
      if (name == "width_px" || name == "height_px") {
        EXPECT_EQ(kind, "inferred");
      }
  const auto memory = kinds_of(builtin_values_figure_4_5());
  EXPECT_EQ(memory.at("node_bytes"), "inferred");
  EXPECT_EQ(memory.at("wrong_trees"), "own_check");
  EXPECT_EQ(memory.at("radius"), "set");
}

}  // namespace
}  // namespace bihive
