// Area and volume of unions of balls with a closed form, degenerate ones among them, and what measure_union() refuses.
#include "bihive/measure/union_measures.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <vector>

#include "support/world.h"

namespace bihive {
namespace {

using testing::HasSubstr;

using Ball = std::array<double, 4>;

SphereSet balls_of(const std::vector<Ball>& balls) {
  test::World world;
  for (const Ball& b : balls) world.add(b[0], b[1], b[2], b[3]);
  return test::sphere_set(world);
}

UnionMeasures measures_of(const std::vector<Ball>& balls, double probe = 0) {
  MeasureOptions options;
  options.probe = probe;
  return measure_union(balls_of(balls), options).value();
}

double ball_area(double r) {
  return 4 * std::numbers::pi * r * r;
}
double ball_volume(double r) {
  return 4 * std::numbers::pi / 3 * r * r * r;
}
// What a plane at this distance from the centre cuts off.
double cap_area(double r, double h) {
  return 2 * std::numbers::pi * r * (r - h);
}
double cap_volume(double r, double h) {
  return std::numbers::pi / 3 * (r - h) * (r - h) * (2 * r + h);
}

void expect_measures(const UnionMeasures& measures, double area, double volume) {
  EXPECT_NEAR(measures.area, area, 1e-13 * area);
  EXPECT_NEAR(measures.volume, volume, 1e-13 * volume);
  EXPECT_LE(std::abs(measures.area - area), measures.area_error + 1e-15 * area);
  EXPECT_LE(std::abs(measures.volume - volume), measures.volume_error + 1e-15 * volume);
  EXPECT_NEAR(std::accumulate(measures.sphere_area.begin(), measures.sphere_area.end(), 0.0), area, 1e-13 * area);
}

TEST(UnionMeasures, OneBall) {
  expect_measures(measures_of({{1, 2, 3, 1.5}}), ball_area(1.5), ball_volume(1.5));
  expect_measures(measures_of({{0, 0, 0, 0}}, 1.5), ball_area(1.5), ball_volume(1.5));
  expect_measures(measures_of({{5, 0, 0, 0.25}}, 1.25), ball_area(1.5), ball_volume(1.5));
  const UnionMeasures nothing = measures_of({{0, 0, 0, 0}});
  EXPECT_EQ(nothing.area, 0);
  EXPECT_EQ(nothing.volume, 0);
  EXPECT_EQ(measures_of({}).area, 0);
}

TEST(UnionMeasures, TwoBalls) {
  // 3-4-5: the circle has radius 4, at 3 from one centre and at 7.5 from the other.
  const double other = 8.5;
  expect_measures(measures_of({{0, 0, 0, 5}, {10.5, 0, 0, other}}),
                  ball_area(5) - cap_area(5, 3) + ball_area(other) - cap_area(other, 7.5),
                  ball_volume(5) - cap_volume(5, 3) + ball_volume(other) - cap_volume(other, 7.5));
  // The same circle beyond the smaller ball's centre.
  expect_measures(measures_of({{0, 0, 0, 5}, {0, 4.5, 0, other}}),
                  ball_area(5) - cap_area(5, -3) + ball_area(other) - cap_area(other, 7.5),
                  ball_volume(5) - cap_volume(5, -3) + ball_volume(other) - cap_volume(other, 7.5));
}

TEST(UnionMeasures, TouchingNestedAndEqualBalls) {
  const double area = ball_area(1), volume = ball_volume(1);
  expect_measures(measures_of({{0, 0, 0, 1}, {2, 0, 0, 1}}), 2 * area, 2 * volume);  // from outside
  expect_measures(measures_of({{0, 0, 0, 1}, {0.5, 0, 0, 0.5}}), area, volume);      // from inside
  expect_measures(measures_of({{0.5, 0, 0, 0.5}, {0, 0, 0, 1}}), area, volume);
  expect_measures(measures_of({{0, 0, 0, 1}, {0, 0, 0, 0.5}, {0, 0, 0, 1}}), area, volume);  // concentric
  const UnionMeasures equal = measures_of({{1, 1, 1, 0.5}, {0, 0, 0, 1}, {0, 0, 0, 1}, {1, 1, 1, 0.5}});
  EXPECT_EQ(equal.sphere_area[2], 0);
  EXPECT_EQ(equal.sphere_area[3], 0);
  EXPECT_EQ(equal.area, measures_of({{1, 1, 1, 0.5}, {0, 0, 0, 1}}).area);
}

TEST(UnionMeasures, SpheresThatShareACircle) {
  // The middle ball ends at the circle that the outer ones make.
  const std::vector<Ball> two{{-3, 0, 0, 5}, {3, 0, 0, 5}};
  for (const double middle : {4.0, 3.5}) {
    std::vector<Ball> three = two;
    three.insert(three.begin() + 1, {0, 0, 0, middle});
    expect_measures(measures_of(three), measures_of(two).area, measures_of(two).volume);
  }
  // A larger one through the circle covers neither of them.
  const std::vector<Ball> all{{-3, 0, 0, 5}, {3, 0, 0, 5}, {7.5, 0, 0, 8.5}};
  expect_measures(measures_of(all), ball_area(5) - cap_area(5, 3) + ball_area(8.5) - cap_area(8.5, 7.5),
                  ball_volume(5) - cap_volume(5, 3) + ball_volume(8.5) - cap_volume(8.5, 7.5));
}

std::vector<Ball> cubic_lattice(int n, double spacing, double r) {
  std::vector<Ball> balls;
  for (int z = 0; z < n; ++z)
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < n; ++x) balls.push_back({spacing * x, spacing * y, spacing * z, r});
  return balls;
}

TEST(UnionMeasures, SimpleCubicLattices) {
  constexpr int kSide = 5, kBalls = kSide * kSide * kSide, kContacts = 3 * kSide * kSide * (kSide - 1);
  // In contact.
  expect_measures(measures_of(cubic_lattice(kSide, 2, 1)), kBalls * ball_area(1), kBalls * ball_volume(1));
  // Lenses that do not meet each other.
  const double r = 1.25;
  expect_measures(measures_of(cubic_lattice(kSide, 2, r)), kBalls * ball_area(r) - kContacts * 2 * cap_area(r, 1),
                  kBalls * ball_volume(r) - kContacts * 2 * cap_volume(r, 1));
  // Four spheres meet in each of many points.
  const UnionMeasures large = measures_of(cubic_lattice(kSide, 2, 1.5)), small = measures_of(cubic_lattice(4, 2, 1.5)),
                      smaller = measures_of(cubic_lattice(3, 2, 1.5)), smallest = measures_of(cubic_lattice(2, 2, 1.5));
  // Volume and area of a block are polynomials of degree 3 in its side.
  EXPECT_NEAR(large.volume - 4 * small.volume + 6 * smaller.volume - 4 * smallest.volume, -ball_volume(1.5), 1e-10);
  EXPECT_NEAR(large.area - 4 * small.area + 6 * smaller.area - 4 * smallest.area, -ball_area(1.5), 1e-10);
}

TEST(UnionMeasures, ClosePackingsInContact) {
  // Contacts of fcc and hcp are at irrational distances, so binary32 puts some just apart and some just together.
  const double root = std::sqrt(2.0), third = std::sqrt(3.0);
  std::vector<Ball> fcc, hcp;
  for (int z = 0; z < 6; ++z)
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 6; ++x) {
        if ((x + y + z) % 2 == 0) fcc.push_back({root * x, root * y, root * z, 1});
        hcp.push_back({2.0 * x + (y + z) % 2, third * (y + z % 2 / 3.0), 2 * std::sqrt(6.0) / 3 * z, 1});
      }
  for (const std::vector<Ball>& balls : {fcc, hcp}) {
    const double n = static_cast<double>(balls.size());
    const UnionMeasures measures = measures_of(balls);
    EXPECT_NEAR(measures.area, n * ball_area(1), n * 1e-5);
    EXPECT_NEAR(measures.volume, n * ball_volume(1), n * 1e-10);
    EXPECT_LT(measures.area_error, 1e-9 * measures.area);
  }
}

TEST(UnionMeasures, ManySmallBallsOnALargeOne) {
  // Half of each small one is outside, nearly.
  std::vector<Ball> balls{{0, 0, 0, 1}};
  constexpr int kSmall = 500;
  const double r = 1.0 / 256;
  for (int i = 0; i < kSmall; ++i) {
    const double z = 1 - (2 * i + 1.0) / kSmall, along = std::sqrt(1 - z * z), turn = 2.399963229728653 * i;
    balls.push_back({along * std::cos(turn), along * std::sin(turn), z, r});
  }
  const UnionMeasures measures = measures_of(balls);
  // Centres are at a distance of 1, up to rounding to binary32.
  const double large_h = 1 - r * r / 2, small_h = r / 2 * r;
  const double area = ball_area(1) - kSmall * cap_area(1, large_h) + kSmall * (ball_area(r) - cap_area(r, small_h));
  EXPECT_NEAR(measures.area, area, 1e-6 * area);
  EXPECT_LT(measures.area_error, 1e-10 * area);
  EXPECT_GT(measures.sphere_area[0], 12.5);
}

UnionMeasures cavities_of(const std::vector<Ball>& balls) {
  MeasureOptions options;
  options.cavities = true;
  return measure_union(balls_of(balls), options).value();
}

// Volume and area of a shell of many balls are those inside plus those outside.
TEST(UnionMeasures, CavitiesOfACubicBlock) {
  // With a radius of 1.5 spheres at a distance of 2 leave a hollow in the middle of each cube, 8 of them in 3^3.
  const UnionMeasures block = cavities_of(cubic_lattice(3, 2, 1.5)), cube = cavities_of(cubic_lattice(2, 2, 1.5));
  EXPECT_EQ(block.components, 1);
  ASSERT_EQ(block.cavities.size(), 8u);
  ASSERT_EQ(cube.cavities.size(), 1u);
  EXPECT_EQ(cube.cavities[0].spheres, (std::vector<std::int64_t>{0, 1, 2, 3, 4, 5, 6, 7}));
  for (const Cavity& cavity : block.cavities) {
    EXPECT_EQ(cavity.spheres.size(), 8u);
    EXPECT_NEAR(cavity.volume, cube.cavities[0].volume, 1e-11);
    EXPECT_NEAR(cavity.area, cube.cavities[0].area, 1e-11);
  }
  // With sqrt(3) the hollows close; with 1.4 they are open: less than sqrt(2).
  EXPECT_TRUE(cavities_of(cubic_lattice(2, 2, 1.75)).cavities.empty());
  const UnionMeasures open = cavities_of(cubic_lattice(3, 2, 1.375));
  EXPECT_TRUE(open.cavities.empty());
  EXPECT_EQ(open.components, 1);
}

TEST(UnionMeasures, CavitiesAroundBalls) {
  // A shell of balls about a ball that does not touch it: a cavity that is a shell itself, with two components.
  std::vector<Ball> shell;
  constexpr int kShell = 400;
  for (int i = 0; i < kShell; ++i) {
    const double z = 1 - (2 * i + 1.0) / kShell, along = std::sqrt(1 - z * z), turn = 2.399963229728653 * i;
    shell.push_back({4 * along * std::cos(turn), 4 * along * std::sin(turn), 4 * z, 1});
  }
  const UnionMeasures hollow = cavities_of(shell);
  ASSERT_EQ(hollow.cavities.size(), 1u);
  EXPECT_EQ(hollow.components, 1);
  EXPECT_EQ(hollow.cavities[0].spheres.size(), static_cast<std::size_t>(kShell));
  EXPECT_GT(hollow.cavities[0].volume, ball_volume(3));
  EXPECT_LT(hollow.cavities[0].volume, ball_volume(3.25));
  shell.push_back({0, 0, 0, 1});
  shell.push_back({9, 0, 0, 1});
  const UnionMeasures filled = cavities_of(shell);
  EXPECT_EQ(filled.components, 3);
  ASSERT_EQ(filled.cavities.size(), 1u);
  // The inner ball bounds the union, and its surface is an outer one of its own.
  EXPECT_NEAR(filled.cavities[0].volume, hollow.cavities[0].volume, 1e-9);
}

TEST(UnionMeasures, PiecesOfOneSphereBelongToDifferentSurfaces) {
  // A ball in the wall of a hollow has a piece outside and one inside; a belt around another leaves two caps.
  std::vector<Ball> belt{{0, 0, 0, 1}};
  for (int i = 0; i < 24; ++i)
    belt.push_back({std::cos(i * std::numbers::pi / 12), std::sin(i * std::numbers::pi / 12), 0, 0.5});
  const UnionMeasures measures = cavities_of(belt);
  EXPECT_EQ(measures.components, 1);
  EXPECT_TRUE(measures.cavities.empty());
  EXPECT_GT(measures.sphere_area[0], 1);
}

TEST(UnionMeasures, MaskLeavesSpheresOut) {
  const SphereSet set = balls_of({{0, 0, 0, 1}, {1, 0, 0, 1}, {9, 0, 0, 2}});
  const std::vector<std::uint8_t> mask{1, 0, 1};
  MeasureOptions options;
  options.mask = mask.data();
  const auto measures = measure_union(set, options);
  ASSERT_TRUE(measures.ok());
  EXPECT_NEAR(measures->sphere_area[0], ball_area(1), 1e-12);
  EXPECT_EQ(measures->sphere_area[1], 0);
  EXPECT_NEAR(measures->area, ball_area(1) + ball_area(2), 1e-12);
}

TEST(UnionMeasures, RefusesBadProbesAndCopies) {
  SphereSet set = balls_of({{0, 0, 0, 1}});
  const auto message_of = [&](double probe) {
    MeasureOptions options;
    options.probe = probe;
    return measure_union(set, options).error().message;
  };
  EXPECT_THAT(message_of(-1), HasSubstr("probe must be a finite number of at least 0"));
  EXPECT_THAT(message_of(std::numeric_limits<double>::quiet_NaN()), HasSubstr("probe must be"));
  EXPECT_THAT(message_of(1e30), HasSubstr("10^12 times the extent"));
  ASSERT_TRUE(set.replicate({Vec3d{4, 0, 0}, Vec3d{0, 4, 0}, Vec3d{0, 0, 4}}, {2, 1, 1}).ok());
  EXPECT_THAT(message_of(0), HasSubstr("copies along a cell"));
}

}  // namespace
}  // namespace bihive
