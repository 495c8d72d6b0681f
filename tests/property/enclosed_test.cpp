// Spheres inside others, which rays leave out where they can: every query gives the reference's bits on every target,
// and the builder knows which spheres those are.
// ctest: kernel
// ctest: share 4
#include "bihive/wide/build/enclosed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "bihive/wide/build/tuning.h"
#include "bihive/wide/wide_validate.h"
#include "support/effort.h"
#include "support/hostile_sets.h"
#include "support/query_rays.h"
#include "support/wide_under_test.h"

namespace bihive {
namespace {

using test::WideUnderTest;
using test::World;

// `count` spheres around a point, with radii up to `radius`, centres moved by up to `jitter`.
void add_shells(World& world, Vec3d at, double radius, int count, double jitter, std::uint64_t seed) {
  SplitMix64 rng(seed);
  for (int i = 0; i < count; ++i)
    world.add(at.x + test::uniform(rng, -jitter, jitter), at.y + test::uniform(rng, -jitter, jitter),
              at.z + test::uniform(rng, -jitter, jitter), radius * (i + 1) / count);
}

World shells(const std::string& name, double radius, int count, double jitter, Vec3d at = {}) {
  World world;
  world.name = name;
  add_shells(world, at, radius, count, jitter, 5);
  return world;
}

// Sets with enclosed spheres that rays leave out.
std::vector<World> nested_worlds() {
  std::vector<World> worlds;
  worlds.push_back(shells("shells", 1, 1200, 0));
  worlds.push_back(shells("shells, moved a little", 1, 1200, 1e-3));
  worlds.push_back(shells("shells, moved much", 1, 1200, 0.2));
  worlds.push_back(shells("shells far from 0", 1, 600, 0, {1000, -2000, 3000}));
  worlds.push_back(shells("shells as close as binary32 allows", 1, 1000, 0));
  for (std::size_t i = 0; i < 1000; ++i) worlds.back().r[i] = 1 - 0x1p-24F * static_cast<float>(i);
  for (const double factor : {1e-30, 1e20, 1e30})
    worlds.push_back(worlds[0].scaled(factor, "shells scaled by " + std::to_string(std::log10(factor))));

  // Some touch the largest one from inside at one point, others lie around its centre; then every one touches the next.
  World touching = shells("touching from inside", 0.99, 300, 0);
  for (int i = 1; i <= 512; ++i) touching.add(1 - i / 512.0, 0, 0, i / 512.0);
  worlds.push_back(touching);
  World chain;
  chain.name = "halves of halves";
  for (int i = 0; i < 500; ++i)
    chain.add(1 - std::ldexp(1, -i / 10), 0, 0, std::ldexp(1, -i / 10) * (1 - i % 10 / 16.0));
  for (int i = 0; i < 400; ++i) chain.add(0, 0, 0, 0.99 - i * 1e-4);
  worlds.push_back(chain);

  // Many clusters among other spheres, some of which reach into the clusters; duplicates inside and outside.
  World clusters = test::random_world("clusters", 7, 600, 10, 0.1, 0.8);
  SplitMix64 rng(8);
  for (int k = 0; k < 24; ++k)
    add_shells(clusters, {test::uniform(rng, -9, 9), test::uniform(rng, -9, 9), test::uniform(rng, -9, 9)}, 1, 300,
               k % 3 * 1e-3, 9 + static_cast<std::uint64_t>(k));
  for (std::size_t i = 0; i < 40; ++i)
    clusters.add(clusters.x[700 + i * 31], clusters.y[700 + i * 31], clusters.z[700 + i * 31],
                 clusters.r[700 + i * 31]);
  for (std::size_t i = 0; i < 40; ++i)  // the largest of clusters, and a pile of one of them
    clusters.add(clusters.x[899], clusters.y[899], clusters.z[899], clusters.r[i < 30 ? 899 : 890]);
  for (int i = 0; i < 40; ++i) clusters.add(clusters.x[900], clusters.y[900], clusters.z[900], clusters.r[900]);
  worlds.push_back(clusters);
  return worlds;
}

std::vector<Ray> query_rays(const World& world, const WideUnderTest& wide, std::uint64_t seed, std::int64_t count) {
  test::QueryRays rays(world, seed, [&](const Ray& ray) { return wide.truth(ray); });
  std::vector<Ray> list;
  for (std::int64_t i = 0; i < count; ++i) list.push_back(rays.next());
  return list;
}

// Rays that start at hits of others, as in pictures: on either side, or a little off the surface.
std::vector<Ray> rays_from_hits(const World& world, const WideUnderTest& wide, std::uint64_t seed, std::int64_t count) {
  SplitMix64 rng(seed);
  std::vector<Ray> list;
  for (const Ray& ray : query_rays(world, wide, seed + 1, count)) {
    const Hit hit = wide.truth(ray);
    if (!hit.found() || !std::isfinite(hit.t)) continue;
    Ray next;
    for (int axis = 0; axis < 3; ++axis) {
      next.origin[axis] = static_cast<float>(double(ray.origin[axis]) + hit.t * double(ray.direction[axis]));
      next.direction[axis] = static_cast<float>(test::uniform(rng, -1, 1));
    }
    if (rng.next_below(4) != 0) next.leaves = hit.sphere_id;
    next.inside = rng.next_below(2) == 0;
    if (rng.next_below(4) == 0) next.t_max = test::uniform(rng, 0, 2);
    list.push_back(next);
  }
  return list;
}

TEST(Enclosed, QueriesEqualTheReference) {
  const std::int64_t count = 4000 / test::ray_share();
  std::int64_t sets = 0;
  for (const World& world : nested_worlds()) {
    if (!test::takes_set(sets++)) continue;
    SCOPED_TRACE(world.name);
    WideUnderTest wide(world, {{}, {3, 0}});
    for (const std::size_t shape : {0, 1}) {
      ASSERT_NE(wide.tree(shape).outer, nullptr);
      const Status status = validate_wide_tree(wide.tree(shape), wide.spheres());
      ASSERT_TRUE(status.ok()) << (status.ok() ? "" : status.error().to_string());
    }
    wide.check(query_rays(world, wide, 11, count), count / 4);
    wide.check(rays_from_hits(world, wide, 12, count), count / 4);
    wide.check(test::blocks_of_rays(world, 13, count / 128, [&](const Ray& ray) { return wide.truth(ray); }),
               count / 8);
    EXPECT_GT(wide.hits(), count / 4);
    if (testing::Test::HasFatalFailure()) return;
  }
}

// In long double: a sphere that the outer tree leaves out lies in a core, and below the surface of one that it keeps.
TEST(Enclosed, SpheresLieInCores) {
  for (const World& world : nested_worlds()) {
    SCOPED_TRACE(world.name);
    const WideUnderTest wide(world);
    const WideTree& tree = wide.tree();
    ASSERT_NE(tree.outer, nullptr);
    std::vector<bool> is_outer(world.size());
    for (std::int64_t slot = 0; slot < tree.outer->tree.placed; ++slot)
      is_outer[static_cast<std::size_t>(tree.outer->tree.spheres.id(slot))] = true;
    const auto holds = [](Vec3d centre, long double radius, Vec3d inner, long double inner_radius) {
      const long double x = static_cast<long double>(inner.x) - centre.x;
      const long double y = static_cast<long double>(inner.y) - centre.y;
      const long double z = static_cast<long double>(inner.z) - centre.z;
      return std::sqrt(x * x + y * y + z * z) + inner_radius <= radius;
    };
    std::int64_t left_out = 0;
    for (std::int64_t slot = 0; slot < tree.placed; ++slot) {
      if (is_outer[static_cast<std::size_t>(tree.spheres.id(slot))]) continue;
      ++left_out;
      const Vec3d centre = tree.spheres.centre(slot);
      const double radius = tree.spheres.radius(slot);
      bool in_core = false, in_sphere = false;
      for (const Core& core : tree.outer->cores) in_core = in_core || holds(core.centre, core.radius, centre, radius);
      for (std::int64_t k = 0; k < tree.outer->tree.placed; ++k)
        in_sphere =
            in_sphere || holds(tree.outer->tree.spheres.centre(k), tree.outer->tree.spheres.radius(k), centre, radius);
      ASSERT_TRUE(in_core && in_sphere) << "sphere " << tree.spheres.id(slot);
    }
    EXPECT_GE(left_out, kFewestCrossed);
  }
}

// Ordinary sets have no outer tree, nor do those in which few spheres lie inside others.
TEST(Enclosed, NothingIsLeftOutOfOtherSets) {
  std::vector<World> worlds{test::random_world("sizes", 21, 3000, 10, 0.1, 0.5), shells("few shells", 1, 150, 0),
                            test::random_world("equal, and deep in each other", 22, 2000, 10, 4, 4)};
  worlds.push_back(test::random_world("small in a huge one", 23, 2000, 1, 1e-3, 1e-2));
  worlds.back().add(0, 0, 0, 4);
  worlds.push_back({});
  for (const World& world : worlds) {
    if (world.size() == 0) continue;
    const WideUnderTest wide(world);
    EXPECT_EQ(wide.tree().outer, nullptr) << world.name;
  }
}

// A tree whose memory is used again does not keep what the previous set had.
TEST(Enclosed, NothingRemainsForTheNextSet) {
  WideBuilder builder;
  const SphereSet nested = test::sphere_set(shells("shells", 1, 500, 0));
  const SphereSet other = test::sphere_set(test::random_world("other", 24, 500, 10, 0.1, 0.5));
  auto tree = *builder.build(nested);
  ASSERT_NE(tree->outer, nullptr);
  EXPECT_EQ(tree->outer->tree.placed, 1);
  EXPECT_GT(tree->used_bytes(), tree->outer->used_bytes() + 500 * 16);
  tree.reset();
  tree = *builder.build(other);
  EXPECT_EQ(tree->outer, nullptr);
}

}  // namespace
}  // namespace bihive
