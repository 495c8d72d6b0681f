// The search for the nearest other place against brute force, bit for bit, on sets that are easy and on sets that are
// meant to make it slow or wrong.
#include "bihive/io/assemble/nearest_place.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "bihive/math/rng.h"
#include "support/effort.h"
#include "support/thread_time.h"

namespace bihive {
namespace {

struct Points {
  std::string name;
  std::vector<Vec3d> all;
};

double between(SplitMix64& rng, double lo, double hi) {
  return lo + (hi - lo) * rng.next_double();
}

Vec3d in_cube(SplitMix64& rng, double half_side) {
  return {between(rng, -half_side, half_side), between(rng, -half_side, half_side),
          between(rng, -half_side, half_side)};
}

// Sets of `count` points.
std::vector<Points> hostile_points(std::size_t count, std::uint64_t seed) {
  SplitMix64 rng(seed);
  std::vector<Points> sets;
  const auto add = [&](const std::string& name, auto make_point) {
    sets.push_back({name, {}});
    for (std::size_t i = 0; i < count; ++i) sets.back().all.push_back(make_point(i));
  };
  add("random", [&](std::size_t) { return in_cube(rng, 1); });
  add("clusters", [&](std::size_t i) { return in_cube(rng, 1e-6) + Vec3d{double(i % 7), double(i % 3), 0}; });
  add("clusters of clusters", [&](std::size_t i) { return in_cube(rng, std::ldexp(1, -static_cast<int>(i % 60))); });
  add("one place", [](std::size_t) { return Vec3d{0.1, -0.3, 0.7}; });
  add("two places", [](std::size_t i) { return Vec3d{0, i % 2 ? 1e-300 : 0, 0}; });
  add("one place and a stranger", [](std::size_t i) { return i == 0 ? Vec3d{5, 6, 7} : Vec3d{1, 1, 1}; });
  add("few places", [&](std::size_t) {
    return Vec3d{double(rng.next_below(5)), double(rng.next_below(5)), double(rng.next_below(5))};
  });
  add("half in one place", [&](std::size_t i) { return i % 2 ? Vec3d{} : in_cube(rng, 1); });
  add("both zeros", [&](std::size_t i) { return Vec3d{i % 2 ? 0.0 : -0.0, i % 3 ? 0.0 : -0.0, double(i % 5)}; });
  add("lattice", [](std::size_t i) { return Vec3d{double(i % 16), double(i / 16 % 16), double(i / 256)}; });
  add("even line", [](std::size_t i) { return Vec3d{0, 0, double(i)}; });
  add("diagonal line", [&](std::size_t) { return rng.next_double() * Vec3d{1, 2, -3}; });
  add("sheet", [&](std::size_t) { return Vec3d{rng.next_double(), 7, rng.next_double()}; });
  add("circle", [&](std::size_t i) { return Vec3d{std::cos(double(i)), std::sin(double(i)), 0}; });
  add("one far away", [&](std::size_t i) { return i == count / 2 ? Vec3d{1e20, 0, 0} : in_cube(rng, 1); });
  add("ever farther", [](std::size_t i) { return Vec3d{std::ldexp(1, static_cast<int>(i % 120)), double(i), 0}; });
  add("huge", [&](std::size_t) { return in_cube(rng, 3.4e38); });
  add("tiny", [&](std::size_t) { return in_cube(rng, 1e-300); });
  add("of all sizes",
      [&](std::size_t) { return in_cube(rng, std::ldexp(1, static_cast<int>(rng.next_below(1100)) - 1000)); });
  add("least steps", [](std::size_t i) { return Vec3d{double(i) * std::numeric_limits<double>::denorm_min(), 0, 0}; });
  return sets;
}

// As the header says it. A difference whose square would underflow is scaled by a power of two, which is exact.
double by_brute_force(const std::vector<Vec3d>& points, Vec3d from) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3d& point : points) {
    if (point == from) continue;
    const Vec3d difference = point - from;
    const double distance = length(difference);
    least = std::min(least, distance > 0x1p-450 ? distance : length(0x1p600 * difference) / 0x1p600);
  }
  return least;
}

TEST(NearestPlace, EqualsBruteForce) {
  const std::uint64_t seeds = test::ray_share() > 1 ? 1 : 3;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    for (const std::size_t count : {1, 2, 3, 31, 32, 33, 70, 300, 2000}) {
      for (const Points& set : hostile_points(count, seed)) {
        const NearestPlace nearest(set.all);
        for (std::size_t i = 0; i < count; i += 1 + count / 200)
          ASSERT_EQ(nearest.distance_from(set.all[i]), by_brute_force(set.all, set.all[i]))
              << set.name << ", point " << i << " of " << count << ", seed " << seed;
      }
    }
  }
}

// From places that are no point of the set, too.
TEST(NearestPlace, EqualsBruteForceFromElsewhere) {
  SplitMix64 rng(9);
  for (const Points& set : hostile_points(500, 4)) {
    const NearestPlace nearest(set.all);
    for (int i = 0; i < 50; ++i) {
      const Vec3d from = in_cube(rng, 2);
      ASSERT_EQ(nearest.distance_from(from), by_brute_force(set.all, from)) << set.name;
    }
  }
}

// None takes much longer than random points. A search among all points would take a hundred times as long.
TEST(NearestPlace, IsQuickOnEverySet) {
  const std::size_t count = 200000 / static_cast<std::size_t>(test::ray_share());
  double seconds_random = 0;
  for (const Points& set : hostile_points(count, 5)) {
    const double start = test::thread_time_ms();
    const NearestPlace nearest(set.all);
    for (std::size_t i = 0; i < count; i += 4) nearest.distance_from(set.all[i]);
    const double seconds = 1e-3 * (test::thread_time_ms() - start);
    if (set.name == "random") seconds_random = seconds;
    EXPECT_LE(seconds, 0.5 + 10 * seconds_random) << set.name;
  }
}

}  // namespace
}  // namespace bihive
