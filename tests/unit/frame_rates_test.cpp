// The run of Figure 4.4 in steps: the order of the measurements, and their results.
// ctest: asan-long
#include "bihive/thesis/frame_rates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

#include "bihive/thesis/frame_rates_report.h"

namespace bihive {
namespace {

Result<StatedValues> stated_values() {
  return StatedValues::parse(builtin_values_figure_4_4(), "values.json");
}

FrameRatePlan small_plan() {
  FrameRatePlan plan;
  plan.scenarios = {1, 2};
  plan.spheres = {64};
  plan.max_prims = {1, 8};
  plan.width_px = 16;
  plan.height_px = 9;
  plan.rounds = 3;
  plan.least_ms = 0;
  return plan;
}

TEST(FrameRatePlan, IsTheThesis) {
  const Result<FrameRatePlan> plan = FrameRatePlan::from_values(stated_values().value());
  ASSERT_TRUE(plan) << plan.error().to_string();
  EXPECT_EQ(plan->configurations(), 54);
  EXPECT_EQ(plan->spheres, (std::vector<std::int64_t>{64, 128, 256}));
  EXPECT_EQ(plan->width_px, 1136);
  EXPECT_EQ(plan->recursion, 1);
  const FrameRatePlan quick = plan->quickly();
  EXPECT_EQ(quick.width_px, 284);
  EXPECT_EQ(quick.configurations(), 54);
}

TEST(FrameRatePlan, SaysWhichValueIsMissing) {
  const Result<StatedValues> values = StatedValues::parse(
      R"({"values": {"scenarios": {"value": [1], "kind": "stated", "sentence": ""}}})", "values.json");
  ASSERT_TRUE(values) << values.error().to_string();
  const Result<FrameRatePlan> plan = FrameRatePlan::from_values(*values);
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().message.find("spheres_list"), std::string::npos);
}

// 2^32 + 16 pixels are not 16.
TEST(FrameRatePlan, RefusesNumbersThatAreTooLarge) {
  std::string text(builtin_values_figure_4_4());
  const std::string key = "\"width_px\"";
  const std::size_t value = text.find("1136", text.find(key));
  ASSERT_NE(value, std::string::npos);
  for (const char* const wrong : {"4294967312", "65537", "0", "-1"}) {
    const Result<StatedValues> values =
        StatedValues::parse(text.substr(0, value) + wrong + text.substr(value + 4), "values.json");
    ASSERT_TRUE(values) << values.error().to_string();
    const Result<FrameRatePlan> plan = FrameRatePlan::from_values(*values);
    ASSERT_FALSE(plan) << wrong;
    EXPECT_NE(plan.error().message.find("width_px"), std::string::npos);
  }
}

// The blocks of 8 x 4 rays in lockstep, and the rays of the whole picture alone.
TEST(CountedFigure, CountsRaysAloneAndInLockstep) {
  FrameRatePlan plan = small_plan();
  plan.width_px = 64;
  plan.height_px = 36;
  const auto counted = [&](Counting counting) { return counted_figure(plan, 1, nullptr, counting).value(); };
  const FigureWork alone = counted(Counting::each_ray), all = counted(Counting::without_culling);
  const FigureWork by_node = counted(Counting::lockstep_by_node), by_leaf = counted(Counting::lockstep_by_leaf);
  for (const auto& [configuration, trees] : alone)
    for (const auto& [max_prims, one] : trees) {
      const RayWork& every = all.at(configuration).at(max_prims);
      EXPECT_GE(every.inner, one.inner);
      EXPECT_GT(every.tests, one.tests);
      for (const FigureWork* const lockstep : {&by_node, &by_leaf}) {
        const RayWork& block = lockstep->at(configuration).at(max_prims);
        EXPECT_GE(block.inner, one.inner);
        EXPECT_GE(block.leaves, one.leaves);
        EXPECT_GE(block.tests, one.tests);
        EXPECT_LT(block.inner, 32 * one.inner);
      }
    }
  EXPECT_NE(by_node.at({2, 64}).at(1).inner, by_leaf.at({2, 64}).at(1).inner);
}

// One ray for 8 x 4 pixels is a block of one kind: rays that start and go alike have the work of one.
TEST(CountedFigure, EqualRaysInLockstepHaveTheWorkOfOne) {
  FrameRatePlan plan = small_plan();
  plan.width_px = 8;
  plan.height_px = 4;
  plan.fov_deg = 1e-9;
  const FigureWork alone = counted_figure(plan, 1).value();
  for (const Counting counting : {Counting::lockstep_by_node, Counting::lockstep_by_leaf}) {
    const FigureWork block = counted_figure(plan, 1, nullptr, counting).value();
    for (const auto& [configuration, trees] : alone)
      for (const auto& [max_prims, one] : trees) {
        EXPECT_EQ(block.at(configuration).at(max_prims).inner, one.inner);
        EXPECT_EQ(block.at(configuration).at(max_prims).leaves, one.leaves);
        EXPECT_EQ(block.at(configuration).at(max_prims).tests, one.tests);
      }
  }
}

TEST(FrameRateRun, TakesTurnsAndCountsAllButTheFirstRound) {
  FrameRateRun run(small_plan(), {});
  int steps = 0;
  double before = -1;
  for (; !run.finished(); ++steps) {
    EXPECT_GT(run.done(), before);
    before = run.done();
    const Status status = run.step();
    ASSERT_TRUE(status) << status.error().to_string();
  }
  // Two groups of three, four rounds each.
  EXPECT_EQ(steps, 2 * 3 * 4);
  EXPECT_EQ(run.done(), 1);
  EXPECT_NEAR(run.seconds_left(), 0, 1e-9);
  ASSERT_EQ(run.rates().size(), 6u);
  EXPECT_FALSE(run.rates()[3].max_prims);
  EXPECT_EQ(run.rates()[3].scenario, 2);
  EXPECT_EQ(run.rates()[5].max_prims, 8);
  for (const MeasuredRate& rate : run.rates()) {
    EXPECT_EQ(rate.frame_ms.size(), 3u);
    EXPECT_GT(frames_per_second(rate.frame_ms), 0);
  }
}

TEST(FrameRateRun, EndsWithAnError) {
  FrameRatePlan plan = small_plan();
  plan.scenarios = {4};
  FrameRateRun run(plan, {});
  EXPECT_FALSE(run.step());
  EXPECT_TRUE(run.finished());
  EXPECT_TRUE(run.rates().empty());
}

TEST(FrameRateRun, EndsWhereItIsCancelled) {
  FrameRateRun run(small_plan(), {});
  CancelToken cancel;
  ASSERT_TRUE(run.step(&cancel));
  cancel.cancel();
  EXPECT_FALSE(run.step(&cancel));
  EXPECT_TRUE(run.finished());
}

TEST(ConfigurationTimes, GainByTheTreeOfTheMedianRound) {
  const EngineTimes times = times_of(
      {{1, 64, std::nullopt, {10}}, {1, 64, 1, {5}}, {1, 64, 8, {2, 100, 1}}, {2, 64, std::nullopt, {20, 1000, 10}}});
  ASSERT_EQ(times.size(), 2U);
  EXPECT_EQ(times.at({1, 64}).fastest(), 8);
  EXPECT_DOUBLE_EQ(times.at({1, 64}).gain_percent(), 400);
  EXPECT_EQ(times.at({2, 64}).fastest(), 0);
  EXPECT_DOUBLE_EQ(frames_per_second(times.at({2, 64}).brute), 50);
}

TEST(FrameRatesReport, HoldsTimesAndStatedValues) {
  FrameRateRun run(small_plan(), {});
  while (!run.finished()) ASSERT_TRUE(run.step());
  const auto json = nlohmann::json::parse(frame_rates_json(
      run, stated_values().value(), "cpu", {"a \"device\" \xff", {{"browser", "a browser"}, {"gpu", "a processor"}}}));
  EXPECT_EQ(json["engine"], "cpu");
  EXPECT_EQ(json["browser"], "a browser");
  EXPECT_EQ(json["gpu"], "a processor");
  EXPECT_DOUBLE_EQ(json["drift"].get<double>(), drift_of(run.rates()));
  EXPECT_EQ(json["complete"], true);
  ASSERT_EQ(json["configurations"].size(), 6u);
  EXPECT_TRUE(json["configurations"][0]["max_prims"].is_null());
  EXPECT_EQ(json["stated"]["brute.fps.spheres256"]["value"], 1.87);
  // Values that we inferred, because the thesis states none, do not count as stated.
  EXPECT_FALSE(json["stated"].contains("width_px"));
}

TEST(FrameRatesReport, DriftIsOfTheLastRoundOverTheFirst) {
  EXPECT_DOUBLE_EQ(drift_of({}), 1);
  EXPECT_DOUBLE_EQ(drift_of({{1, 64, std::nullopt, {10}}}), 1) << "one round drifts nowhere";
  EXPECT_DOUBLE_EQ(drift_of({{1, 64, std::nullopt, {10, 90, 11}}, {1, 64, 1, {5, 6}}, {1, 64, 8, {2, 2}}}), 1.1);
}

// As after a page that was closed: what was complete is kept, the rest is measured.
TEST(FrameRateRun, GoesOnWhereAnEarlierRunStopped) {
  FrameRateRun first(small_plan(), {});
  while (first.rates().empty()) ASSERT_TRUE(first.step());
  const std::optional<SavedFrameRates> saved =
      saved_frame_rates(frame_rates_json(first, stated_values().value(), "gpu", {"d"}));
  ASSERT_TRUE(saved);
  EXPECT_EQ(saved->engine, "gpu");
  EXPECT_EQ(saved->width_px, 16);
  EXPECT_EQ(saved->rounds, 3);
  ASSERT_EQ(saved->rates.size(), 3u);

  FrameRateRun second(small_plan(), {});
  second.resume(saved->rates);
  EXPECT_EQ(second.rates().size(), 3u);
  EXPECT_EQ(second.scenario(), 2);
  EXPECT_NEAR(second.done(), 0.5, 1e-9);
  EXPECT_EQ(second.seconds_left(), 0) << "nothing was measured by this run";
  int steps = 0;
  for (; !second.finished(); ++steps) ASSERT_TRUE(second.step());
  EXPECT_EQ(steps, 3 * 4);
  ASSERT_EQ(second.rates().size(), 6u);
  EXPECT_EQ(second.rates()[1].frame_ms, first.rates()[1].frame_ms);

  FrameRateRun third(small_plan(), {});
  third.resume(second.rates());
  EXPECT_TRUE(third.finished());
}

TEST(FrameRateRun, CountsTheRoundsOfEarlierPassesBeforeItsOwn) {
  FrameRatePlan plan = small_plan();
  plan.rounds = 1;
  FrameRateRun first(plan, {}), second(plan, {});
  for (FrameRateRun* run : {&first, &second})
    while (!run->finished()) ASSERT_TRUE(run->step());
  const double of_second = second.rates().back().frame_ms.front();
  second.put_after(first);
  EXPECT_EQ(second.plan().rounds, 2);
  ASSERT_EQ(second.rates().size(), first.rates().size());
  EXPECT_EQ(second.rates().back().frame_ms, (std::vector<double>{first.rates().back().frame_ms.front(), of_second}));
}

TEST(FrameRateRun, TakesNoRatesOfAnotherPlan) {
  std::vector<MeasuredRate> rates{{1, 64, std::nullopt, {1, 1, 1}}, {1, 64, 1, {1, 1, 1}}, {1, 64, 8, {1, 1, 1}}};
  const auto taken = [](const std::vector<MeasuredRate>& from) {
    FrameRateRun run(small_plan(), {});
    run.resume(from);
    return run.rates().size();
  };
  EXPECT_EQ(taken(rates), 3u);
  rates[2].frame_ms.pop_back();
  EXPECT_EQ(taken(rates), 0u) << "a round is missing";
  rates[2].frame_ms.push_back(1);
  rates[2].max_prims = 4;
  EXPECT_EQ(taken(rates), 0u);
  rates.pop_back();
  EXPECT_EQ(taken(rates), 0u) << "half a group";
  EXPECT_FALSE(saved_frame_rates("{}"));
  EXPECT_FALSE(saved_frame_rates("no JSON"));
}

// No time at all leaves the smallest pictures; an hour those of the plan.
TEST(FrameRatePlan, ShrinksPicturesUntilTheRunEndsInTime) {
  FrameRatePlan plan = small_plan();
  plan.width_px = 160;
  plan.height_px = 96;
  const Result<FrameRatePlan> whole = plan.within(3600, {});
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->width_px, 160);
  const Result<FrameRatePlan> least = plan.within(0, {});
  ASSERT_TRUE(least);
  EXPECT_EQ(least->width_px, 20);
  EXPECT_EQ(least->height_px, 12);
  EXPECT_EQ(least->rounds, plan.rounds);
  EXPECT_EQ(least->max_prims, plan.max_prims);
}

TEST(FrameRatesReport, DrawsWhatIsComplete) {
  FrameRateRun run(small_plan(), {});
  EXPECT_TRUE(frame_rates_charts(run, stated_values().value(), "here").empty());
  while (!run.finished()) ASSERT_TRUE(run.step());
  const std::vector<std::string> charts = frame_rates_charts(run, stated_values().value(), "here");
  ASSERT_EQ(charts.size(), 2u);
  EXPECT_EQ(charts[0].find("iPhone 5s"), std::string::npos) << "a picture of another size has other rates";

  // Values that say this size.
  std::string text(builtin_values_figure_4_4());
  const auto set = [&](const std::string& before, int px) {
    const std::string value = "{\"value\": ";
    const std::size_t at = text.find(value + before);
    ASSERT_NE(at, std::string::npos);
    text.replace(at + value.size(), before.size(), std::to_string(px));
  };
  set("1136", small_plan().width_px);
  set("640", small_plan().height_px);
  const Result<StatedValues> small = StatedValues::parse(text, "values.json");
  ASSERT_TRUE(small);
  const std::vector<std::string> whole = frame_rates_charts(run, *small, "here");
  EXPECT_NE(whole[0].find("BIH 8, iPhone 5s, stated, 64: 60"), std::string::npos) << whole[0];
  EXPECT_EQ(whole[1].find("iPhone 5s"), std::string::npos) << "the thesis states nothing of 64 spheres there";
}

}  // namespace
}  // namespace bihive
