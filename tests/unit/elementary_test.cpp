// The library's own powers and tangent against the system's, in long double.
// ctest: inlined
// ctest: asan-long
#include "bihive/math/elementary.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

constexpr int kTries = 200000;

TEST(Elementary, log2_over_the_whole_range) {
  SplitMix64 random(1);
  for (int i = 0; i < kTries; ++i) {
    const double x = std::ldexp(1 + random.next_double(), static_cast<int>(random.next_below(2040)) - 1020);
    const long double expected = std::log2((long double)x);
    ASSERT_LT(std::abs(portable_log2(x) - expected), 2e-16L * (1 + std::abs(expected))) << x;
  }
  EXPECT_EQ(portable_log2(1), 0);
  EXPECT_EQ(portable_log2(0x1p-1074), -1074);
}

TEST(Elementary, log2_near_one) {
  SplitMix64 random(2);
  for (int i = 0; i < kTries; ++i) {
    const double x = 1 + (random.next_double() - 0.5) * 1e-3;
    ASSERT_LT(std::abs(portable_log2(x) - std::log2((long double)x)), 1e-18L) << x;
  }
}

TEST(Elementary, exp2) {
  SplitMix64 random(3);
  for (int i = 0; i < kTries; ++i) {
    const double x = (random.next_double() - 0.5) * 2040;
    const long double expected = std::exp2((long double)x);
    ASSERT_LT(std::abs(portable_exp2(x) - expected), 4e-16L * (1 + std::abs(x)) * expected) << x;
  }
  EXPECT_EQ(portable_exp2(0), 1);
  EXPECT_EQ(portable_exp2(10), 1024);
  EXPECT_EQ(portable_exp2(-2000), 0);
  EXPECT_EQ(portable_exp2(2000), std::numeric_limits<double>::infinity());
}

TEST(Elementary, pow_as_shading_uses_it) {
  SplitMix64 random(4);
  for (int i = 0; i < kTries; ++i) {
    const double x = random.next_double();
    const double y = random.next_double() * 100;
    const long double expected = std::pow((long double)x, (long double)y);
    if (expected < 1e-300L) continue;
    ASSERT_LT(std::abs(portable_pow(x, y) - expected),
              1e-15L * (1 + std::abs(y * std::log2((long double)x))) * expected)
        << x << ' ' << y;
  }
  EXPECT_EQ(portable_pow(0, 40), 0);
  EXPECT_EQ(portable_pow(0, 0), 1);
  EXPECT_EQ(portable_pow(1, 40), 1);
}

TEST(Elementary, shading_power) {
  SplitMix64 random(5);
  for (int i = 0; i < kTries; ++i) {
    const double x = random.next_double();
    const double y = i % 2 == 0 ? std::floor(random.next_double() * 1025) : random.next_double() * 100;
    const long double expected = std::pow((long double)x, (long double)y);
    if (expected < 1e-300L) continue;
    const long double bound =
        y == std::floor(y) ? 2e-16L * (1 + y) : 1e-15L * (1 + std::abs(y * std::log2((long double)x)));
    ASSERT_LT(std::abs(shading_power(x, y) - expected), bound * expected) << x << ' ' << y;
  }
  EXPECT_EQ(shading_power(0.5, 0), 1);
  EXPECT_EQ(shading_power(0.5, 1), 0.5);
  EXPECT_EQ(shading_power(0.5, 1024), 0x1p-1024);
  EXPECT_EQ(shading_power(0.5, 1e9), 0);
}

TEST(Elementary, small_whole_numbers) {
  for (const double y : {0.0, 1.0, 40.0, 1024.0}) EXPECT_TRUE(is_small_whole(y)) << y;
  for (const double y :
       {-1.0, 0.5, 1025.0, 1e300, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_FALSE(is_small_whole(y)) << y;
}

TEST(Elementary, tangent) {
  for (int i = 0; i <= 8900; ++i) {
    const double degrees = i / 100.0;
    const long double expected = std::tan(degrees * (std::acos(-1.0L) / 180));
    ASSERT_LE(std::abs(tan_deg(degrees) - expected), 1e-14L * expected) << degrees;
  }
}

TEST(Elementary, atan_deg) {
  SplitMix64 random(11);
  const long double degree = std::acos(-1.0L) / 180;
  for (int i = 0; i < kTries; ++i) {
    const double x = std::ldexp(1 + random.next_double(), static_cast<int>(random.next_below(80)) - 40);
    const long double expected = std::atan((long double)x) / degree;
    ASSERT_LT(std::abs(atan_deg(x) - expected), 2e-15L * expected) << x;
  }
  EXPECT_EQ(atan_deg(0), 0);
  EXPECT_EQ(atan_deg(std::numeric_limits<double>::infinity()), 90);
}

TEST(Elementary, sine_and_cosine_of_degrees) {
  SplitMix64 random(12);
  const long double degree = std::acos(-1.0L) / 180;
  for (int i = 0; i < kTries; ++i) {
    const double degrees = (random.next_double() - 0.5) * 1440;
    const SineCosine found = sine_cosine_deg(degrees);
    ASSERT_LT(std::abs(found.sine - std::sin(degrees * degree)), 3e-16L) << degrees;
    ASSERT_LT(std::abs(found.cosine - std::cos(degrees * degree)), 3e-16L) << degrees;
  }
  for (int quarters = -9; quarters <= 9; ++quarters) {
    const SineCosine found = sine_cosine_deg(90.0 * quarters);
    const int place = (quarters % 4 + 4) % 4;
    EXPECT_EQ(found.sine, place == 1 ? 1 : place == 3 ? -1 : 0) << quarters;
    EXPECT_EQ(found.cosine, place == 0 ? 1 : place == 2 ? -1 : 0) << quarters;
  }
}

}  // namespace
}  // namespace bihive
