// The queries of points: what they promise in words, their errors, and two uses of them that have a closed form.
#include "bihive/wide/point_queries.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "bihive/geometry/ray.h"
#include "bihive/math/rng.h"
#include "bihive/wide/wide_builder.h"
#include "support/world.h"

namespace bihive {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double kEverywhere = std::numeric_limits<double>::infinity();
constexpr double kPi = 3.14159265358979323846;

std::shared_ptr<const WideTree> tree_of(const std::vector<std::vector<double>>& spheres) {
  test::World world;
  for (const std::vector<double>& s : spheres) world.add(s[0], s[1], s[2], s[3]);
  WideBuilder builder;
  return builder.build(test::sphere_set(world)).value();
}

TEST(PointQueries, NearestBySurfaceAndByCentre) {
  // A large sphere whose surface is near, and a small one whose centre is.
  const auto tree = tree_of({{0, 0, 0, 4}, {8, 0, 0, 1}, {8, 0, 0, 1}, {8, 0, 0, 0}});
  const double points[] = {5, 0, 0, 1, 0, 0};
  const auto by_surface = nearest_spheres(*tree, PointSpan::rows(points, 2), 5);
  ASSERT_TRUE(by_surface.ok());
  EXPECT_THAT(by_surface->sphere_id, ElementsAre(0, 1, 2, 3, kNothing, 0, 1, 2, 3, kNothing));
  EXPECT_THAT(by_surface->distance, ElementsAre(1, 2, 2, 3, kEverywhere, -3, 6, 6, 7, kEverywhere));
  const auto by_centre =
      nearest_spheres(*tree, PointSpan::rows(points, 2), 2, kEverywhere, {DistanceTo::centre, nullptr, 1});
  EXPECT_THAT(by_centre->sphere_id, ElementsAre(1, 2, 0, 1));
  EXPECT_THAT(by_centre->distance, ElementsAre(3, 3, 1, 7));
  // The limit belongs to the answers that count.
  EXPECT_THAT(nearest_spheres(*tree, PointSpan::rows(points, 2), 1, 1)->sphere_id, ElementsAre(0, 0));
  EXPECT_THAT(nearest_spheres(*tree, PointSpan::rows(points, 2), 1, 0.999)->sphere_id, ElementsAre(kNothing, 0));
}

TEST(PointQueries, SurfacesBelongToTheirSpheres) {
  const auto tree = tree_of({{0, 0, 0, 1}, {2, 0, 0, 1}, {5, 0, 0, 0}, {0.5, 0, 0, 0.25}});
  const double points[] = {1, 0, 0, 5, 0, 0, 0.5, 0, 0, -3, 0, 0};
  const auto in = spheres_containing(*tree, PointSpan::rows(points, 4));
  ASSERT_TRUE(in.ok());
  EXPECT_THAT(in->begin, ElementsAre(0, 2, 3, 5, 5));
  EXPECT_THAT(in->sphere_id, ElementsAre(0, 1, 2, 0, 3));
  EXPECT_THAT(in->distance, ElementsAre(0, 0, 0, -0.5, -0.25));
  const double radii[] = {0, 2, 0, 2};
  const auto near = spheres_overlapping(*tree, PointSpan::rows(points, 4), radii);
  EXPECT_THAT(near->begin, ElementsAre(0, 2, 4, 6, 7));
  EXPECT_THAT(near->sphere_id, ElementsAre(0, 1, 1, 2, 0, 3, 0));
  // To contain a ball is more than to contain its middle.
  EXPECT_THAT(spheres_within(*tree, PointSpan::rows(points, 4), -0.4)->sphere_id, ElementsAre(0));
}

TEST(PointQueries, ASphereOfEachPointDoesNotCount) {
  const auto tree = tree_of({{0, 0, 0, 1}, {3, 0, 0, 1}, {3, 0, 0, 1}, {9, 0, 0, 1}});
  const double points[] = {0, 0, 0, 3, 0, 0, 9, 0, 0};
  const PointSpan span = PointSpan::rows(points, 3);
  const std::int64_t own[] = {0, 1, kNothing};
  PointOptions options;
  options.to = DistanceTo::centre;
  options.exclude = own;
  EXPECT_THAT(nearest_spheres(*tree, span, 1, kEverywhere, options)->sphere_id, ElementsAre(1, 2, 3));
  EXPECT_THAT(nearest_spheres(*tree, span, 4, kEverywhere, options)->sphere_id,
              ElementsAre(1, 2, 3, kNothing, 2, 0, 3, kNothing, 3, 1, 2, 0));
  const double limits[] = {3, 3, 6};
  const auto near = spheres_within(*tree, span, limits, options);
  ASSERT_TRUE(near.ok());
  EXPECT_THAT(near->begin, ElementsAre(0, 2, 4, 7));
  EXPECT_THAT(near->sphere_id, ElementsAre(1, 2, 0, 2, 1, 2, 3));
  EXPECT_THAT(count_within(*tree, span, limits, options).value(), ElementsAre(2, 2, 3));
  // Together with a mask.
  const std::uint8_t mask[] = {1, 1, 0, 1};
  options.mask = mask;
  EXPECT_THAT(nearest_spheres(*tree, span, 1, kEverywhere, options)->sphere_id, ElementsAre(1, 0, 3));
}

TEST(PointQueries, AMaskHidesSpheresOfAPileToo) {
  std::vector<std::vector<double>> pile(40, {1, 1, 1, 1});
  pile.push_back({9, 1, 1, 1});
  const auto tree = tree_of(pile);
  ASSERT_FALSE(tree->piles.empty());
  std::vector<std::uint8_t> mask(41, 0);
  mask[17] = mask[33] = mask[40] = 1;
  const double point[] = {1, 1, 1};
  const PointOptions options{DistanceTo::surface, mask.data(), 1};
  EXPECT_THAT(nearest_spheres(*tree, PointSpan::rows(point, 1), 4, kEverywhere, options)->sphere_id,
              ElementsAre(17, 33, 40, kNothing));
  EXPECT_THAT(spheres_containing(*tree, PointSpan::rows(point, 1), options)->sphere_id, ElementsAre(17, 33));
  EXPECT_EQ(spheres_containing(*tree, PointSpan::rows(point, 1))->sphere_id.size(), 40U);
}

TEST(PointQueries, NothingToAskAndNothingToFind) {
  const auto none = tree_of({});
  const auto one = tree_of({{0, 0, 0, 1}});
  EXPECT_TRUE(nearest_spheres(*one, {}, 3)->distance.empty());
  EXPECT_TRUE(nearest_spheres(*one, PointSpan::rows(nullptr, 0))->sphere_id.empty());
  EXPECT_THAT(spheres_containing(*one, {})->begin, ElementsAre(0));
  const double point[] = {0, 0, 0};
  EXPECT_THAT(nearest_spheres(*none, PointSpan::rows(point, 1), 2)->sphere_id, ElementsAre(kNothing, kNothing));
  EXPECT_THAT(spheres_containing(*none, PointSpan::rows(point, 1))->begin, ElementsAre(0, 0));
}

TEST(PointQueries, ErrorsNameThePoint) {
  const auto tree = tree_of({{0, 0, 0, 1}});
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite[] = {0, 0, 0, 0, kEverywhere, 0}, undefined[] = {nan, 0, 0}, large[] = {0, 0, -1e39},
               fine[] = {0, 0, 0};
  const auto error = [&](const double* points, std::int64_t count) {
    const auto answer = nearest_spheres(*tree, PointSpan::rows(points, count));
    return answer.ok() ? "no error" : answer.error().to_string();
  };
  EXPECT_EQ(error(infinite, 2), "point 1: y must be finite but is inf");
  EXPECT_EQ(error(undefined, 1), "point 0: x must be finite but is nan");
  EXPECT_EQ(error(large, 1), "point 0: z must fit single precision (3.4e38) but is -1e+39");
  const PointSpan one = PointSpan::rows(fine, 1);
  EXPECT_THAT(nearest_spheres(*tree, one, 0).error().to_string(), HasSubstr("at least 1 but is 0"));
  EXPECT_THAT(nearest_spheres(*tree, one, 1, nan).error().to_string(), HasSubstr("a number but is nan"));
  EXPECT_THAT(nearest_spheres(*tree, one, std::int64_t{1} << 62).error().to_string(), HasSubstr("not enough memory"));
  EXPECT_FALSE(spheres_containing(*tree, PointSpan::rows(infinite, 2)).ok());
  EXPECT_THAT(spheres_within(*tree, one, nan).error().to_string(), HasSubstr("point 0: the limit must be a number"));
  const double negative = -1;
  EXPECT_EQ(spheres_overlapping(*tree, one, &negative).error().to_string(),
            "point 0: the radius must be finite and not negative but is -1");
  EXPECT_FALSE(spheres_overlapping(*tree, one, &kEverywhere).ok());
}

// Two unit spheres whose centres are 1 apart share a lens: two caps of height 1/2.
constexpr double kCapVolume = kPi * 0.25 * (3 - 0.5) / 3;

TEST(PointQueries, PorosityOfTwoOverlappingSpheres) {
  // The share of a box 4 x 3 x 3 around them that is empty, by the middles of a grid's cells.
  const auto tree = tree_of({{0, 0, 0, 1}, {1, 0, 0, 1}});
  constexpr int kCells = 60;
  std::vector<double> points;
  for (int i = 0; i < kCells; ++i)
    for (int j = 0; j < kCells; ++j)
      for (int k = 0; k < kCells; ++k) {
        points.push_back(-1.5 + 4 * (i + 0.5) / kCells);
        points.push_back(-1.5 + 3 * (j + 0.5) / kCells);
        points.push_back(-1.5 + 3 * (k + 0.5) / kCells);
      }
  const auto count = static_cast<std::int64_t>(points.size() / 3);
  const auto lists = spheres_containing(*tree, PointSpan::rows(points.data(), count));
  ASSERT_TRUE(lists.ok());
  std::int64_t empty = 0, in_both = 0;
  for (std::int64_t i = 0; i < count; ++i) {
    const auto spheres = lists->begin[static_cast<std::size_t>(i) + 1] - lists->begin[static_cast<std::size_t>(i)];
    empty += spheres == 0 ? 1 : 0;
    in_both += spheres == 2 ? 1 : 0;
  }
  const double volume = 2 * (4.0 / 3 * kPi) - 2 * kCapVolume;
  EXPECT_NEAR(double(empty) / double(count), 1 - volume / 36, 3e-4);
  EXPECT_NEAR(36 * double(in_both) / double(count), 2 * kCapVolume, 5e-3);
}

TEST(PointQueries, SolventAccessibleSurfaceOfTwoOverlappingSpheres) {
  // Atoms of radius 0.6 and a probe of 0.4: the middle of the probe rolls over spheres of radius 1. Points on each, in
  // a spiral from pole to pole, are free if no sphere but their own has them inside.
  const auto tree = tree_of({{0, 0, 0, 1}, {1, 0, 0, 1}});
  constexpr int kPoints = 20000;
  double area = 0;
  for (std::int64_t own = 0; own < 2; ++own) {
    std::vector<double> points;
    for (int i = 0; i < kPoints; ++i) {
      const double z = 1 - (2 * i + 1.0) / kPoints, angle = kPi * (3 - std::sqrt(5.0)) * i;
      points.push_back(double(own) + std::sqrt(1 - z * z) * std::cos(angle));
      points.push_back(std::sqrt(1 - z * z) * std::sin(angle));
      points.push_back(z);
    }
    std::vector<std::uint8_t> others(2, 1);
    others[static_cast<std::size_t>(own)] = 0;
    const auto nearest =
        nearest_spheres(*tree, PointSpan::rows(points.data(), kPoints), 1, 0, {DistanceTo::surface, others.data(), 0});
    ASSERT_TRUE(nearest.ok());
    for (const std::int64_t id : nearest->sphere_id) area += id == kNothing ? 4 * kPi / kPoints : 0;
  }
  // Each sphere loses a cap of height 1/2.
  EXPECT_NEAR(area, 2 * (4 * kPi - kPi), 2e-3 * 6 * kPi);
}

SphereSet random_set(int count, std::uint64_t seed) {
  test::World world;
  SplitMix64 random(seed);
  for (int i = 0; i < count; ++i)
    world.add(4 * random.next_double(), 4 * random.next_double(), 4 * random.next_double(),
              i % 7 == 0 ? 0 : 0.5 * random.next_double());
  for (int i = 0; i < 5; ++i) world.add(1, 1, 1, 0.25);  // coincide
  return test::sphere_set(world);
}

std::vector<std::array<std::int64_t, 2>> ids_of(const SpherePairs& pairs) {
  std::vector<std::array<std::int64_t, 2>> ids;
  for (std::size_t k = 0; k < pairs.first.size(); ++k) ids.push_back({pairs.first[k], pairs.second[k]});
  return ids;
}

TEST(PointQueries, PairsByCentresAndBySurfaces) {
  test::World world;
  for (const auto& s : std::vector<std::vector<double>>{{0, 0, 0, 2}, {3, 0, 0, 1}, {3.5, 0, 0, 0.25}, {9, 0, 0, 1}})
    world.add(s[0], s[1], s[2], s[3]);
  const SphereSet set = test::sphere_set(world);
  WideBuilder builder;
  const auto tree = builder.build(set).value();
  const auto by_centre = sphere_pairs(*tree, set, 3.0, {DistanceTo::centre, nullptr, 1});
  EXPECT_EQ(ids_of(*by_centre), (std::vector<std::array<std::int64_t, 2>>{{0, 1}, {1, 2}}));
  EXPECT_THAT(by_centre->distance, ElementsAre(3, 0.5));
  // Contacts: spheres that touch, and one that holds the other.
  const auto contacts = sphere_pairs(*tree, set, 0.0, {DistanceTo::surface, nullptr, 1});
  EXPECT_EQ(ids_of(*contacts), (std::vector<std::array<std::int64_t, 2>>{{0, 1}, {1, 2}}));
  EXPECT_THAT(contacts->distance, ElementsAre(0, -0.75));
  const std::uint8_t mask[] = {1, 0, 1, 1};
  EXPECT_EQ(ids_of(*sphere_pairs(*tree, set, 4.5, {DistanceTo::surface, mask, 1})),
            (std::vector<std::array<std::int64_t, 2>>{{0, 2}, {2, 3}}));
  EXPECT_TRUE(sphere_pairs(*tree, set, -kEverywhere)->first.empty());
  EXPECT_FALSE(sphere_pairs(*tree, set, std::numeric_limits<double>::quiet_NaN()).ok());
}

TEST(PointQueries, PairsAreThoseOfTestingAll) {
  const SphereSet set = random_set(400, 7);
  WideBuilder builder;
  const auto tree = builder.build(set).value();
  for (const DistanceTo to : {DistanceTo::centre, DistanceTo::surface}) {
    for (const double reach : {0.0, 0.3, 1.5}) {
      std::vector<std::array<std::int64_t, 2>> expected;
      for (std::int64_t i = 0; i < set.size(); ++i) {
        for (std::int64_t j = i + 1; j < set.size(); ++j) {
          const double limit = to == DistanceTo::surface ? reach + set.radius(i) : reach;
          const Vec3d from = set.stored_centre(i), at = set.stored_centre(j);
          if (sphere_distance(from, at, set.stored_radius(j), to) <= limit * set.scale()) expected.push_back({i, j});
        }
      }
      for (const int threads : {1, 3}) {
        const auto pairs = sphere_pairs(*tree, set, reach, {to, nullptr, threads});
        EXPECT_EQ(ids_of(*pairs), expected) << reach;
      }
    }
  }
}

TEST(PointQueries, CountsAreTheLengthsOfTheLists) {
  const SphereSet set = random_set(300, 9);
  WideBuilder builder;
  const auto tree = builder.build(set).value();
  std::vector<double> points, limits;
  for (std::int64_t i = 0; i < 100; ++i) {
    for (int axis = 0; axis < 3; ++axis) points.push_back(set.centre(i)[axis] + 0.1);
    limits.push_back(0.02 * static_cast<double>(i));
  }
  const PointSpan span = PointSpan::rows(points.data(), 100);
  const auto lists = spheres_within(*tree, span, limits.data());
  const auto counts = count_within(*tree, span, limits.data());
  ASSERT_EQ(counts->size(), 100U);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ((*counts)[i], lists->begin[i + 1] - lists->begin[i]);
  EXPECT_GT(lists->sphere_id.size(), 100U);
  limits[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(count_within(*tree, span, limits.data()).ok());
}

}  // namespace
}  // namespace bihive
