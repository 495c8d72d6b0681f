// Exact sums and products, and the angles that measures are made of.
#include "bihive/measure/exact_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "bihive/math/rng.h"
#include "bihive/measure/direction_angle.h"

namespace bihive::measure {
namespace {

double random_double(SplitMix64& rng, int exponents) {
  const double magnitude =
      std::ldexp(1 + rng.next_double(), static_cast<int>(rng.next_below(exponents)) - exponents / 2);
  return rng.next_below(2) == 0 ? magnitude : -magnitude;
}

TEST(ExactNumber, KeepsEveryBitOfBinary64) {
  SplitMix64 rng(1);
  for (int i = 0; i < 2000; ++i) {
    const double x = random_double(rng, 300);
    EXPECT_EQ(ExactNumber(x).to_double(), x);
    EXPECT_EQ(ExactNumber(x).sign(), x > 0 ? 1 : -1);
    EXPECT_EQ((-ExactNumber(x)).to_double(), -x);
  }
  for (const double x : {0.0, 1.0, -1.0, 0x1p-160, 0x1.fffffffffffffp40, -0x1p-900, 0x1p31, 0x1p32, 0x1p-32, 0x1p-33})
    EXPECT_EQ(ExactNumber(x).to_double(), x);
}

TEST(ExactNumber, SumsAndProductsAreExact) {
  SplitMix64 rng(2);
  for (int i = 0; i < 2000; ++i) {
    const double a = random_double(rng, 200), b = random_double(rng, 200), c = random_double(rng, 200);
    const ExactNumber x(a), y(b), z(c);
    EXPECT_EQ(((x + y) * (x - y) - (x * x - y * y)).sign(), 0);
    EXPECT_EQ(((x + y) + z - y - z - x).sign(), 0);
    EXPECT_EQ((x * (y + z) - (x * y + x * z)).sign(), 0);
    const ExactNumber cube = (x + y) * (x + y) * (x + y);
    EXPECT_EQ((cube - (x * x * x + ExactNumber(3.0) * x * y * (x + y) + y * y * y)).sign(), 0);
    // One unit in the last place is not lost, however far down.
    const double above = std::nextafter(a, 1e300);
    EXPECT_EQ((x * y * z - ExactNumber(above) * y * z).sign(), -(b > 0 ? 1 : -1) * (c > 0 ? 1 : -1));
    EXPECT_EQ((ExactNumber(1e30) + x * y - ExactNumber(1e30) - y * x).sign(), 0);
  }
}

TEST(ExactNumber, RoundsToNearlyTheNearest) {
  SplitMix64 rng(3);
  for (int i = 0; i < 1000; ++i) {
    const double a = random_double(rng, 100), b = random_double(rng, 100);
    const double product = (ExactNumber(a) * ExactNumber(b)).to_double();
    EXPECT_LE(std::abs(product - a * b), 0x1p-52 * std::abs(product));
  }
}

TEST(DirectionAngle, IsTheAngle) {
  SplitMix64 rng(4);
  for (int i = 0; i < 20000; ++i) {
    const double y = random_double(rng, 60), x = random_double(rng, 60), exact = std::atan2(y, x);
    EXPECT_NEAR(direction_angle(y, x), exact, 0x1p-50);
    if (x > 0) {
      EXPECT_NEAR(direction_angle(y, x), exact, 0x1p-50 * std::abs(exact));
    }
  }
  EXPECT_EQ(direction_angle(0, 1), 0);
  EXPECT_EQ(direction_angle(0, -1), std::numbers::pi);
  EXPECT_EQ(direction_angle(1, 0), std::numbers::pi / 2);
  EXPECT_EQ(direction_angle(-1, 0), -std::numbers::pi / 2);
  EXPECT_EQ(direction_angle(0, 0), 0);
}

}  // namespace
}  // namespace bihive::measure
