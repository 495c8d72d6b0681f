// ctest: inlined
// ctest: asan-long
#include "bihive/geometry/ray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "bihive/geometry/scaled_ray.h"

namespace bihive {
namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

TEST(Ray, IsValidForAnyFiniteDirectionAboveZero) {
  EXPECT_TRUE(is_valid({{0, 0, 0}, {0, 0, 1}}));
  EXPECT_TRUE(is_valid({{0, 0, 0}, {1e-45f, 0, 0}}));
  EXPECT_TRUE(is_valid({{3e38f, 0, 0}, {3e38f, -3e38f, 3e38f}}));
  EXPECT_TRUE(is_valid({{0, 0, 0}, {0, 1, 0}, 2, 2})) << "both ends of the segment count";
  EXPECT_TRUE(is_valid({{0, 0, 0}, {0, 1, 0}, -kInf, kInf}));
}

TEST(Ray, IsInvalidWithNanInfinityZeroDirectionOrReversedSegment) {
  for (int axis = 0; axis < 3; ++axis)
    for (const float bad : {kNan, kInf, -kInf}) {
      Ray ray{{1, 2, 3}, {1, 2, 3}};
      ray.origin[axis] = bad;
      EXPECT_FALSE(is_valid(ray)) << "origin " << axis << " " << bad;
      ray = {{1, 2, 3}, {1, 2, 3}};
      ray.direction[axis] = bad;
      EXPECT_FALSE(is_valid(ray)) << "direction " << axis << " " << bad;
    }
  EXPECT_FALSE(is_valid({{0, 0, 0}, {0, 0, 0}}));
  EXPECT_FALSE(is_valid({{0, 0, 0}, {0, -0.0f, 0}}));
  EXPECT_FALSE(is_valid({{0, 0, 0}, {0, 0, 1}, 1, std::nextafter(1.0, 0.0)}));
  EXPECT_FALSE(is_valid({{0, 0, 0}, {0, 0, 1}, kNan, 1}));
  EXPECT_FALSE(is_valid({{0, 0, 0}, {0, 0, 1}, 0, kNan}));
}

TEST(Ray, ScalingByAPowerOfTwoIsExact) {
  const Ray ray{{1.1f, -3e38f, 1e-45f}, {0.3f, 3e38f, -1e-45f}, 0.25, 7, 5, true};
  for (const int exponent : {-129, -1, 0, 1, 149}) {
    const double scale = std::ldexp(1.0, exponent);
    const ScaledRay scaled(ray, scale);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_EQ(std::ldexp(scaled.origin[axis], -exponent), double(ray.origin[axis]));
      EXPECT_EQ(std::ldexp(scaled.direction[axis], -exponent), double(ray.direction[axis]));
    }
    EXPECT_GT(scaled.direction_squared, 0);
    EXPECT_TRUE(std::isfinite(scaled.direction_squared));
    EXPECT_EQ(scaled.t_min, 0.25);
    EXPECT_EQ(scaled.t_max, 7);
    EXPECT_EQ(scaled.left_radius, -1);
    EXPECT_TRUE(scaled.inside);
  }
}

TEST(Ray, TheShortestDirectionInTheLargestWorldHasASquare) {
  const ScaledRay scaled({{0, 0, 0}, {1e-45f, 0, 0}}, std::ldexp(1.0, -129));
  EXPECT_EQ(scaled.direction_squared, std::ldexp(1.0, 2 * (-149 - 129)));
}

}  // namespace
}  // namespace bihive
