// Shares of light as integers: there and back, and the ends of their range.
#include "bihive/math/optical_depth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

TEST(OpticalDepth, a_share_comes_back) {
  SplitMix64 rng(1);
  for (int i = 0; i < 10000; ++i) {
    const double share = std::exp2(-63.9 * rng.next_double());
    const double back = transmittance(optical_depth(share));
    ASSERT_LE(std::abs(back - share), 9e-8 * share) << share;
  }
  EXPECT_EQ(optical_depth(1), 0U);
  EXPECT_EQ(transmittance(0), 1);
  EXPECT_EQ(optical_depth(0.5), OpticalDepth{1} << 22);
  EXPECT_EQ(transmittance(OpticalDepth{3} << 22), 0.125);
}

TEST(OpticalDepth, the_deepest_layer_is_the_end) {
  for (const double share : {0.0, -1.0, 1e-300, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(optical_depth(share), kDeepestLayer) << share;
  EXPECT_EQ(optical_depth(2), 0U);
  EXPECT_EQ(transmittance(kDeepest), std::exp2(-256));
}

TEST(OpticalDepth, sums_take_any_order_and_stay) {
  SplitMix64 rng(2);
  for (int i = 0; i < 1000; ++i) {
    OpticalDepth parts[6], forward = 0, backward = 0;
    for (OpticalDepth& part : parts) part = static_cast<OpticalDepth>(rng.next_below(kDeepestLayer + 1));
    for (int k = 0; k < 6; ++k) {
      forward = sum_of_depths(forward, parts[k]);
      backward = sum_of_depths(backward, parts[5 - k]);
    }
    ASSERT_EQ(forward, backward);
    ASSERT_LE(forward, kDeepest);
  }
  EXPECT_EQ(sum_of_depths(kDeepest, kDeepest), kDeepest);
}

TEST(OpticalDepth, transmittance_follows_powers_of_two) {
  SplitMix64 rng(3);
  for (int i = 0; i < 10000; ++i) {
    const auto depth = static_cast<OpticalDepth>(rng.next_below(kDeepest));
    const double expected = std::exp2(-double(depth) / (1 << 22));
    ASSERT_NEAR(transmittance(depth) / expected, 1, 1e-13) << depth;
  }
}

}  // namespace
}  // namespace bihive
