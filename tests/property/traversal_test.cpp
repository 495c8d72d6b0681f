// The reference traversal gives brute force's answer, bit for bit, and both give the oracle's.
#include "bihive/bih/traversal.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "bihive/bih/reference_builder.h"
#include "bihive/render/query/brute_force.h"
#include "support/edge_rays.h"
#include "support/hostile_sets.h"
#include "support/oracle.h"

namespace bihive {
namespace {

bool same_bits(const Hit& a, const Hit& b) {
  return a.sphere_id == b.sphere_id && std::memcmp(&a.t, &b.t, sizeof a.t) == 0;
}

std::string text_of(const Hit& hit) {
  char line[80];
  std::snprintf(line, sizeof line, "%a of %lld", hit.t, static_cast<long long>(hit.sphere_id));
  return line;
}

std::vector<Tree> trees_of(const SphereSet& spheres) {
  std::vector<Tree> trees;
  for (const BuildParameters& parameters : {BuildParameters{1, kUnlimited}, BuildParameters{8, kUnlimited},
                                            BuildParameters{1, 4}, BuildParameters{kUnlimited, 1}})
    trees.push_back(build_reference_tree(spheres, parameters));
  return trees;
}

struct Counts {
  int rays = 0, hits = 0;
};

/// Compares every tree with brute force and brute force with the oracle on one ray.
void check_ray(const std::vector<Tree>& trees, const SphereSet& spheres, const test::Oracle& oracle, const Ray& ray,
               Counts& counts) {
  const Hit truth = closest_hit(spheres, ray);
  const bool any = occluded(spheres, ray);
  ++counts.rays;
  counts.hits += truth.found() ? 1 : 0;
  ASSERT_EQ(any, truth.found()) << test::text_of(ray);
  for (const Tree& tree : trees) {
    const Hit found = closest_hit(tree, spheres, ray);
    ASSERT_TRUE(same_bits(found, truth)) << text_of(found) << ", not " << text_of(truth) << ": " << test::text_of(ray)
                                         << ", max_prims " << tree.parameters.max_prims << ", max_depth "
                                         << tree.parameters.max_depth;
    ASSERT_EQ(occluded(tree, spheres, ray), any) << test::text_of(ray);
  }
  const auto encounters = oracle.encounters(ray);
  ASSERT_TRUE(oracle.accepts(ray, encounters, truth.t, truth.sphere_id))
      << text_of(truth) << ", oracle " << double(test::Oracle::closest(ray, encounters).t) << " of "
      << test::Oracle::closest(ray, encounters).id << ": " << test::text_of(ray);
}

TEST(Traversal, EqualsBruteForceOnDegenerateSets) {
  Counts counts;
  for (const test::World& world : test::degenerate_worlds()) {
    if (world.size() == 0) continue;
    SCOPED_TRACE(world.name);
    const SphereSet spheres = test::sphere_set(world);
    const std::vector<Tree> trees = trees_of(spheres);
    const test::Oracle oracle(world);
    test::EdgeRays rays(world, 51);
    for (int i = 0; i < 3000 && !testing::Test::HasFatalFailure(); ++i)
      check_ray(trees, spheres, oracle, rays.next(), counts);
  }
  EXPECT_GT(counts.hits, counts.rays / 5);
}

TEST(Traversal, EqualsBruteForceOnRandomSets) {
  Counts counts;
  for (std::uint64_t seed = 1; seed <= 150 && !testing::Test::HasFatalFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    SplitMix64 rng(seed);
    const int count = static_cast<int>(test::log_uniform(rng, 1, 300));
    const double half = test::log_uniform(rng, 1e-6, 1e6);
    const double r_lo = half * test::log_uniform(rng, 1e-5, 1), r_hi = r_lo * test::log_uniform(rng, 1.01, 1e4);
    const double away = rng.next_below(2) == 0 ? 0 : half * test::log_uniform(rng, 1, 1e4);
    const test::World world = test::random_world("random", seed, count, half, r_lo, r_hi, away, -away, away * 0.3);
    const SphereSet spheres = test::sphere_set(world);
    const std::vector<Tree> trees = trees_of(spheres);
    const test::Oracle oracle(world);
    test::EdgeRays rays(world, seed);
    for (int i = 0; i < 1000 && !testing::Test::HasFatalFailure(); ++i)
      check_ray(trees, spheres, oracle, rays.next(), counts);
  }
  EXPECT_GT(counts.hits, counts.rays / 5);
}

TEST(Traversal, EndsOfASegmentExactlyAtTheHit) {
  const test::World world = test::random_world("random", 52, 200, 10, 0.2, 3);
  const SphereSet spheres = test::sphere_set(world);
  const std::vector<Tree> trees = trees_of(spheres);
  const test::Oracle oracle(world);
  test::RayMaker rays(world, 52);
  Counts counts;
  for (std::uint64_t i = 0; i < 4000 && !testing::Test::HasFatalFailure(); ++i) {
    Ray ray = rays(i);
    const Hit hit = closest_hit(spheres, ray);
    if (!hit.found()) continue;
    ray.t_max = hit.t;
    EXPECT_TRUE(same_bits(closest_hit(spheres, ray), hit)) << test::text_of(ray);
    check_ray(trees, spheres, oracle, ray, counts);
    ray.t_max = std::nextafter(hit.t, -HUGE_VAL);
    if (ray.t_min <= ray.t_max) check_ray(trees, spheres, oracle, ray, counts);
    EXPECT_FALSE(closest_hit(spheres, ray).found()) << test::text_of(ray);
    ray.t_max = HUGE_VAL;
    ray.t_min = hit.t;
    EXPECT_TRUE(same_bits(closest_hit(spheres, ray), hit)) << test::text_of(ray);
    check_ray(trees, spheres, oracle, ray, counts);
    ray.t_min = std::nextafter(hit.t, HUGE_VAL);
    check_ray(trees, spheres, oracle, ray, counts);
  }
  EXPECT_GT(counts.rays, 3000);
}

TEST(Traversal, AnInvalidRayHitsNothing) {
  const test::World world = test::pile("pile", 20, 0, 0, 0, 1);
  const SphereSet spheres = test::sphere_set(world);
  const Tree tree = build_reference_tree(spheres, {1, kUnlimited});
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  std::vector<Ray> rays{{{0, 0, 0}, {0, 0, 0}}, {{0, 0, 5}, {0, 0, -1}, 6, 5}, {{0, 0, 5}, {0, 0, -1}, double(nan), 9}};
  for (const float bad : {nan, inf, -inf})
    for (int axis = 0; axis < 3; ++axis) {
      rays.push_back({{0, 0, 0}, {1, 1, 1}});
      rays.back().origin[axis] = bad;
      rays.push_back({{0, 0, 0}, {1, 1, 1}});
      rays.back().direction[axis] = bad;
    }
  for (const Ray& ray : rays) {
    EXPECT_TRUE(same_bits(closest_hit(tree, spheres, ray), Hit{})) << test::text_of(ray);
    EXPECT_TRUE(same_bits(closest_hit(spheres, ray), Hit{})) << test::text_of(ray);
    EXPECT_FALSE(occluded(tree, spheres, ray)) << test::text_of(ray);
    EXPECT_FALSE(occluded(spheres, ray)) << test::text_of(ray);
  }
}

TEST(Traversal, OfNoSpheresHitsNothing) {
  const SphereSet spheres = test::sphere_set({});
  const Tree tree = build_reference_tree(spheres, {1, kUnlimited});
  EXPECT_FALSE(closest_hit(tree, spheres, {{0, 0, 0}, {0, 0, 1}}).found());
  EXPECT_FALSE(closest_hit(spheres, {{0, 0, 0}, {0, 0, 1}}).found());
}

TEST(Traversal, OfEqualSpheresTheSmallestIdIsHit) {
  test::World world = test::pile("pile", 40, 0, 0, 0, 1);
  for (int i = 0; i < 20; ++i) world.add(10 + i, 0, 0, 0.25);
  const SphereSet spheres = test::sphere_set(world);
  for (const Tree& tree : trees_of(spheres)) {
    EXPECT_EQ(closest_hit(tree, spheres, {{0.25f, 0.5f, 5}, {0, 0, -1}}).sphere_id, 0);
    Ray ray{{0, 0, 1}, {0, 0, -1}};
    ray.leaves = 0;
    EXPECT_EQ(closest_hit(tree, spheres, ray).sphere_id, kNothing) << "the whole pile has the surface that is left";
    ray.inside = true;
    EXPECT_EQ(closest_hit(tree, spheres, ray).sphere_id, 0);
    EXPECT_EQ(closest_hit(tree, spheres, ray).t, 2);
  }
}

TEST(Observer, CountsWhatIsVisited) {
  const test::World world = test::random_world("random", 53, 300, 10, 0.2, 1);
  const SphereSet spheres = test::sphere_set(world);
  const Tree tree = build_reference_tree(spheres, {2, kUnlimited});
  test::RayMaker rays(world, 53);
  std::int64_t tree_tests = 0, all_tests = 0;
  for (std::uint64_t i = 0; i < 2000; ++i) {
    const Ray ray = rays(i);
    const ScaledRay scaled(ray, spheres);
    CountingObserver brute, hierarchy, any;
    const Hit truth = test_all_spheres<false>(spheres, scaled, brute);
    EXPECT_EQ(brute.sphere_tests, spheres.size());
    EXPECT_EQ(brute.node_visits + brute.leaf_visits + brute.empty_gaps, 0);
    EXPECT_TRUE(same_bits((traverse<false>(tree, spheres, scaled, hierarchy)), truth)) << "counting changes nothing";
    EXPECT_EQ((traverse<true>(tree, spheres, scaled, any).found()), truth.found());
    EXPECT_LE(any.sphere_tests, spheres.size());
    EXPECT_LE(hierarchy.sphere_tests, spheres.size()) << "no leaf twice";
    EXPECT_LE(hierarchy.empty_gaps, hierarchy.node_visits);
    tree_tests += hierarchy.sphere_tests;
    all_tests += brute.sphere_tests;
  }
  EXPECT_LT(tree_tests, all_tests / 10) << "the tree spares most tests";
  EXPECT_GT(tree_tests, 0);
}

TEST(Observer, SeesEverythingWhereNothingCanBeSpared) {
  // All spheres overlap in the middle. A ray that starts there, and reaches every surface at its end only, meets every
  // node.
  const test::World world = test::random_world("overlapping", 54, 100, 1, 4, 4.5);
  const SphereSet spheres = test::sphere_set(world);
  const Tree tree = build_reference_tree(spheres, {1, kUnlimited});
  Ray ray{{0, 0, 0}, {0.3f, 0.2f, 1}};
  ray.t_max = 1e-3;  // ends before any surface
  CountingObserver counts;
  EXPECT_FALSE(traverse<false>(tree, spheres, ScaledRay(ray, spheres), counts).found());
  EXPECT_EQ(counts.sphere_tests, spheres.size());
  EXPECT_EQ(counts.node_visits + counts.leaf_visits, static_cast<std::int64_t>(tree.nodes.size()));
}

TEST(Observer, CountsTheGapBetweenTwoSpheres) {
  test::World world = test::pile("two", 1, -3, 0, 0, 1);
  world.add(3, 0, 0, 1);
  const SphereSet spheres = test::sphere_set(world);
  const Tree tree = build_reference_tree(spheres, {1, kUnlimited});
  const auto counts_of = [&](const Ray& ray) {
    CountingObserver counts;
    traverse<false>(tree, spheres, ScaledRay(ray, spheres), counts);
    return counts;
  };
  // Down the gap: the root is entered, its gap passed, no leaf.
  const CountingObserver between = counts_of({{0, 0, 10}, {0, 0, -1}});
  EXPECT_EQ(between.empty_gaps, 1);
  EXPECT_EQ(between.node_visits, 1);
  EXPECT_EQ(between.leaf_visits, 0);
  // Down onto a sphere: no gap.
  const CountingObserver onto = counts_of({{3, 0, 10}, {0, 0, -1}});
  EXPECT_EQ(onto.empty_gaps, 0);
  EXPECT_EQ(onto.leaf_visits, 1);
  EXPECT_EQ(onto.sphere_tests, 1);
  // Along x above both, within their boxes: both leaves, one gap.
  const CountingObserver across = counts_of({{-10, 0.9f, 0.9f}, {1, 0, 0}});
  EXPECT_EQ(across.empty_gaps, 1);
  EXPECT_EQ(across.leaf_visits, 2);
}

}  // namespace
}  // namespace bihive
