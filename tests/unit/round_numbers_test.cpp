// ctest: asan-long
#include "bihive/image/round_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace bihive {
namespace {

using testing::ElementsAre;

std::vector<std::string> texts(std::pair<double, double> range, bool logarithmic = false, int most = 6) {
  std::vector<std::string> all;
  for (const Tick& tick : ticks_of(range, logarithmic, most)) {
    EXPECT_GE(tick.number, range.first - 1e-9 * std::abs(range.first));
    EXPECT_LE(tick.number, range.second + 1e-9 * std::abs(range.second));
    all.push_back(tick.text);
  }
  return all;
}

TEST(RoundNumbers, powers_of_ten) {
  EXPECT_EQ(power_of_ten(0), 1);
  EXPECT_EQ(power_of_ten(22), 1e22);
  EXPECT_EQ(power_of_ten(-22), 1e-22);
  EXPECT_NEAR(power_of_ten(-300) / 1e-300, 1, 1e-13);
  EXPECT_NEAR(power_of_ten(300) / 1e300, 1, 1e-13);
}

TEST(RoundNumbers, the_nearest_is_1_2_or_5_times_a_power_of_ten) {
  for (const auto& [x, nearest] : std::vector<std::pair<double, double>>{{1, 1},
                                                                         {1.4, 1},
                                                                         {1.42, 2},
                                                                         {3.1, 2},
                                                                         {3.2, 5},
                                                                         {7, 5},
                                                                         {7.2, 10},
                                                                         {99, 100},
                                                                         {0.003, 0.002},
                                                                         {4e20, 5e20},
                                                                         {9.999999999999999e-5, 1e-4}})
    EXPECT_DOUBLE_EQ(nearest_round_number(x).value(), nearest) << x;
}

TEST(RoundNumbers, ticks_are_round_and_equally_long) {
  EXPECT_THAT(texts({0, 100}), ElementsAre("0", "20", "40", "60", "80", "100"));
  EXPECT_THAT(texts({-1, 1}), ElementsAre("−1.0", "−0.5", "0", "0.5", "1.0"));
  EXPECT_THAT(texts({0.003, 0.0071}), ElementsAre("0.003", "0.004", "0.005", "0.006", "0.007"));
  EXPECT_THAT(texts({1e6, 2.2e6}), ElementsAre("1.0×10⁶", "1.5×10⁶", "2.0×10⁶"));
  EXPECT_THAT(texts({5, 5}), ElementsAre("5"));
}

TEST(RoundNumbers, logarithmic_ticks_are_powers_of_ten_where_there_are_some) {
  EXPECT_THAT(texts({0.5, 2000}, true), ElementsAre("1", "10", "100", "1000"));
  EXPECT_THAT(texts({1e-6, 1e6}, true).size(), testing::Le(8U));
  EXPECT_THAT(texts({1, 10}, true), ElementsAre("1", "2", "5", "10"));
  EXPECT_THAT(texts({3, 4}, true).size(), testing::Ge(2U));
}

TEST(RoundNumbers, any_range_has_some_ticks_but_not_too_many) {
  for (const double low : {-1e300, -7.3e8, -1.0, -1e-12, 0.0, 1e-300, 0.1, 3.0, 1e15})
    for (const double extent : {1e-300, 1e-13, 0.02, 1.0, 17.0, 4e9, 1e300}) {
      const std::pair<double, double> range{low, low + extent};
      for (const bool logarithmic : {false, true}) {
        const auto ticks = ticks_of(range, logarithmic, 6);
        EXPECT_GE(ticks.size(), 1U) << low << " " << extent;
        EXPECT_LE(ticks.size(), 12U) << low << " " << extent;
        for (const Tick& tick : ticks) EXPECT_TRUE(std::isfinite(tick.number) && tick.text.size() < 40) << tick.text;
      }
    }
}

}  // namespace
}  // namespace bihive
