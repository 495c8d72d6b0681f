// What is shown is measured as measure_union() does, without what is hidden or not selected.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "bihive/measure/union_measures.h"
#include "bihive/select/selection.h"
#include "bihive/viewer/shown_measures.h"
#include "bihive/viewer/viewer.h"

namespace bihive {
namespace {

using Numbers = nlohmann::json;

Numbers measures_shown(const Viewer& viewer, const std::string& selection, double probe) {
  const Result<std::string> text = shown_measures_to_json(viewer.scene(), viewer.input_spheres(), selection, probe);
  EXPECT_TRUE(text.ok());
  return text ? Numbers::parse(*text) : Numbers();
}

void expect_measures_of(const Numbers& shown, const Viewer& viewer, const std::string& selection, double probe) {
  const std::vector<std::uint8_t> mask = select_spheres(viewer.input_spheres(), selection).value();
  MeasureOptions options;
  options.mask = mask.data();
  options.probe = probe;
  options.cavities = true;
  const UnionMeasures expected = measure_union(viewer.input_spheres(), options).value();
  EXPECT_EQ(shown["area"], expected.area);
  EXPECT_EQ(shown["volume"], expected.volume);
  EXPECT_EQ(shown["components"], expected.components);
  EXPECT_EQ(shown["cavities"].size(), expected.cavities.size());
  EXPECT_EQ(shown["undecided_spheres"], 0);
}

TEST(ShownMeasures, AreThoseOfTheUnion) {
  Viewer viewer;
  ASSERT_TRUE(viewer.load_built_in("demo").ok());
  const Numbers all = measures_shown(viewer, "", 1.4);
  EXPECT_EQ(all["spheres"], 1631);
  EXPECT_GT(all["cavities"].size(), 0u);
  expect_measures_of(all, viewer, "all", 1.4);
  expect_measures_of(measures_shown(viewer, "chain A", 0), viewer, "chain A", 0);
}

TEST(ShownMeasures, LeaveOutWhatIsHidden) {
  Viewer viewer;
  ASSERT_TRUE(viewer.load_built_in("demo").ok());
  ViewerLook look = viewer.look();
  look.rows.push_back({"water", "hide", ""});
  ASSERT_TRUE(viewer.set_look(look).ok());
  const Numbers dry = measures_shown(viewer, "", 1.4);
  EXPECT_EQ(dry["spheres"], 1551);
  expect_measures_of(dry, viewer, "not water", 1.4);
  expect_measures_of(measures_shown(viewer, "chain B", 1.4), viewer, "chain B and not water", 1.4);
  // Drawn smaller, measured as read.
  look.rows.push_back({"", "radius-scale", "0.1"});
  ASSERT_TRUE(viewer.set_look(look).ok());
  expect_measures_of(measures_shown(viewer, "", 1.4), viewer, "not water", 1.4);
}

TEST(ShownMeasures, SayWhatIsWrong) {
  Viewer viewer;
  ASSERT_TRUE(viewer.load_built_in("demo").ok());
  const auto error = [&](const char* selection, double probe) {
    const Result<std::string> text = shown_measures_to_json(viewer.scene(), viewer.input_spheres(), selection, probe);
    return text ? std::string() : text.error().message;
  };
  EXPECT_THAT(error("resname ZZZ", 1), testing::HasSubstr("nothing to measure"));
  EXPECT_THAT(error("resname (", 1), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(error("", -1), testing::HasSubstr("at least 0"));
}

}  // namespace
}  // namespace bihive
