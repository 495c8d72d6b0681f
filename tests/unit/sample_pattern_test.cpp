// ctest: asan-long
#include "bihive/scene/sample_pattern.h"

#include <gtest/gtest.h>

#include <vector>

namespace bihive {
namespace {

TEST(SamplePattern, OneSampleIsThePixelsCentre) {
  EXPECT_EQ(sample_place(0, 1).x, 0.5);
  EXPECT_EQ(sample_place(0, 1).y, 0.5);
}

TEST(SamplePattern, FourSamplesLieInFourQuarters) {
  std::vector<int> quarters(4);
  for (int i = 0; i < 4; ++i) {
    const SamplePlace place = sample_place(i, 4);
    ++quarters[(place.x < 0.5 ? 0u : 1u) + (place.y < 0.5 ? 0u : 2u)];
  }
  EXPECT_EQ(quarters, (std::vector<int>{1, 1, 1, 1}));
}

TEST(SamplePattern, LiesInsideThePixelWithOneSampleAColumn) {
  for (int n = 1; n <= 300; ++n) {
    std::vector<int> columns(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) {
      const SamplePlace place = sample_place(i, n);
      ASSERT_TRUE(place.x > 0 && place.x < 1 && place.y > 0 && place.y < 1) << i << " of " << n;
      ++columns[static_cast<std::size_t>(place.x * n)];
    }
    for (const int count : columns) ASSERT_EQ(count, 1) << n;
  }
}

TEST(SamplePattern, OfAPowerOfTwoHasOneSampleARow) {
  for (const int n : {2, 8, 64, 4096}) {
    std::vector<int> rows(static_cast<std::size_t>(n));
    for (int i = 0; i < n; ++i) ++rows[static_cast<std::size_t>(sample_place(i, n).y * n)];
    for (const int count : rows) ASSERT_EQ(count, 1) << n;
  }
}

}  // namespace
}  // namespace bihive
