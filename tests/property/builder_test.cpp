// The reference builder on random and degenerate sets: always a valid tree, within its limits, in reasonable time.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "bihive/bih/memory.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/bih/validate.h"
#include "support/hostile_sets.h"
#include "support/thread_time.h"

namespace bihive {
namespace {

/// All properties that hold for any tree.
void check_tree(const SphereSet& spheres, const BuildParameters& parameters, const std::string& name) {
  SCOPED_TRACE(name + ", max_prims " + std::to_string(parameters.max_prims) + ", max_depth " +
               std::to_string(parameters.max_depth));
  const Tree tree = build_reference_tree(spheres, parameters);
  const Status status = validate_tree(tree, spheres);
  ASSERT_TRUE(status.ok()) << status.error().to_string();
  const TreeStatistics s = tree_statistics(tree);
  EXPECT_EQ(s.spheres, spheres.size());
  EXPECT_EQ(s.inner_nodes, s.leaves - 1 + s.optimized_nodes);
  EXPECT_LE(s.depth.max, parameters.max_depth);
  EXPECT_LE(s.depth.max, 1000);
  EXPECT_EQ(s.inner_nodes + s.leaves - tree.empty_leaves, static_cast<std::int64_t>(tree.nodes.size()));
  EXPECT_EQ(s.one_sided_nodes, tree.empty_leaves);
  if (s.forced_leaves == 0 && parameters.max_depth == kUnlimited) {
    EXPECT_LE(s.spheres_per_leaf.max, parameters.max_prims);
  }
}

TEST(Builder, IsRightOnDegenerateSets) {
  for (const test::World& world : test::degenerate_worlds()) {
    const SphereSet spheres = test::sphere_set(world);
    for (const std::int64_t max_prims :
         {std::int64_t{1}, std::int64_t{2}, std::int64_t{8}, std::int64_t{16}, kUnlimited})
      for (const std::int64_t max_depth :
           {std::int64_t{1}, std::int64_t{2}, std::int64_t{3}, std::int64_t{7}, std::int64_t{20}, kUnlimited})
        check_tree(spheres, {max_prims, max_depth}, world.name);
  }
}

TEST(Builder, IsRightOnRandomSets) {
  // Counts, extents, radii and places over many orders of magnitude; the seed is the loop's number.
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SplitMix64 rng(seed);
    const int count = static_cast<int>(test::log_uniform(rng, 1, 400));
    const double half = test::log_uniform(rng, 1e-6, 1e6);
    const double r_lo = half * test::log_uniform(rng, 1e-6, 1), r_hi = r_lo * test::log_uniform(rng, 1.01, 1e5);
    const double away = rng.next_below(2) == 0 ? 0 : half * test::log_uniform(rng, 1, 1e6);
    const test::World world = test::random_world("random", seed, count, half, r_lo, r_hi, away, -away, away * 0.3);
    check_tree(test::sphere_set(world), {1 + static_cast<std::int64_t>(rng.next_below(16)), kUnlimited},
               "seed " + std::to_string(seed));
    check_tree(test::sphere_set(world), {1, 1 + static_cast<std::int64_t>(rng.next_below(12))},
               "seed " + std::to_string(seed));
  }
}

TEST(Builder, IsRightAndQuickOnLargeSets) {
  // Each takes well below a second. Ten seconds would mean that the time grows faster than the count.
  std::vector<test::World> worlds;
  worlds.push_back(test::random_world("100,000 random", 41, 100000, 10, 0.01, 0.1));
  worlds.push_back(test::pile("100,000 in one place", 100000, 0, 0, 0, 1));
  worlds.push_back(test::pile("1,000 at each power of two", 0, 0, 0, 0, 0));
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 1000; ++k) worlds.back().add(std::ldexp(1, -i), 0, 0, std::ldexp(1, -i - 3));
  worlds.push_back(test::coincident_world(42, 1000, 100));
  for (const test::World& world : worlds) {
    const SphereSet spheres = test::sphere_set(world);
    for (const std::int64_t max_prims : {1, 8}) {
      const double start = test::thread_time_ms();
      check_tree(spheres, {max_prims, kUnlimited}, world.name);
      EXPECT_LT(test::thread_time_ms() - start, 10000) << world.name;
    }
  }
}

TEST(Builder, DependsOnTheSpheresAlone) {
  const SphereSet spheres = test::sphere_set(test::random_world("random", 43, 500, 10, 0.1, 1));
  const Tree a = build_reference_tree(spheres, {4, kUnlimited}), b = build_reference_tree(spheres, {4, kUnlimited});
  EXPECT_EQ(a.sphere_ids, b.sphere_ids);
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t i = 0; i < a.nodes.size(); ++i) {
    EXPECT_EQ(a.nodes[i].first, b.nodes[i].first);
    EXPECT_EQ(a.nodes[i].left_clip, b.nodes[i].left_clip);
    EXPECT_EQ(a.nodes[i].right_clip, b.nodes[i].right_clip);
  }
}

TEST(Builder, MakesTheSameTreeAtEveryScale) {
  // A power of two changes no decision.
  const test::World world = test::random_world("random", 44, 500, 10, 0.1, 1);
  const Tree a = build_reference_tree(test::sphere_set(world), {1, kUnlimited});
  for (const int exponent : {-60, 60}) {
    const test::World scaled = world.scaled(std::ldexp(1, exponent), "scaled");
    const Tree b = build_reference_tree(test::sphere_set(scaled), {1, kUnlimited});
    EXPECT_EQ(a.sphere_ids, b.sphere_ids);
    EXPECT_EQ(a.nodes.size(), b.nodes.size());
  }
}

}  // namespace
}  // namespace bihive
