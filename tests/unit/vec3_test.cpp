#include "bihive/math/vec3.h"

#include <gtest/gtest.h>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

// Not inlined, so that the compiler may make of it what it makes of the library's code.
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
