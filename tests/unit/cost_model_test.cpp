// The cost model of the thesis's figure 4.4: exact ranges of costs beside a scan, and fits of costs that are known.
#include "bihive/thesis/cost_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

const std::vector<std::int64_t> kTrees{1, 8, 16};

// Deeper trees have more nodes and fewer tests.
FigureWork random_work(SplitMix64& random) {
  FigureWork work;
  for (std::int64_t scenario = 1; scenario <= 3; ++scenario)
    for (const std::int64_t spheres : {64, 128, 256})
      for (const std::int64_t max_prims : kTrees) {
        const double size = static_cast<double>(max_prims);
        const double inner = (3 + 5 * random.next_double()) / std::log2(size + 2);
        work[{scenario, spheres}][max_prims] = {inner, inner / 3 + random.next_double(),
                                                (1 + random.next_double()) * std::sqrt(size)};
      }
  return work;
}

WinPattern pattern_of(std::int64_t wins) {
  return {8, wins, {2, 128}, 16, kTrees};
}

bool is_in(const std::vector<CostRange>& ranges, double cost) {
  for (const CostRange& range : ranges)
    if (range.low < cost && cost < range.high) return true;
  return false;
}

TEST(CostModel, ALeafIsChargedApart) {
  const RayWork work{10, 4, 20};
  EXPECT_EQ((StepCosts{2, 0, 1}.of(work)), 1 + 2 * 10 + 20);
  EXPECT_EQ((StepCosts{2, 0.5, 1}.of(work)), 1 + 2 * (10 + 0.5 * 4) + 20);
}

TEST(CostModel, RangesAreThoseOfAScan) {
  SplitMix64 random(7);
  int found = 0;
  for (int round = 0; round < 20; ++round) {
    const FigureWork work = random_work(random);
    for (const double leaf : {0.0, 0.2, 1.0})
      for (const std::int64_t wins : {3, 5}) {
        const WinPattern pattern = pattern_of(wins);
        const WinsByCost exact = wins_by_cost(work, pattern, leaf);
        std::int64_t most = 0;
        for (double inner = 0.0137; inner < 40; inner *= 1.01) {
          const StepCosts costs{inner, leaf, 0};
          most = std::max(most, wins_of(work, pattern, costs));
          EXPECT_EQ(is_in(exact.stated, inner), wins_of(work, pattern, costs) == wins);
          EXPECT_EQ(is_in(exact.pattern, inner), pattern_holds(work, pattern, costs));
          found += pattern_holds(work, pattern, costs) ? 1 : 0;
        }
        EXPECT_LE(most, exact.most);
      }
  }
  EXPECT_GT(found, 0);
}

TEST(CostModel, TiesCountAsWins) {
  FigureWork work;
  for (const std::int64_t max_prims : kTrees) work[{1, 64}][max_prims] = {5, 2, 9};
  EXPECT_EQ(wins_of(work, pattern_of(1), {1, 0, 0}), 1);
}

TEST(CostModel, AFitFindsKnownCosts) {
  SplitMix64 random(11);
  const FigureWork work = random_work(random);
  const double fixed = 31, inner = 8, leaf = 1.5, test = 23;
  for (const double noise : {0.0, 0.02}) {
    EngineTimes times;
    const auto time = [&](const RayWork& one) {
      const double ns = fixed + inner * one.inner + leaf * one.leaves + test * one.tests;
      return std::vector<double>{ns * (1 + noise * (random.next_double() - 0.5)) / 4};
    };
    for (const auto& [configuration, trees] : work) {
      times[configuration].brute = time({0, 0, static_cast<double>(configuration.second)});
      for (const auto& [max_prims, one] : trees) times[configuration].trees[max_prims] = time(one);
    }
    const FittedCosts fitted = fit_costs(work, times, 4);
    EXPECT_EQ(fitted.frames, 36U);
    const double tolerance = noise == 0 ? 1e-6 : 0.25;
    EXPECT_NEAR(fitted.test_ns, test, tolerance * test);
    EXPECT_NEAR(fitted.inner_ns, inner, tolerance * inner);
    EXPECT_NEAR(fitted.fixed_ns, fixed, tolerance * fixed);
    EXPECT_NEAR(fitted.costs().inner, inner / test, noise == 0 ? 1e-6 : 4 * fitted.inner_error);
    EXPECT_LT(fitted.rms, noise == 0 ? 1e-9 : noise);
  }
}

// Costs below 0 make no sense: where the best solution has one, it is 0.
TEST(CostModel, NoCostIsNegative) {
  SplitMix64 random(13);
  const FigureWork work = random_work(random);
  EngineTimes times;
  for (const auto& [configuration, trees] : work) {
    times[configuration].brute = {static_cast<double>(configuration.second)};
    for (const auto& [max_prims, one] : trees)
      times[configuration].trees[max_prims] = {one.tests + 0.5 * one.inner - 0.1 * one.leaves};
  }
  const FittedCosts fitted = fit_costs(work, times, 1);
  EXPECT_EQ(fitted.frames, 36U);
  EXPECT_GE(fitted.fixed_ns, 0);
  EXPECT_GT(fitted.inner_ns, 0);
  EXPECT_EQ(fitted.leaf_ns, 0);
}

TEST(CostModel, WordsSayWhatAFitDoesNotDetermine) {
  EXPECT_EQ(cost_words(3.336, 0.1, 0.25, 0.5).inner, "3.34 ± 0.10");
  EXPECT_EQ(cost_words(3.336, 0.1, 0.25, 0.5).leaf, "0.25 ± 0.50");
  EXPECT_EQ(cost_words(3.336, 0.1, 0, 0).leaf, "0 (at its bound)");
  EXPECT_EQ(cost_words(0, 0, 0, 0).inner, "0 (at its bound)");
  EXPECT_EQ(cost_words(0, 0, 0, 0).leaf, "not determined by these frames");
  EXPECT_EQ(cost_words(3.336, 0.1, 2, 2.5).leaf, "not determined by these frames");
  EXPECT_EQ(cost_words(3.336, 0.1, 2, 1.5).leaf, "2.00 ± 1.50");
}

TEST(CostModel, TooFewFramesHaveNoFit) {
  const FigureWork work{{{1, 64}, {{8, {5, 2, 9}}}}};
  const EngineTimes times{{{1, 64}, {{100}, {{8, {20}}}}}};
  EXPECT_EQ(fit_costs(work, times, 1).frames, 0U);
}

}  // namespace
}  // namespace bihive
