// Which options of `bihive render` work with distributed spheres.
// ctest: needs bihive_commands
#include "commands/distributed_options.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace bihive::cli {
namespace {

RenderOptions given(std::vector<std::string> names) {
  RenderOptions options;
  for (std::string& name : names) options.given.push_back({std::move(name), ""});
  return options;
}

TEST(DistributedOptions, OneThatNobodyAddedToTheTableIsRefusedByName) {
  const Result<ReadingByRanks> reading = reading_by_ranks(given({"size", "brand_new", "fog"}));
  ASSERT_FALSE(reading);
  EXPECT_NE(reading.error().message.find("brand_new"), std::string::npos) << reading.error().message;
}

TEST(DistributedOptions, ThoseThatLookAtCentresAndRadiiTakeChunks) {
  EXPECT_EQ(reading_by_ranks(given({})).value(), ReadingByRanks::chunks);
  EXPECT_EQ(reading_by_ranks(given({"fog", "no_shadows", "outline", "radius"})).value(), ReadingByRanks::chunks);
}

TEST(DistributedOptions, OneThatLooksAtMoreNeedsTheWholeSet) {
  for (const char* const name : {"select", "columns", "legend", "replicate", "cell"})
    EXPECT_EQ(reading_by_ranks(given({"fog", name, "radius"})).value(), ReadingByRanks::whole) << name;
}

TEST(DistributedOptions, SomeDependOnTheirValue) {
  RenderOptions options = given({"frame", "focus"});
  options.input.reading.set_frame(0);
  options.focus = 2.5;
  EXPECT_EQ(reading_by_ranks(options).value(), ReadingByRanks::chunks);
  options.focus = "chain A";
  EXPECT_EQ(reading_by_ranks(options).value(), ReadingByRanks::whole);
  options.focus.reset();
  options.look_at = Vec3d{1, 2, 3};
  EXPECT_EQ(reading_by_ranks(options).value(), ReadingByRanks::chunks);
  options.look_at = "chain A";
  EXPECT_EQ(reading_by_ranks(options).value(), ReadingByRanks::whole);
  options.look_at.reset();
  options.view_of = ViewOfSpheres{};
  EXPECT_EQ(reading_by_ranks(options).value(), ReadingByRanks::whole);
  options.view_of.reset();
  options.input.reading.set_frame(1);
  EXPECT_EQ(reading_by_ranks(options).value(), ReadingByRanks::whole);
  RenderOptions of_film = given({});
  of_film.film = "run.mp4.json";
  EXPECT_EQ(reading_by_ranks(of_film).value(), ReadingByRanks::whole);
}

}  // namespace
}  // namespace bihive::cli
