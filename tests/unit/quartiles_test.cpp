// ctest: asan-long
#include "bihive/math/quartiles.h"

#include <gtest/gtest.h>

#include <cmath>

namespace bihive {
namespace {

TEST(Quartiles, AreInterpolatedBetweenSortedValues) {
  const Quartiles of_five = quartiles_of({5, 1, 4, 2, 3});
  EXPECT_EQ(of_five.lower, 2);
  EXPECT_EQ(of_five.median, 3);
  EXPECT_EQ(of_five.upper, 4);
  const Quartiles of_two = quartiles_of({8, 4});
  EXPECT_EQ(of_two.lower, 5);
  EXPECT_EQ(of_two.median, 6);
  EXPECT_EQ(of_two.upper, 7);
  EXPECT_EQ(quartiles_of({7}).upper, 7);
}

TEST(Quartiles, MedianIsTheMiddleOne) {
  EXPECT_EQ(median({30, 10, 20}), 20);
  EXPECT_EQ(median({1, 2, 3, 10}), 2.5);
}

TEST(MeanAndSd, MeanAndDeviationOfASample) {
  EXPECT_EQ(mean_and_sd({}).mean, 0);
  EXPECT_EQ(mean_and_sd({3}).mean, 3);
  EXPECT_EQ(mean_and_sd({3}).sd, 0);
  EXPECT_EQ(mean_and_sd({1, 2, 3, 6}).mean, 3);
  EXPECT_DOUBLE_EQ(mean_and_sd({1, 2, 3, 6}).sd, std::sqrt(14.0 / 3));
}

}  // namespace
}  // namespace bihive
