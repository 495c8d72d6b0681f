// ctest: inlined
// ctest: asan-long
#include "bihive/math/vec3.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

// Not inlined, so that the compiler treats it as it treats the library's code.
[[gnu::noinline]] Vec3d rounded_to_binary32(Vec3d value) {
  return to_double(to_float(value));
}

TEST(Vec3, RoundingToBinary32AndBackIsNotLeftOut) {
  SplitMix64 random(1);
  for (int i = 0; i < 1000; ++i) {
    const Vec3d value{random.next_double(), random.next_double(), random.next_double()};
    const Vec3d rounded = rounded_to_binary32(value);
    for (int axis = 0; axis < 3; ++axis) {
      const volatile float expected = static_cast<float>(value[axis]);
      ASSERT_EQ(rounded[axis], double(expected)) << value[axis];
    }
  }
}

// The largest relative error of a component in units of 2^-53, measured in long double.
double error_of_unit(Vec3d unit, Vec3d of) {
  const auto x = (long double)of.x, y = (long double)of.y, z = (long double)of.z;
  const long double length = std::sqrt(x * x + y * y + z * z);
  long double error = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (of[axis] != 0) error = std::max(error, std::abs((long double)unit[axis] * length / (long double)of[axis] - 1));
  return static_cast<double>(error * 0x1p53L);
}

TEST(Vec3, NormalizedIsRightToFiveRoundings) {
  SplitMix64 random(2);
  const auto vector = [&](double size) {
    const auto next = [&] { return size * (random.next_double() - 0.5); };
    return Vec3d{next(), next(), next()};
  };
  for (int i = 0; i < 100000; ++i) {
    const Vec3d any = vector(std::ldexp(1.0, i % 200 - 100));
    ASSERT_LT(error_of_unit(normalized(any), any), 5) << i;
    ASSERT_LT(error_of_unit(normalized_again(any), any), 5) << i;

    // Lengths on both sides of the series' limit.
    const Vec3d almost = (1 + 0x1p-17 * (random.next_double() - 0.5)) * normalized(any);
    ASSERT_LT(error_of_unit(normalized_again(almost), almost), 5) << i;
    const Vec3d direction = to_double(to_float(normalized(any)));
    ASSERT_LT(error_of_unit(normalized_again(direction), direction), 5) << i;
  }
}

TEST(Vec3, CrossProductFollowsTheRightHand) {
  EXPECT_EQ(cross(Vec3d{1, 0, 0}, Vec3d{0, 1, 0}), (Vec3d{0, 0, 1}));
  EXPECT_EQ(dot(cross(Vec3d{1, 2, 3}, Vec3d{-4, 5, 6}), Vec3d{1, 2, 3}), 0);
}

TEST(Vec3, AxesAreNumbered) {
  Vec3f value{1, 2, 3};
  value[1] = 7;
  EXPECT_EQ(value, (Vec3f{1, 7, 3}));
  EXPECT_EQ(value[2], 3);
}

}  // namespace
}  // namespace bihive
