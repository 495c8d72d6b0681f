// Area, volume and cells of small sets, hostile ones among them, against integrals in long double.
#include "support/measure_oracle.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <string>
#include <vector>

#include "bihive/math/rng.h"
#include "bihive/measure/exposed_sphere.h"
#include "support/effort.h"
#include "support/hostile_balls.h"

namespace bihive {
namespace {

using measure::Balls;

struct Sums {
  double area = 0, volume = 0, of_cells = 0;
};

Sums sums_of(const Balls& balls) {
  Sums sums;
  std::vector<std::int64_t> all(static_cast<std::size_t>(balls.size()));
  std::iota(all.begin(), all.end(), std::int64_t{0});
  measure::ExposedSphere sphere(balls);
  std::vector<measure::Facet> facets;
  for (std::int64_t i = 0; i < balls.size(); ++i) {
    const measure::ExposedPart part = sphere.measure(i, all.data(), balls.size());
    const double r = balls.radius[i];
    sums.area += r * r * part.solid_angle;
    sums.volume += r * r * (r * part.solid_angle + dot(balls.centre[i], part.outwards)) / 3;
    double cell = part.solid_angle;
    facets.clear();
    sphere.append_facets(facets);
    for (const measure::Facet& facet : facets) cell += facet.distance * facet.area;
    sums.of_cells += r * r * r * cell / 3;
  }
  return sums;
}

void keep(Balls& balls, std::int64_t most) {
  const auto count = static_cast<std::size_t>(std::min(most, balls.size()));
  balls.centre.resize(count);
  balls.radius.resize(count);
}

void expect_same(const Balls& balls, const std::string& name) {
  const test::OracleMeasures oracle = test::oracle_measures(balls);
  const Sums sums = sums_of(balls);
  EXPECT_NEAR(sums.area, static_cast<double>(oracle.area), 2e-9) << name;
  EXPECT_NEAR(sums.volume, static_cast<double>(oracle.volume), 1e-9) << name;
  EXPECT_NEAR(sums.of_cells, static_cast<double>(oracle.volume), 1e-9) << name;
}

int sets_to_test() {
  const char* const times = std::getenv("BIHIVE_LONG");
  const int usual = std::max(4, static_cast<int>(48 / test::ray_share()));
  return usual * (times == nullptr ? 1 : std::max(1, std::atoi(times)));
}

TEST(MeasureOracle, IntegratesTwoBalls) {
  Balls balls;
  balls.centre = {{0, 0, 0}, {0.625, 0.75, 0.25}};
  balls.radius = {0.75, 0.5};
  const double d = length(balls.centre[1]), h = (d * d + 0.5625 - 0.25) / (2 * d), k = d - h;
  const double pi = 3.14159265358979323846;
  const auto volume = [&](double r, double to) { return pi / 3 * (r + to) * (r + to) * (2 * r - to); };
  const test::OracleMeasures oracle = test::oracle_measures(balls);
  EXPECT_NEAR(static_cast<double>(oracle.area), 2 * pi * (0.75 * (0.75 + h) + 0.5 * (0.5 + k)), 1e-12);
  EXPECT_NEAR(static_cast<double>(oracle.volume), volume(0.75, h) + volume(0.5, k), 1e-12);
}

TEST(MeasureOracle, AgreesOnHostileSets) {
  SplitMix64 rng(2);
  const int sets = sets_to_test();
  for (int set = 0; set < sets; ++set) {
    Balls balls = test::hostile_balls(rng, set % 4);
    keep(balls, 6);
    expect_same(balls, "set " + std::to_string(set));
  }
}

TEST(MeasureOracle, AgreesOnRandomSets) {
  SplitMix64 rng(3);
  const int sets = sets_to_test();
  for (int set = 0; set < sets; ++set) {
    Balls balls;
    // Radii of up to three octaves.
    for (int i = 0; i < 3 + set % 5; ++i) {
      balls.centre.push_back({rng.next_double() - 0.5, rng.next_double() - 0.5, rng.next_double() - 0.5});
      balls.radius.push_back(0.5 * std::exp2(-3 * rng.next_double()));
    }
    expect_same(balls, "set " + std::to_string(set));
  }
}

}  // namespace
}  // namespace bihive
