// Frames shown a second: what is drawn, what counts, and what is written. The clock is the test's own.
// ctest: asan-long
#include "bihive/thesis/shown_frames.h"

#include <gtest/gtest.h>

#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "bihive/image/image.h"

namespace bihive {
namespace {

ShownFramesPlan few_frames() {
  ShownFramesPlan plan;
  plan.scenarios = {1, 3};
  plan.spheres = {64};
  plan.max_prims = {8};
  plan.width_px = 48;
  plan.height_px = 27;
  plan.threads = 1;
  plan.seconds = 1;
  return plan;
}

TEST(ShownFrames, AreTheThesis) {
  const Result<StatedValues> values = StatedValues::parse(builtin_values_figure_4_4(), "values.json");
  ASSERT_TRUE(values);
  const Result<ShownFramesPlan> plan = ShownFramesPlan::from_values(*values);
  ASSERT_TRUE(plan) << plan.error().to_string();
  EXPECT_EQ(plan->width_px, 1136);
  EXPECT_EQ(plan->height_px, 640);
  EXPECT_EQ(plan->max_prims, std::vector<std::int64_t>{8});
  EXPECT_EQ(plan->recursion, 1);
  // Nine configurations, two engines, at rest and turning.
  EXPECT_EQ(ShownFrames(*plan).rates().size(), 9u * 2 * 2);
}

// A screen of 50 frames a second.
TEST(ShownFrames, CountsWhatIsShownAfterTheWarmUp) {
  ShownFrames frames(few_frames());
  ASSERT_EQ(frames.rates().size(), 2u * 2 * 2);
  double now_ms = 1000;
  int shown = 0;
  for (; !frames.finished(); ++shown) {
    ASSERT_LT(shown, 10000);
    const Result<const Image*> image = frames.draw();
    ASSERT_TRUE(image) << image.error().to_string();
    ASSERT_EQ((*image)->rgb.size(), 3u * 48 * 27);
    now_ms += 20;
    frames.shown(now_ms);
  }
  // 16 frames warm up: the first and those of 300 ms after it. 50 count.
  EXPECT_EQ(shown, 8 * (16 + 50));
  for (const ShownRate& rate : frames.rates()) {
    EXPECT_EQ(rate.frames, 50);
    EXPECT_DOUBLE_EQ(rate.fps(), 50);
  }
  const auto report = nlohmann::json::parse(frames.json("window", "a device"));
  EXPECT_EQ(report["complete"], true);
  EXPECT_EQ(report["by"], "window");
  ASSERT_EQ(report["configurations"].size(), 8u);
  EXPECT_TRUE(report["configurations"][0]["max_prims"].is_null());
  EXPECT_EQ(report["configurations"][3]["max_prims"], 8);
  EXPECT_EQ(report["configurations"][3]["turning"], true);
  EXPECT_EQ(report["configurations"][7]["scenario"], 3);
  EXPECT_EQ(report["configurations"][7]["fps"], 50.0);
}

// A short measurement warms up no longer than it lasts.
TEST(ShownFrames, WarmUpInNoLongerThanTheyAreMeasured) {
  ShownFramesPlan plan = few_frames();
  plan.seconds = 0.1;
  ShownFrames frames(plan);
  double now_ms = 1000;
  int shown = 0;
  for (; !frames.finished(); ++shown) {
    ASSERT_LT(shown, 1000);
    ASSERT_TRUE(frames.draw());
    frames.shown(now_ms += 20);
  }
  EXPECT_EQ(shown, 8 * (6 + 5));
}

// At rest every frame is the same picture; turning, they differ; both engines draw the same first picture.
TEST(ShownFrames, TurnOnceAround) {
  ShownFrames frames(few_frames());
  double now_ms = 0;
  std::map<std::size_t, std::vector<std::uint64_t>> pictures;
  while (!frames.finished()) {
    const std::size_t current = frames.measured();
    const Result<const Image*> image = frames.draw();
    ASSERT_TRUE(image);
    pictures[current].push_back(picture_hash(**image));
    now_ms += 125;
    frames.shown(now_ms);
  }
  ASSERT_EQ(pictures.size(), 8u);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(pictures[i].front(), pictures[i / 4 * 4].front()) << i;
    const std::set<std::uint64_t> different(pictures[i].begin(), pictures[i].end());
    if (i % 2 == 0)
      EXPECT_EQ(different.size(), 1u) << i;
    else
      EXPECT_GE(different.size(), 5u) << i;
  }
  EXPECT_EQ(pictures[1], pictures[3]) << "the text's tree and the wide engine draw the same pictures";
}

TEST(ShownFrames, EndWithAnError) {
  ShownFramesPlan plan = few_frames();
  plan.scenarios = {4};
  ShownFrames frames(plan);
  EXPECT_FALSE(frames.draw());
  EXPECT_TRUE(frames.finished());
  EXPECT_EQ(nlohmann::json::parse(frames.json("page", "d"))["complete"], false);
}

}  // namespace
}  // namespace bihive
