// Area and volume of unions of balls: random and degenerate sets against points, against balls that are really smaller,
// and against themselves in another order, on other threads, and with neighbours from the tree.
#include "bihive/measure/union_measures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/measure/balls.h"
#include "bihive/measure/decisions.h"
#include "bihive/measure/exposed_sphere.h"
#include "bihive/measure/neighbour_grid.h"
#include "bihive/measure/surfaces.h"
#include "support/effort.h"
#include "support/hostile_balls.h"
#include "support/world.h"

// ctest: threads

namespace bihive {
namespace {

using measure::Balls;

struct Sums {
  double area = 0, volume = 0;
};

Sums sums_of(const Balls& balls) {
  Sums sums;
  std::vector<std::int64_t> all(static_cast<std::size_t>(balls.size()));
  std::iota(all.begin(), all.end(), std::int64_t{0});
  measure::ExposedSphere sphere(balls);
  for (std::int64_t i = 0; i < balls.size(); ++i) {
    const measure::ExposedPart part = sphere.measure(i, all.data(), balls.size());
    const double r = balls.radius[i];
    sums.area += r * r * part.solid_angle;
    sums.volume += r * r * (r * part.solid_angle + dot(balls.centre[i], part.outwards)) / 3;
  }
  return sums;
}

TEST(UnionMeasuresProperty, DegenerateSetsAreLimitsOfSmallerBalls) {
  SplitMix64 rng(41);
  const int sets = test::at_least(100, 2000);
  for (int set = 0; set < sets; ++set) {
    const Balls balls = test::hostile_balls(rng, set % 4);
    // Smaller by what the symbolic amounts stand for, in their order.
    Balls smaller = balls;
    for (std::int64_t i = 0; i < balls.size(); ++i) {
      int rank = 0;
      for (std::int64_t j = 0; j < balls.size(); ++j) rank += j != i && balls.shrinks_more(i, j) ? 1 : 0;
      smaller.radius[i] = std::sqrt(balls.radius[i] * balls.radius[i] - 1e-9 * std::pow(3.0, rank - balls.size()));
    }
    const Sums exact = sums_of(balls), near = sums_of(smaller);
    EXPECT_NEAR(exact.area, near.area, 1e-6) << "set " << set;
    EXPECT_NEAR(exact.volume, near.volume, 1e-7) << "set " << set;
    // In another order other decisions fall, and the union is the same.
    Balls shuffled = balls;
    for (std::int64_t i = balls.size() - 1; i > 0; --i) {
      const auto j = static_cast<std::int64_t>(static_cast<double>(i + 1) * rng.next_double());
      std::swap(shuffled.centre[i], shuffled.centre[j]);
      std::swap(shuffled.radius[i], shuffled.radius[j]);
    }
    const Sums other = sums_of(shuffled);
    EXPECT_NEAR(exact.area, other.area, 1e-12) << "set " << set;
    EXPECT_NEAR(exact.volume, other.volume, 1e-13) << "set " << set;
  }
}

// The connected parts of the union, by the balls that overlap.
int components_of(const Balls& balls) {
  std::vector<std::int64_t> part(static_cast<std::size_t>(balls.size()));
  std::iota(part.begin(), part.end(), std::int64_t{0});
  for (std::int64_t i = 0; i < balls.size(); ++i)
    for (std::int64_t j = i + 1; j < balls.size(); ++j)
      if (part[i] != part[j] && measure::relation(balls, i, j) != measure::TwoBalls::apart)
        std::replace(part.begin(), part.end(), std::int64_t{part[j]}, std::int64_t{part[i]});
  std::sort(part.begin(), part.end());
  return static_cast<int>(std::unique(part.begin(), part.end()) - part.begin());
}

TEST(UnionMeasuresProperty, SurfacesBoundTheConnectedParts) {
  SplitMix64 rng(12);
  const int sets = test::at_least(100, 2000);
  for (int set = 0; set < sets; ++set) {
    Balls balls = test::hostile_balls(rng, set % 4);
    if (set % 5 == 4) {
      // Small balls on a large one, which is in many pieces then.
      balls = {};
      const int count = 20 + static_cast<int>(rng.next_below(60));
      balls.centre.push_back({});
      balls.radius.push_back(0.5);
      while (balls.size() < count) {
        const Vec3d at{rng.next_double() - 0.5, rng.next_double() - 0.5, rng.next_double() - 0.5};
        balls.centre.push_back((0.45 + 0.1 * rng.next_double()) * normalized(at));
        balls.radius.push_back(0.05 + 0.15 * rng.next_double());
      }
    }
    std::vector<std::int64_t> all(static_cast<std::size_t>(balls.size()));
    std::iota(all.begin(), all.end(), std::int64_t{0});
    measure::ExposedSphere sphere(balls);
    measure::Pieces pieces;
    for (std::int64_t i = 0; i < balls.size(); ++i) {
      const measure::ExposedPart part = sphere.measure(i, all.data(), balls.size());
      const std::size_t first = pieces.pieces.size();
      sphere.append_pieces(pieces.pieces, pieces.junctions);
      pieces.owner.resize(pieces.pieces.size(), i);
      double solid_angle = 0;
      for (std::size_t p = first; p < pieces.pieces.size(); ++p) {
        EXPECT_GT(pieces.pieces[p].solid_angle, -1e-9) << "set " << set << " sphere " << i;
        EXPECT_LT(pieces.pieces[p].solid_angle, 4 * std::numbers::pi + 1e-9) << "set " << set << " sphere " << i;
        solid_angle += pieces.pieces[p].solid_angle;
      }
      EXPECT_NEAR(solid_angle, part.solid_angle, 1e-9) << "set " << set << " sphere " << i;
    }
    double area = 0, volume = 0;
    int outer = 0;
    for (const measure::Surface& surface : measure::surfaces_of(balls, std::nullopt, {pieces})) {
      area += surface.area;
      volume += surface.volume;
      outer += surface.encloses_balls ? 1 : 0;
      if (!surface.encloses_balls) {
        EXPECT_LT(surface.volume, 1e-12) << "set " << set;
      }
    }
    const Sums sums = sums_of(balls);
    EXPECT_NEAR(area, sums.area, 1e-11) << "set " << set;
    EXPECT_NEAR(volume, sums.volume, 1e-11) << "set " << set;
    EXPECT_EQ(outer, components_of(balls)) << "set " << set;
  }
}

TEST(UnionMeasuresProperty, DecisionsDoNotDependOnTheOrderOfThreeSpheres) {
  SplitMix64 rng(4);
  const int sets = test::at_least(20, 100);
  for (int set = 0; set < sets; ++set) {
    const Balls balls = test::hostile_balls(rng, set % 4);
    const auto crosses = [&](std::int64_t i, std::int64_t j) {
      return measure::relation(balls, i, j) == measure::TwoBalls::cross;
    };
    for (std::int64_t i = 0; i < balls.size(); ++i)
      for (std::int64_t j = i + 1; j < balls.size(); ++j)
        for (std::int64_t k = j + 1; k < balls.size(); ++k) {
          if (!crosses(i, j) || !crosses(i, k) || !crosses(j, k)) continue;
          const bool meets = measure::circle_meets(balls, i, j, k);
          EXPECT_EQ(meets, measure::circle_meets(balls, k, i, j));
          EXPECT_EQ(meets, measure::circle_meets(balls, j, i, k));
          if (!meets) continue;
          for (std::int64_t l = 0; l < balls.size(); ++l)
            for (const int side : {1, -1}) {
              if (l == i || l == j || l == k) continue;
              const bool inside = measure::point_in_ball(balls, i, j, k, side, l);
              EXPECT_EQ(inside, measure::point_in_ball(balls, j, k, i, side, l));
              EXPECT_EQ(inside, measure::point_in_ball(balls, k, j, i, -side, l));
            }
        }
  }
}

TEST(UnionMeasuresProperty, AgreesWithPoints) {
  SplitMix64 rng(7);
  const int sets = test::at_least(2, 6), points = 50'000;
  for (int set = 0; set < sets; ++set) {
    test::World world;
    const int count = 20 + 10 * set;
    for (int i = 0; i < count; ++i)
      world.add(rng.next_double(), rng.next_double(), rng.next_double(),
                0.02 + 0.2 * rng.next_double() * rng.next_double());
    const SphereSet spheres = test::sphere_set(world);
    const UnionMeasures measures = measure_union(spheres).value();
    const auto inside = [&](Vec3d x, int but) {
      for (int i = 0; i < count; ++i) {
        const Vec3d between = x - spheres.centre(i);
        if (i != but && dot(between, between) < spheres.radius(i) * spheres.radius(i)) return true;
      }
      return false;
    };
    // Volume: points in a box of 1.5^3 about all. Area: points on each sphere.
    int hits = 0;
    for (int n = 0; n < points; ++n)
      hits += inside(Vec3d{rng.next_double(), rng.next_double(), rng.next_double()} * 1.5 - Vec3d{0.25, 0.25, 0.25}, -1)
                  ? 1
                  : 0;
    const double box = 1.5 * 1.5 * 1.5, share = measures.volume / box;
    EXPECT_NEAR(measures.volume, box * hits / points, 4 * box * std::sqrt(share * (1 - share) / points));
    double area = 0, variance = 0;
    const int each = points / count;
    for (int i = 0; i < count; ++i) {
      int exposed = 0;
      for (int n = 0; n < each; ++n) {
        const double z = 2 * rng.next_double() - 1, turn = 2 * std::numbers::pi * rng.next_double(),
                     along = std::sqrt(1 - z * z);
        const Vec3d direction{along * std::cos(turn), along * std::sin(turn), z};
        exposed += inside(spheres.centre(i) + spheres.radius(i) * direction, i) ? 0 : 1;
      }
      const double whole = 4 * std::numbers::pi * spheres.radius(i) * spheres.radius(i), part = double(exposed) / each;
      area += whole * part;
      const double exact = std::min(measures.sphere_area[i] / whole, 1.0);
      variance += whole * whole * exact * (1 - exact) / each;
      EXPECT_NEAR(part, exact, 5.5 * std::sqrt(exact * (1 - exact) / each) + 1e-12) << "sphere " << i;
    }
    EXPECT_NEAR(measures.area, area, 4 * std::sqrt(variance));
  }
}

test::World random_world(int count, double spread, std::uint64_t seed) {
  SplitMix64 rng(seed);
  test::World world;
  for (int i = 0; i < count; ++i)
    world.add(spread * rng.next_double(), spread * rng.next_double(), spread * rng.next_double(),
              std::exp2(-4 * rng.next_double()));
  return world;
}

TEST(UnionMeasuresProperty, SameBitsOnAnyNumberOfThreads) {
  const SphereSet spheres = test::sphere_set(random_world(test::at_least(1000, 5000), 15, 3));
  MeasureOptions options;
  options.probe = 0.1;
  options.threads = 1;
  const UnionMeasures one = measure_union(spheres, options).value();
  for (const int threads : {2, 5}) {
    options.threads = threads;
    const UnionMeasures many = measure_union(spheres, options).value();
    EXPECT_EQ(one.area, many.area);
    EXPECT_EQ(one.volume, many.volume);
    EXPECT_EQ(one.sphere_area, many.sphere_area);
  }
}

TEST(UnionMeasuresProperty, PowersOfTwoScaleAreaAndVolume) {
  const test::World world = random_world(500, 6, 5);
  const UnionMeasures measures = measure_union(test::sphere_set(world)).value();
  for (const int exponent : {-60, 60}) {
    const UnionMeasures scaled =
        measure_union(test::sphere_set(world.scaled(std::ldexp(1.0, exponent), "scaled"))).value();
    EXPECT_EQ(scaled.area, std::ldexp(measures.area, 2 * exponent));
    EXPECT_EQ(scaled.volume, std::ldexp(measures.volume, 3 * exponent));
  }
}

TEST(UnionMeasuresProperty, ClustersFarApartAreMeasuredByTheTree) {
  // Two clusters: all balls of one would share a cell of the grid.
  test::World world = random_world(1000, 8, 9);
  const SphereSet alone = test::sphere_set(world);
  for (std::size_t i = 0; i < 1000; ++i) world.add(world.x[i] + 65536, world.y[i], world.z[i], world.r[i]);
  const SphereSet both = test::sphere_set(world);
  Balls balls;
  for (std::int64_t i = 0; i < both.size(); ++i) {
    balls.centre.push_back(both.stored_centre(i));
    balls.radius.push_back(both.stored_radius(i));
  }
  ASSERT_FALSE(measure::NeighbourGrid::of(balls).has_value());
  MeasureOptions options;
  options.probe = 0.125;
  const UnionMeasures whole = measure_union(both, options).value(), one = measure_union(alone, options).value();
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(whole.sphere_area[i], one.sphere_area[i], 1e-10) << i;
  double exposed = 0;
  for (int i = 0; i < 1000; ++i) exposed += whole.sphere_area[i];
  EXPECT_NEAR(exposed, one.area, 1e-10 * one.area);
}

}  // namespace
}  // namespace bihive
