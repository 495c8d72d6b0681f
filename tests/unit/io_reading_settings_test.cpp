#include <gtest/gtest.h>

#include "bihive/io/reading_settings.h"

namespace bihive {
namespace {

TEST(ReadingSettings, EveryRowIsTakenAndReported) {
  const std::vector<std::pair<std::string, std::string>> texts{{"radius", "0.5"},
                                                               {"radius_scale", "2"},
                                                               {"frame", "3"},
                                                               {"trajectory", "a.xtc"},
                                                               {"smooth", "5"},
                                                               {"recenter", ""},
                                                               {"assembly", "1"},
                                                               {"columns", "x=px,r=5"},
                                                               {"replicate", "2x3x1"},
                                                               {"no_periodic", ""},
                                                               {"unwrap", ""},
                                                               {"cell_origin", "1,2,3"},
                                                               {"cell_vectors", "1,0,0,0,2,0,0,0,3"},
                                                               {"exposed_area", "1.4"}};
  GivenReading given;
  for (const auto& [id, text] : texts) EXPECT_TRUE(given.take(id, text).ok()) << id;
  EXPECT_EQ(given.all().size() + 3, reading_settings().size());  // all but wrap, wrap_molecules and periodic
  std::string report;
  for (const auto& [row, text] : given.all()) report += row->value(given.options()) + " ";
  EXPECT_EQ(
      report,
      "0.5 2.0 3 \"a.xtc\" 5 true \"1\" {\"r\":\"5\",\"x\":\"px\"} [2,3,1] [[1.0,0.0,0.0],[0.0,2.0,0.0],[0.0,0.0,3.0]] "
      "[1.0,2.0,3.0] false \"unwrap\" 1.4 ");
  EXPECT_EQ(given.options().wrapping, Wrapping::unwrap);
  EXPECT_EQ(given.options().replicate, (std::array<std::int32_t, 3>{2, 3, 1}));
}

TEST(ReadingSettings, WhatIsGivenIsKnownAlsoWhereItChangesNothing) {
  GivenReading given;
  EXPECT_FALSE(given.has("radius_scale"));
  ASSERT_TRUE(given.take("radius_scale", "1"));
  EXPECT_TRUE(given.has("radius_scale"));
  given.set_frame(4);
  EXPECT_EQ(given.options().frame, 4);
  given.set_frame(0);
  EXPECT_TRUE(given.has("frame"));
  given.set_frame(-1);
  EXPECT_FALSE(given.has("frame"));
  EXPECT_EQ(given.options().frame, 0);
}

TEST(ReadingSettings, ErrorsSayWhatWasExpected) {
  GivenReading given;
  EXPECT_EQ(given.take("radius", "-1").error().message,
            "expected a number from 0 to 3.4028234663852886e+38, found \"-1\"");
  EXPECT_EQ(given.take("frame", "1.5").error().message, "expected a whole number, found \"1.5\"");
  EXPECT_EQ(given.take("smooth", "4").error().message, "expected an odd number, found 4");
  EXPECT_FALSE(given.take("columns", "x"));
  EXPECT_FALSE(given.take("assembly", ""));
  EXPECT_FALSE(given.take("colour", "red"));
  EXPECT_TRUE(given.all().empty());
  ASSERT_TRUE(given.take("wrap", ""));
  EXPECT_EQ(given.take("wrap", "").error().message, "is given more than once");
  EXPECT_EQ(given.take("unwrap", "").error().message, "excludes wrap");
  EXPECT_EQ(given.take("wrap", "molecules").error().message, "excludes wrap");
  GivenReading molecules;
  ASSERT_TRUE(molecules.take("wrap", "molecules"));
  EXPECT_EQ(molecules.options().wrapping, Wrapping::wrap_molecules);
  EXPECT_EQ(molecules.take("unwrap", "").error().message, "excludes wrap_molecules");
}

TEST(ReadingSettings, TravelAsJson) {
  GivenReading given;
  ASSERT_TRUE(given.take("radius", "0.1"));
  ASSERT_TRUE(given.take("wrap", ""));
  const Result<GivenReading> back = reading_from_json(reading_to_json(given));
  ASSERT_TRUE(back.ok()) << back.error().to_string();
  EXPECT_EQ(back->options().radius, 0.1);
  EXPECT_EQ(back->options().wrapping, Wrapping::wrap);
  EXPECT_EQ(back->all().size(), 2u);
  EXPECT_EQ(reading_from_json(R"({"radius": 0.25})")->options().radius, 0.25);
  EXPECT_EQ(reading_from_json(R"({"radius": true})").error().message,
            "radius: expected a number from 0 to 3.4028234663852886e+38, found \"true\"");
  EXPECT_TRUE(reading_from_json(R"({"recenter": true})")->options().recenter);
  EXPECT_EQ(reading_from_json(R"({"recenter": false})").error().message,
            "recenter: expected no value, or true, found \"false\"");
  for (const char* const text : {"", "[]", "{\"radios\": \"1\"}", "{\"frame\": []}"})
    EXPECT_FALSE(reading_from_json(text)) << text;
}

}  // namespace
}  // namespace bihive
