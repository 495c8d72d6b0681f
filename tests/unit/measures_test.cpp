#include "bihive/geometry/measures.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bihive/math/elementary.h"
#include "bihive/math/rng.h"

namespace bihive {
namespace {

TEST(Measures, AnglesOfAllQuadrants) {
  EXPECT_EQ(angle_deg({1, 0, 0}, {0, 0, 0}, {0, 2, 0}), 90);
  EXPECT_EQ(angle_deg({1, 0, 0}, {0, 0, 0}, {5, 0, 0}), 0);
  EXPECT_EQ(angle_deg({1, 0, 0}, {0, 0, 0}, {-3, 0, 0}), 180);
  EXPECT_NEAR(angle_deg({1, 0, 0}, {0, 0, 0}, {-1, 1, 0}), 135, 1e-12);
  EXPECT_NEAR(angle_deg({1, 0, 0}, {0, 0, 0}, {1, 1e-9, 0}), 180e-9 / 3.14159265358979, 1e-20);
  EXPECT_TRUE(std::isnan(angle_deg({0, 0, 0}, {0, 0, 0}, {1, 0, 0})));
  EXPECT_EQ(angle_deg({1e-200, 0, 0}, {0, 0, 0}, {0, 1e200, 0}), 90);
}

// a on the x axis, b and c on the z axis, d turned by a known angle.
TEST(Measures, DihedralsHaveTheSignOfTheField) {
  for (const double degrees : {0.0, 30.0, 60.0, 90.0, 120.0, 179.0, 180.0, -30.0, -90.0, -179.0}) {
    const SineCosine turn = sine_cosine_deg(degrees);
    // Looking along +z with x to the right, y points down, so that a turn from x to y is clockwise.
    const Vec3d d{turn.cosine, turn.sine, 2};
    EXPECT_NEAR(dihedral_deg({1, 0, 0}, {0, 0, 0}, {0, 0, 1}, d), degrees, 1e-12) << degrees;
    EXPECT_NEAR(dihedral_deg(d, {0, 0, 1}, {0, 0, 0}, {1, 0, 0}), degrees, 1e-12) << "the chain backwards";
  }
  EXPECT_TRUE(std::isnan(dihedral_deg({0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {1, 0, 3})));
}

TEST(Measures, ShortestImagesAreThoseOfAllNearCells) {
  SplitMix64 rng(5);
  const auto number = [&rng](double most) { return most * (2 * rng.next_double() - 1); };
  for (int round = 0; round < 200; ++round) {
    Cell cell;
    cell.vectors = {Vec3d{4 + number(1), 0, 0}, Vec3d{number(9), 5 + number(2), 0},
                    Vec3d{number(9), number(9), 3 + number(1)}};
    cell.periodic = {true, round % 3 != 0, true};
    const std::optional<Lattice> lattice = Lattice::of(cell);
    ASSERT_TRUE(lattice);
    const Vec3d vector{number(30), number(30), number(30)};
    const Vec3d found = shortest_image(vector, lattice);
    const Vec3d counts = lattice->shares(vector - found);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(counts[axis], std::round(counts[axis]), 1e-9);
    double least = dot(found, found);
    for (int i = -30; i <= 30; ++i)
      for (int j = -8; j <= 8; ++j)
        for (int k = -4; k <= 4; ++k) {
          if (!cell.periodic[1] && j != 0) continue;
          const Vec3d other =
              found + double(i) * cell.vectors[0] + double(j) * cell.vectors[1] + double(k) * cell.vectors[2];
          least = std::min(least, dot(other, other));
        }
    EXPECT_NEAR(dot(found, found), least, 1e-9 * (1 + least)) << round;
  }
  EXPECT_EQ(shortest_image({3, 4, 5}, std::nullopt), (Vec3d{3, 4, 5}));
}

}  // namespace
}  // namespace bihive
