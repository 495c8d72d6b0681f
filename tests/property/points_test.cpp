// Points get the answers of brute force, bit for bit, on every target and any number of threads.
// ctest: kernel *ManyOfThem*
// ctest: share 3
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_distance.h"
#include "bihive/math/rng.h"
#include "bihive/simd/target.h"
#include "bihive/wide/point_queries.h"
#include "bihive/wide/wide_builder.h"
#include "support/brute_force_points.h"
#include "support/effort.h"
#include "support/hostile_sets.h"

namespace bihive {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();
using TreePointer = std::shared_ptr<const WideTree>;

TreePointer tree_of(const SphereSet& spheres, const WideParameters& parameters = {}) {
  WideBuilder builder;
  Result<TreePointer> tree = builder.build(spheres, parameters);
  BIHIVE_CHECK(tree.ok());
  return *tree;
}

struct PointSet {
  std::vector<double> xyz;

  std::int64_t count() const { return static_cast<std::int64_t>(xyz.size() / 3); }
  PointSpan span() const { return PointSpan::rows(xyz.data(), count()); }
  void add(Vec3d at) {
    constexpr double kLargest = 3.4e38;
    for (int axis = 0; axis < 3; ++axis) xyz.push_back(std::clamp(at[axis], -kLargest, kLargest));
  }
};

// Points around the set, far from it, at centres, on surfaces and within an ulp of them, and between centres.
PointSet points_for(const SphereSet& spheres, std::uint64_t seed, std::int64_t count) {
  SplitMix64 rng(seed);
  PointSet points;
  const SphereSet::Bounds box = spheres.bounds();
  double extent = 1;
  Vec3d middle{0, 0, 0};
  if (!spheres.empty()) {
    middle = 0.5 * (box.lo + box.hi);
    extent = std::max({box.hi.x - box.lo.x, box.hi.y - box.lo.y, box.hi.z - box.lo.z});
  }
  const auto cube = [&](double half) {
    const double x = test::uniform(rng, -half, half), y = test::uniform(rng, -half, half);
    return Vec3d{x, y, test::uniform(rng, -half, half)};
  };
  const auto any_sphere = [&] { return static_cast<std::int64_t>(rng.next_double() * double(spheres.total_size())); };
  points.add({0, 0, 0});
  points.add(middle);
  points.add({1e-300, -1e-300, 1e-310});
  for (std::int64_t i = 0; i < count; ++i) {
    const auto kind = spheres.empty() ? i % 2 : i % 8;
    if (kind == 0) {
      points.add(middle + cube(extent * 0.6));
    } else if (kind == 1) {
      points.add(middle + cube(extent * test::log_uniform(rng, 1, 1e30)));
    } else if (kind == 2) {
      points.add(spheres.centre(any_sphere()));
    } else if (kind <= 5) {
      const std::int64_t id = any_sphere();
      Vec3d at = spheres.centre(id);
      const int axis = static_cast<int>(rng.next_double() * 3);
      at[axis] += (rng.next_double() < 0.5 ? -1 : 1) * spheres.radius(id);
      if (kind == 4) at[axis] = std::nextafter(at[axis], kInf);
      if (kind == 5) at[axis] = std::nextafter(at[axis], -kInf);
      points.add(at);
    } else if (kind == 6) {
      points.add(0.5 * (spheres.centre(any_sphere()) + spheres.centre(any_sphere())));
    } else {
      const std::int64_t id = any_sphere();
      points.add(spheres.centre(id) + cube(2 * spheres.radius(id) + 0x1p-30 * extent));
    }
  }
  return points;
}

std::string place(const std::string& name, const PointSet& points, std::int64_t i) {
  char text[120];
  const double* const p = points.xyz.data() + 3 * i;
  std::snprintf(text, sizeof text, ", point %lld: %a %a %a", static_cast<long long>(i), p[0], p[1], p[2]);
  return name + text;
}

bool same(const SphereAtDistance& expected, double distance, std::int64_t id) {
  return expected.second == id && std::memcmp(&expected.first, &distance, sizeof distance) == 0;
}

void check_nearest(const std::string& name, const SphereSet& spheres, const WideTree& tree, const PointSet& points,
                   std::int64_t most, double within, const PointOptions& options) {
  const auto answer = nearest_spheres(tree, points.span(), most, within, options);
  ASSERT_TRUE(answer.ok()) << answer.error().to_string();
  ASSERT_EQ(answer->per_point, most);
  ASSERT_EQ(static_cast<std::int64_t>(answer->distance.size()), most * points.count());
  ASSERT_EQ(answer->distance.size(), answer->sphere_id.size());
  for (std::int64_t i = 0; i < points.count(); ++i) {
    auto expected = nearest_of_every_sphere(spheres, points.span().at(i), most, within, options.to, options.mask);
    expected.resize(static_cast<std::size_t>(most), {kInf, kNothing});
    for (std::int64_t k = 0; k < most; ++k) {
      const auto at = static_cast<std::size_t>(i * most + k);
      const SphereAtDistance& wanted = expected[static_cast<std::size_t>(k)];
      ASSERT_TRUE(same(wanted, answer->distance[at], answer->sphere_id[at]))
          << answer->sphere_id[at] << " at " << answer->distance[at] << ", not " << wanted.second << " at "
          << wanted.first << ", number " << k << " of " << most << ": " << place(name, points, i);
    }
  }
}

void check_lists(const std::string& name, const SphereSet& spheres, const PointSet& points,
                 const std::vector<double>& limits, const PointOptions& options, const Result<SphereLists>& answer) {
  ASSERT_TRUE(answer.ok()) << answer.error().to_string();
  ASSERT_EQ(static_cast<std::int64_t>(answer->begin.size()), points.count() + 1);
  ASSERT_EQ(answer->begin.front(), 0);
  ASSERT_EQ(answer->begin.back(), static_cast<std::int64_t>(answer->sphere_id.size()));
  ASSERT_EQ(answer->distance.size(), answer->sphere_id.size());
  for (std::int64_t i = 0; i < points.count(); ++i) {
    const auto expected = every_sphere_within(spheres, points.span().at(i), limits[static_cast<std::size_t>(i)],
                                              options.to, options.mask);
    const auto begin = static_cast<std::size_t>(answer->begin[static_cast<std::size_t>(i)]);
    const auto end = static_cast<std::size_t>(answer->begin[static_cast<std::size_t>(i) + 1]);
    ASSERT_EQ(end - begin, expected.size()) << place(name, points, i);
    for (std::size_t k = 0; k < expected.size(); ++k)
      ASSERT_TRUE(same(expected[k], answer->distance[begin + k], answer->sphere_id[begin + k]))
          << place(name, points, i);
  }
}

// Every pair by testing all, bit for bit.
void check_pairs(const std::string& name, const SphereSet& spheres, const WideTree& tree, double reach,
                 const PointOptions& options) {
  const auto answer = sphere_pairs(tree, spheres, reach, options);
  ASSERT_TRUE(answer.ok()) << answer.error().to_string();
  const bool to_surface = options.to == DistanceTo::surface;
  std::size_t at = 0;
  for (std::int64_t i = 0; i < spheres.size(); ++i) {
    const double radius = to_surface ? spheres.stored_radius(i) : 0;
    const double limit = reach * spheres.scale() + radius;
    for (std::int64_t j = i + 1; j < spheres.size(); ++j) {
      if (options.mask != nullptr && (options.mask[i] == 0 || options.mask[j] == 0)) continue;
      const double distance =
          sphere_distance(spheres.stored_centre(i), spheres.stored_centre(j), spheres.stored_radius(j), options.to);
      if (!(distance <= limit)) continue;
      ASSERT_LT(at, answer->first.size()) << name << ": " << i << " and " << j;
      ASSERT_EQ(answer->first[at], i) << name << ", reach " << reach;
      ASSERT_EQ(answer->second[at], j) << name << ", reach " << reach;
      ASSERT_EQ(answer->distance[at++], (distance - radius) * spheres.inverse_scale()) << name;
    }
  }
  ASSERT_EQ(answer->first.size(), at) << name;
}

// Limits from 0 to the size of the set, below 0 too.
std::vector<double> limits_for(const SphereSet& spheres, const PointSet& points, std::uint64_t seed) {
  SplitMix64 rng(seed);
  std::vector<double> limits;
  for (std::int64_t i = 0; i < points.count(); ++i) {
    const double radius = spheres.empty() ? 1 : spheres.radius(i % spheres.total_size());
    const double one = test::uniform(rng, -1, 3) * radius;
    limits.push_back(i % 5 == 0 ? 0 : i % 5 == 1 ? radius : i % 5 == 2 ? -0.5 * radius : i % 50 == 3 ? kInf : one);
  }
  return limits;
}

// Brute force takes the time, so each target and number of threads gets questions of its own.
void check_all(const std::string& name, const SphereSet& spheres, const WideTree& tree, std::uint64_t seed,
               std::int64_t count) {
  SplitMix64 rng(seed);
  std::vector<std::uint8_t> mask(static_cast<std::size_t>(spheres.total_size()));
  for (std::uint8_t& byte : mask) byte = rng.next_double() < 0.4 ? 0 : 1 + static_cast<std::uint8_t>(byte);
  for (const std::string& target : test::targets_under_test()) {
    ASSERT_TRUE(use_target(target).ok());
    for (const int threads : {1, 2, 7})
      for (const DistanceTo to : {DistanceTo::surface, DistanceTo::centre})
        for (const bool masked : {false, true}) {
          const PointSet points = points_for(spheres, ++seed, count);
          const std::vector<double> limits = limits_for(spheres, points, seed);
          const PointOptions options{to, masked ? mask.data() : nullptr, threads};
          const std::string form = name + ", " + target + ", " + std::to_string(threads) + " threads" +
                                   (masked ? ", masked" : "") + (to == DistanceTo::centre ? ", centres" : "");
          const double a_radius = spheres.empty() ? 1 : spheres.radius(0);
          check_nearest(form, spheres, tree, points, 1, kInf, options);
          check_nearest(form, spheres, tree, points, 7, kInf, options);
          check_nearest(form, spheres, tree, points, 3, a_radius, options);
          check_lists(form, spheres, points, limits, options,
                      spheres_within(tree, points.span(), limits.data(), options));
          // One reach each: of contacts, of a radius, of overlaps, of everything.
          if (threads == 2 && !spheres.has_images())
            check_pairs(form, spheres, tree, std::vector<double>{0, a_radius, -0.5 * a_radius, kInf}[seed % 4],
                        options);
          if (testing::Test::HasFatalFailure()) return;
        }
  }
  ASSERT_TRUE(use_target("").ok());
}

TEST(Points, AreAnsweredAsByBruteForce) {
  std::vector<test::World> worlds = test::degenerate_worlds();
  for (test::World& world : test::hostile_worlds(600, 600)) worlds.push_back(std::move(world));
  std::uint64_t seed = 900;
  int number = 0;
  for (const test::World& world : worlds) {
    if (!test::takes_set(number++)) continue;
    const SphereSet spheres = test::sphere_set(world);
    check_all(world.name, spheres, *tree_of(spheres), seed += 100, std::max<std::int64_t>(8, 40 / test::ray_share()));
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Points, OfAnyShapeOfTree) {
  const SphereSet spheres = test::sphere_set(test::nested_world(31, 60));
  for (const WideParameters parameters : {WideParameters{1, 0}, {100, 0}, {0, 1}, {0, 3}}) {
    check_all("nested", spheres, *tree_of(spheres, parameters), 77, 32);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Points, ManyOfThemAreSortedAndGetTheSameAnswers) {
  const std::int64_t count = 6000 / test::ray_share() + 4200;  // enough to be sorted
  const SphereSet spheres = test::sphere_set(test::random_world("many", 5, 4200, 10, 0.2, 0.9, 3, 4, 5));
  const TreePointer tree = tree_of(spheres);
  const PointSet points = points_for(spheres, 6, count);
  std::vector<double> limits = limits_for(spheres, points, 7);
  for (double& limit : limits) limit = std::min(limit, 2.0);
  check_nearest("many", spheres, *tree, points, 2, kInf, {DistanceTo::surface, nullptr, 2});
  check_lists("many", spheres, points, limits, {}, spheres_within(*tree, points.span(), limits.data(), {}));

  // The columns of a structure of arrays are the same points.
  std::vector<double> columns[3];
  for (std::size_t i = 0; i < points.xyz.size(); ++i) columns[i % 3].push_back(points.xyz[i]);
  const PointSpan span{points.count(), {columns[0].data(), columns[1].data(), columns[2].data()}, 1};
  EXPECT_EQ(nearest_spheres(*tree, span, 2)->distance, nearest_spheres(*tree, points.span(), 2)->distance);
}

TEST(Points, AnImageOfATreeHasMovedSpheres) {
  const test::World world = test::random_world("cell", 8, 300, 1, 0.02, 0.1);
  SphereSet spheres = test::sphere_set(world);
  ASSERT_TRUE(spheres.replicate({Vec3d{2.1, 0, 0}, {0.3, 2.2, 0}, {0, 0, 2.3}}, {2, 2, 1}).ok());
  const TreePointer tree = tree_of(spheres);
  const PointSet points = points_for(spheres, 9, 200);
  // The spheres of copy 3 alone, by a mask for brute force.
  const WideTree image = tree->image(spheres.images().shift(3) * spheres.scale());
  for (std::int64_t i = 0; i < points.count(); ++i) {
    std::vector<std::uint8_t> only(static_cast<std::size_t>(spheres.total_size()), 0);
    std::fill(only.end() - spheres.size(), only.end(), 1);
    const auto expected =
        nearest_of_every_sphere(spheres, points.span().at(i), 4, kInf, DistanceTo::surface, only.data());
    const auto answer = nearest_spheres(image, PointSpan::rows(points.xyz.data() + 3 * i, 1), 4);
    ASSERT_TRUE(answer.ok());
    for (std::size_t k = 0; k < 4; ++k)
      ASSERT_TRUE(same(expected[k], answer->distance[k], answer->sphere_id[k] + 3 * spheres.size()))
          << place("image", points, i);
  }
}

}  // namespace
}  // namespace bihive
