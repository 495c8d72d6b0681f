// The direction of view along the shortest principal axis.
#include "bihive/scene/principal_side.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "bihive/math/rng.h"

namespace bihive {
namespace {

SphereSet set_of(const std::vector<Vec3d>& centres) {
  std::vector<double> x, y, z, r;
  for (const Vec3d centre : centres) {
    x.push_back(centre.x);
    y.push_back(centre.y);
    z.push_back(centre.z);
    r.push_back(1);
  }
  return *SphereSet::from_world(x, y, z, r);
}

void expect_near(Vec3d found, Vec3d wanted) {
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(found[axis], wanted[axis], 1e-6) << axis;
}

void expect_side(const std::vector<Vec3d>& centres, Vec3d back, Vec3d up, bool is_upright = false) {
  const Side side = principal_side(set_of(centres), is_upright);
  expect_near(side.back, back);
  expect_near(side.up, up);
}

// The corners of a box around (0.3, -7, 100).
std::vector<Vec3d> box(double x, double y, double z) {
  std::vector<Vec3d> corners;
  for (const double i : {-x, x})
    for (const double j : {-y, y})
      for (const double k : {-z, z}) corners.push_back({0.3 + i, -7 + j, 100 + k});
  return corners;
}

TEST(PrincipalSide, TheLongestAxisIsAcrossAndTheShortestAlongTheView) {
  expect_side(box(3, 2, 1), {0, 0, 1}, {0, 1, 0});
  expect_side(box(2, 3, 1), {0, 0, 1}, {1, 0, 0});
  expect_side(box(1, 2, 3), {1, 0, 0}, {0, 1, 0});
  expect_side(box(3, 1, 2), {0, 1, 0}, {0, 0, 1});
}

TEST(PrincipalSide, InAnUprightPictureTheLongestAxisIsUp) {
  expect_side(box(3, 2, 1), {0, 0, 1}, {1, 0, 0}, true);
  expect_side(box(2, 3, 1), {0, 0, 1}, {0, 1, 0}, true);
}

TEST(PrincipalSide, ALineLiesAcrossThePicture) {
  const auto line = [](Vec3d step) {
    std::vector<Vec3d> centres;
    for (int i = 0; i < 40; ++i) centres.push_back(Vec3d{0.1, 0.2, 0.3} + static_cast<double>(i) * step);
    return centres;
  };
  expect_side(line({1, 0, 0}), {0, 0, 1}, {0, 1, 0});
  expect_side(line({0, 1, 0}), {0, 0, 1}, {1, 0, 0});
  expect_side(line({0, 0, 1}), {1, 0, 0}, {0, 1, 0});
  const double d = std::sqrt(0.5);
  expect_side(line({1, 0, 1}), {-d, 0, d}, {0, 1, 0});
  expect_side(line({0, 1, 0}), {0, 0, 1}, {0, 1, 0}, true);
  expect_side(line({0, 0, 1}), {1, 0, 0}, {0, 0, 1}, true);
}

TEST(PrincipalSide, WithoutALongestAxisYIsUp) {
  expect_side({{4, 5, 6}}, {0, 0, 1}, {0, 1, 0});
  expect_side(box(2, 2, 2), {0, 0, 1}, {0, 1, 0});
  expect_side(box(2, 2, 1), {0, 0, 1}, {0, 1, 0});
  expect_side(box(1, 2, 2), {1, 0, 0}, {0, 1, 0});
  expect_side(box(2, 1, 2), {0, 1, 0}, {0, 0, -1});
  expect_side({}, {0, 0, 1}, {0, 1, 0});
}

TEST(PrincipalSide, IsADirectionOfViewForAnySet) {
  SplitMix64 random(3);
  const auto uniform = [&random] { return 18 * random.next_double() - 9; };
  for (int repeat = 0; repeat < 100; ++repeat) {
    std::vector<Vec3d> centres;
    for (int i = 0; i < 2 + repeat % 9; ++i) centres.push_back({uniform(), uniform(), uniform()});
    for (const bool is_upright : {false, true}) {
      const Side side = principal_side(set_of(centres), is_upright);
      EXPECT_NEAR(length(side.back), 1, 1e-12);
      EXPECT_NEAR(length(side.up), 1, 1e-12);
      EXPECT_NEAR(dot(side.back, side.up), 0, 1e-9);
      EXPECT_GE(side.up.y, 0);
    }
  }
}

TEST(PrincipalSide, UprightSidesHaveYUpAndViewsFromAboveZDown) {
  expect_near(upright_side({1, 0, 0}).up, {0, 1, 0});
  expect_near(upright_side({0, 1, 0}).up, {0, 0, -1});
  expect_near(upright_side({0, -1, 0}).up, {0, 0, 1});
}

}  // namespace
}  // namespace bihive
