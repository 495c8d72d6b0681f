// Contacts and volumes of single spheres: closed forms, points, and cells that sum up to the union, degenerate sets
// among them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/measure/balls.h"
#include "bihive/measure/exposed_sphere.h"
#include "bihive/measure/union_measures.h"
#include "support/effort.h"
#include "support/hostile_balls.h"
#include "support/world.h"

namespace bihive {
namespace {

using measure::Balls;

UnionMeasures cells_of(const SphereSet& spheres) {
  MeasureOptions options;
  options.sphere_volumes = options.contacts = true;
  return measure_union(spheres, options).value();
}

TEST(PowerCells, TwoSpheresShareADisc) {
  // 3-4-5: the circle has radius 4, at 3 from one centre and at 7.5 from the other.
  test::World world;
  world.add(0, 0, 0, 5);
  world.add(10.5, 0, 0, 8.5);
  world.add(30, 0, 0, 1);
  const UnionMeasures measures = cells_of(test::sphere_set(world));
  ASSERT_EQ(measures.contacts.size(), 1u);
  const Contact& contact = measures.contacts[0];
  EXPECT_EQ(contact.first, 0);
  EXPECT_EQ(contact.second, 1);
  EXPECT_NEAR(contact.area, 16 * std::numbers::pi, 1e-12);
  EXPECT_NEAR(contact.distance, 3, 1e-14);
  const double lost = std::numbers::pi / 3 * (5 - 3) * (5 - 3) * (2 * 5 + 3);
  EXPECT_NEAR(measures.sphere_volume[0], 4 * std::numbers::pi / 3 * 125 - lost, 1e-11);
  EXPECT_NEAR(measures.sphere_volume[2], 4 * std::numbers::pi / 3, 1e-13);
  EXPECT_NEAR(measures.sphere_volume[0] + measures.sphere_volume[1] + measures.sphere_volume[2], measures.volume,
              measures.volume_error);
}

TEST(PowerCells, NestedAndEqualSpheresHaveNone) {
  test::World world;
  world.add(0, 0, 0, 2);
  world.add(0.5, 0, 0, 1);
  world.add(0, 0, 0, 2);
  world.add(4, 0, 0, 2);  // touches
  const UnionMeasures measures = cells_of(test::sphere_set(world));
  EXPECT_TRUE(measures.contacts.empty());
  EXPECT_EQ(measures.sphere_volume[1], 0);
  EXPECT_EQ(measures.sphere_volume[2], 0);
  EXPECT_NEAR(measures.sphere_volume[0], 32 * std::numbers::pi / 3, 1e-12);
}

// Three spheres of one radius at the corners of an equilateral triangle: each disc ends at the line of all three
// planes.
TEST(PowerCells, ThreeSpheresShareALine) {
  test::World world;
  const double root = std::sqrt(3.0);
  world.add(0, 0, 0, 1);
  world.add(1, 0, 0, 1);
  world.add(0.5, root / 2, 0, 1);
  const UnionMeasures measures = cells_of(test::sphere_set(world));
  ASSERT_EQ(measures.contacts.size(), 3u);
  // A disc of radius s without what lies beyond a line at the distance h from its centre.
  const double s = root / 2, h = root / 6;
  const double left = s * s * (std::numbers::pi - std::acos(h / s)) + h * std::sqrt(s * s - h * h);
  for (const Contact& contact : measures.contacts) {
    EXPECT_NEAR(contact.area, left, 1e-6);  // the third centre is rounded to binary32
    EXPECT_NEAR(contact.distance, 0.5, 1e-7);
  }
}

TEST(PowerCells, CellsSumUpToTheUnionHoweverDegenerate) {
  SplitMix64 rng(5);
  const int sets = test::at_least(150, 3000);
  for (int set = 0; set < sets; ++set) {
    const Balls balls = test::hostile_balls(rng, set % 4);
    std::vector<std::int64_t> all(static_cast<std::size_t>(balls.size()));
    std::iota(all.begin(), all.end(), std::int64_t{0});
    measure::ExposedSphere sphere(balls);
    std::vector<measure::Facet> facets;
    std::map<std::pair<std::int64_t, std::int64_t>, double> area_of;
    double by_boundary = 0, by_cells = 0;
    for (std::int64_t i = 0; i < balls.size(); ++i) {
      const measure::ExposedPart part = sphere.measure(i, all.data(), balls.size());
      const double r = balls.radius[i];
      by_boundary += r * r * (r * part.solid_angle + dot(balls.centre[i], part.outwards)) / 3;
      facets.clear();
      sphere.append_facets(facets);
      double cell = part.solid_angle;
      for (const measure::Facet& facet : facets) {
        cell += facet.distance * facet.area;
        area_of[{i, facet.ball}] = r * r * facet.area;
      }
      EXPECT_GT(cell, -1e-12) << "set " << set << " sphere " << i;
      by_cells += r * r * r * cell / 3;
    }
    EXPECT_NEAR(by_boundary, by_cells, 1e-13) << "set " << set;
    // Both spheres see the same contact.
    for (const auto& [pair, area] : area_of) {
      const auto other = area_of.find({pair.second, pair.first});
      EXPECT_NEAR(area, other == area_of.end() ? 0 : other->second, 1e-13)
          << "set " << set << " " << pair.first << " " << pair.second;
    }
  }
}

TEST(PowerCells, AgreeWithPoints) {
  SplitMix64 rng(8);
  const int sets = test::at_least(2, 5), points = 40'000;
  for (int set = 0; set < sets; ++set) {
    test::World world;
    const int count = 20 + 10 * set;
    for (int i = 0; i < count; ++i)
      world.add(rng.next_double(), rng.next_double(), rng.next_double(), 0.1 + 0.2 * rng.next_double());
    const SphereSet spheres = test::sphere_set(world);
    const UnionMeasures measures = cells_of(spheres);
    std::vector<int> nearest(static_cast<std::size_t>(count));
    const double side = 1.6;
    for (int n = 0; n < points; ++n) {
      const Vec3d x = side * Vec3d{rng.next_double(), rng.next_double(), rng.next_double()} - Vec3d{0.3, 0.3, 0.3};
      int best = -1;
      double least = 0;
      for (int i = 0; i < count; ++i) {
        const Vec3d between = x - spheres.centre(i);
        const double power = dot(between, between) - spheres.radius(i) * spheres.radius(i);
        if (power < least) least = power, best = i;
      }
      if (best >= 0) ++nearest[best];
    }
    const double box = side * side * side;
    for (int i = 0; i < count; ++i) {
      const double share = measures.sphere_volume[i] / box;
      EXPECT_NEAR(box * nearest[i] / points, measures.sphere_volume[i],
                  5.5 * box * std::sqrt(share * (1 - share) / points) + 1e-9)
          << "set " << set << " sphere " << i;
    }
  }
}

}  // namespace
}  // namespace bihive
