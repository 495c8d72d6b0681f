// Area, volume and holes of small sets, hostile ones among them, against arithmetic of 384 bits.
// ctest: alone
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bihive/math/rng.h"
#include "support/effort.h"
#include "support/hostile_balls.h"
#include "support/measure_differences.h"

namespace bihive {
namespace {

using measure::Balls;

void add_ball(Balls& balls, Vec3d centre, double radius) {
  balls.centre.push_back(centre);
  balls.radius.push_back(radius);
}

TEST(MeasureReference, KnowsClosedForms) {
  const double pi = 3.14159265358979323846;
  Balls two;
  add_ball(two, {0, 0, 0}, 0.5);
  add_ball(two, {0.75, 0, 0}, 0.5);
  const test::ReferenceMeasures lens = test::reference_measures(two);
  EXPECT_NEAR(static_cast<double>(lens.area), 2 * 2 * pi * 0.5 * (0.5 + 0.375), 1e-15);
  EXPECT_NEAR(static_cast<double>(lens.volume), 2 * pi / 3 * 0.875 * 0.875 * (1 - 0.375), 1e-15);
  add_ball(two, {0, 0, 0}, 0.5);      // equal
  add_ball(two, {0.25, 0, 0}, 0.25);  // touches from inside
  const test::ReferenceMeasures same = test::reference_measures(two);
  EXPECT_NEAR(static_cast<double>(same.area - lens.area), 0, 1e-15);
  EXPECT_NEAR(static_cast<double>(same.volume - lens.volume), 0, 1e-15);
  EXPECT_LT(same.parts[2].solid_angle, 1e-15);
  const test::reference::Holes holes = test::reference_holes(two);
  EXPECT_EQ(holes.components, 1);
  EXPECT_EQ(holes.cavities, 0);
}

TEST(MeasureReference, CountsHoles) {
  // Balls at the middles of a cube's faces and at its corners close it.
  Balls shell;
  for (const double side : {-1.0, 1.0}) {
    add_ball(shell, {side, 0, 0}, 0.8);
    add_ball(shell, {0, side, 0}, 0.8);
    add_ball(shell, {0, 0, side}, 0.8);
  }
  for (int corner = 0; corner < 8; ++corner)
    add_ball(shell, {corner % 2 * 1.0 - 0.5, corner / 2 % 2 * 1.0 - 0.5, corner / 4 * 1.0 - 0.5}, 0.5);
  EXPECT_EQ(test::reference_holes(shell).cavities, 1);
  EXPECT_EQ(test::reference_holes(shell).components, 1);
  shell.centre.resize(6);
  shell.radius.resize(6);
  EXPECT_EQ(test::reference_holes(shell).cavities, 0);
  // Two balls touch, a third one is apart.
  Balls apart;
  add_ball(apart, {0, 0, 0}, 0.5);
  add_ball(apart, {1, 0, 0}, 0.5);
  add_ball(apart, {0, 3, 0}, 0.5);
  EXPECT_EQ(test::reference_holes(apart).components, 3);
}

TEST(MeasureReference, AgreesOnHostileSets) {
  SplitMix64 rng(17);
  const int sets = test::at_least(40, 2000);
  for (int set = 0; set < sets; ++set) {
    Balls balls = test::hostile_balls(rng, set % 4);
    // Few balls mostly: the holes of 14 take a while.
    const std::size_t most = set % 64 == 0 ? 12 : 6;
    balls.centre.resize(std::min(most, balls.centre.size()));
    balls.radius.resize(balls.centre.size());
    EXPECT_EQ(test::measure_differences(balls, true), "") << "set " << set << "\n" << test::text_of_balls(balls);
  }
}

TEST(MeasureReference, AgreesOnHollows) {
  SplitMix64 rng(19);
  const int sets = test::at_least(10, 200);
  int cavities = 0;
  for (int set = 0; set < sets; ++set) {
    const Balls balls = test::enclosing_balls(rng);
    EXPECT_EQ(test::measure_differences(balls, true), "") << "set " << set << "\n" << test::text_of_balls(balls);
    cavities += test::small_union(balls).cavities > 0 ? 1 : 0;
  }
  EXPECT_GE(cavities, std::max(1, sets / 10));
  EXPECT_LT(cavities, sets);
}

TEST(MeasureReference, AgreesOnRandomSets) {
  SplitMix64 rng(18);
  const int sets = test::at_least(40, 1000);
  for (int set = 0; set < sets; ++set) {
    const Balls balls = test::random_balls(rng, 2 + set % 6, 1 + set % 4);
    EXPECT_EQ(test::measure_differences(balls, true), "") << "set " << set << "\n" << test::text_of_balls(balls);
  }
}

}  // namespace
}  // namespace bihive
