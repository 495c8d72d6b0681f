// The wide tree is right for any spheres and parameters, and its memory is used again.
// ctest: kernel
// ctest: threads
#include "bihive/wide/wide_builder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "bihive/simd/target.h"
#include "bihive/wide/build/count_limit.h"
#include "bihive/wide/queries.h"
#include "bihive/wide/wide_validate.h"
#include "support/effort.h"
#include "support/hostile_sets.h"

namespace bihive {
namespace {

using TreePointer = std::shared_ptr<const WideTree>;

TreePointer built(WideBuilder& builder, const SphereSet& spheres, const WideParameters& parameters = {},
                  int threads = 0) {
  Result<TreePointer> tree = builder.build(spheres, parameters, threads);
  EXPECT_TRUE(tree.ok());
  return *tree;
}

// All bytes that tracing reads.
std::string bytes_of(const WideTree& tree) {
  std::string bytes;
  const auto add = [&](const void* data, std::size_t size) {
    if (data != nullptr) bytes.append(static_cast<const char*>(data), size);
  };
  add(tree.nodes, static_cast<std::size_t>(tree.node_count) * sizeof(WideNode));
  const std::size_t an_array = tree.placed > 0 ? static_cast<std::size_t>(tree.placed + kWidth) * 4 : 0;
  for (const float* array : {tree.spheres.x, tree.spheres.y, tree.spheres.z, tree.spheres.r}) add(array, an_array);
  add(tree.spheres.word, an_array);
  add(tree.spheres.palette.data(), sizeof(tree.spheres.palette));
  add(tree.repeated.data(), tree.repeated.size() * sizeof(RepeatedSphere));
  add(tree.piles.data(), tree.piles.size() * sizeof(Pile));
  add(tree.others_in_piles.data(), tree.others_in_piles.size() * sizeof(std::uint32_t));
  return bytes;
}

std::vector<test::World> all_worlds() {
  std::vector<test::World> worlds = test::degenerate_worlds();
  for (test::World& world : test::hostile_worlds(4096, 3000)) worlds.push_back(std::move(world));
  for (const int n : {1, 2, 15, 16, 17, 255, 256, 257, 5000})
    worlds.push_back(test::random_world(std::to_string(n) + " random", 7, n, 10, 0.5, 0.5));
  return worlds;
}

TEST(WideBuilder, BuildsRightTrees) {
  WideBuilder builder;
  for (const test::World& world : all_worlds()) {
    const SphereSet spheres = test::sphere_set(world);
    for (const WideParameters parameters : {WideParameters{}, {1, 0}, {5, 0}, {1000, 0}, {0, 1}, {0, 2}, {4, 3}}) {
      const TreePointer tree = built(builder, spheres, parameters);
      const Status status = validate_wide_tree(*tree, spheres);
      EXPECT_TRUE(status.ok()) << world.name << ": " << (status.ok() ? "" : status.error().to_string());
      if (parameters.max_depth > 0 && !spheres.empty()) {
        EXPECT_LE(tree->levels, std::max<std::int64_t>(1, parameters.max_depth - 1)) << world.name;
      } else if (parameters.max_prims > 0) {
        EXPECT_LE(tree->largest_leaf, parameters.max_prims) << world.name;
      } else {
        EXPECT_LE(tree->largest_leaf, kWidth) << world.name;
      }
      if (parameters.max_depth == 1) {
        EXPECT_EQ(tree->largest_leaf, tree->placed) << world.name;
      }
    }
  }
}

TEST(WideBuilder, RadiiFromAPaletteOrPlain) {
  for (const int radii : {1, 31, 40})
    for (const bool with_zero : {false, true}) {
      test::World world;
      for (int i = 0; i < 400; ++i) world.add(i % 20, i / 20, i % 7, i % radii * 0.01 + 0.01);
      if (with_zero) world.add(3, 3, 3, 0);
      const SphereSet spheres = test::sphere_set(world);
      WideBuilder builder;
      const TreePointer tree = built(builder, spheres);
      EXPECT_EQ(tree->spheres.has_palette, radii <= 31);
      EXPECT_EQ(tree->spheres.palette_size, radii > 31 ? 0 : with_zero ? 32 : radii);
      const Status status = validate_wide_tree(*tree, spheres);
      EXPECT_TRUE(status.ok()) << status.error().to_string();
    }
}

TEST(WideBuilder, KnowsSpheresThatAreEqual) {
  test::World world = test::random_world("some", 5, 1000, 10, 0.5, 0.5);
  for (const int i : {3, 500, 3, 900}) world.add(world.x[i], world.y[i], world.z[i], world.r[i]);
  world.add(world.x[7], world.y[7], world.z[7], 0.25);
  world.add(0.0, 1, 2, 0.25);
  world.add(-0.0, 1, 2, 0.25);
  WideBuilder builder;
  const TreePointer tree = built(builder, test::sphere_set(world));
  std::vector<std::uint32_t> ids;
  for (const RepeatedSphere& sphere : tree->repeated) ids.push_back(sphere.id);
  EXPECT_EQ(ids, (std::vector<std::uint32_t>{3, 500, 900, 1000, 1001, 1002, 1003, 1005, 1006}));
}

// A ray tests one sphere of a pile, however high it is.
TEST(WideBuilder, APileTakesOnePlace) {
  WideBuilder builder;
  test::World world = test::random_world("some", 5, 1000, 10, 0.5, 0.5);
  for (int i = 0; i < 10000; ++i) world.add(world.x[3], world.y[3], world.z[3], world.r[3]);
  for (int i = 0; i < 20; ++i) world.add(20, 20, 20, i % 2 == 0 ? 0.5 : 0.25);
  const SphereSet spheres = test::sphere_set(world);
  const TreePointer tree = built(builder, spheres);
  EXPECT_EQ(tree->size, 11020);
  EXPECT_EQ(tree->placed, 1020) << "ten equal ones are no pile";
  ASSERT_EQ(tree->piles.size(), 1U);
  EXPECT_EQ(tree->piles[0].id, 3U);
  EXPECT_EQ(tree->others_in_piles.size(), 10000U);
  EXPECT_EQ(tree->repeated.size(), 10021U);
  EXPECT_LE(tree->largest_leaf, kWidth);
  const Status status = validate_wide_tree(*tree, spheres);
  EXPECT_TRUE(status.ok()) << (status.ok() ? "" : status.error().to_string());

  // All hits are those of all spheres.
  RayBatch rays;
  Ray ray;
  ray.origin = {world.x[3], world.y[3], world.z[3] + 100};
  ray.direction = {0, 0, -1};
  rays.push_back(ray);
  ray.leaves = 1005;
  rays.push_back(ray);
  std::vector<RayHit> hits;
  all_hits(*tree, rays.span(), hits);
  std::int64_t of_pile[2] = {0, 0};
  for (std::size_t i = 0; i < hits.size(); ++i) {
    if (hits[i].sphere_id == 3 || (hits[i].sphere_id >= 1000 && hits[i].sphere_id < 11000)) ++of_pile[hits[i].ray];
    if (i > 0 && hits[i].ray == hits[i - 1].ray && hits[i].t == hits[i - 1].t) {
      EXPECT_LT(hits[i - 1].sphere_id, hits[i].sphere_id);
    }
  }
  EXPECT_EQ(of_pile[0], 10001);
  EXPECT_EQ(of_pile[1], 0) << "a ray that leaves one of them leaves all";
}

TEST(WideBuilder, TheSameTreeForEveryNumberOfThreadsAndEveryTarget) {
  std::vector<test::World> worlds = all_worlds();
  worlds.push_back(test::random_world("large", 11, 200000, 10, 0.01, 0.01));
  for (int i = 0; i < 1000; ++i) worlds.back().add(worlds.back().x[i], worlds.back().y[i], worlds.back().z[i], 0.01);
  const std::size_t enough = test::test_share() > 16 ? worlds.size() : worlds.max_size();
  worlds.push_back(test::random_world("large, many radii", 12, 160000, 10, 0.001, 0.1));
  worlds.push_back(test::exponential_world("large, one corner", 120, 7, 0.25));
  for (int i = 0; i < 160000; ++i) worlds.back().add(1e-3 * (i % 401), 1e-3 * (i % 409), 1e-3 * (i % 419), 1e-4);
  worlds.resize(std::min(worlds.size(), enough));
  for (const test::World& world : worlds) {
    const SphereSet spheres = test::sphere_set(world);
    WideBuilder builder;
    const TreePointer expected = built(builder, spheres, {}, 1);
    if (spheres.size() > 100000) {
      const Status status = validate_wide_tree(*expected, spheres);
      EXPECT_TRUE(status.ok()) << world.name << ": " << (status.ok() ? "" : status.error().to_string());
    }
    const std::string bytes = bytes_of(*expected);
    for (const int threads : {2, 4})
      EXPECT_TRUE(bytes_of(*built(builder, spheres, {}, threads)) == bytes) << world.name;
    for (const std::string& target : available_targets()) {
      ASSERT_TRUE(use_target(target).ok());
      EXPECT_TRUE(bytes_of(*built(builder, spheres)) == bytes) << world.name << " on " << target;
    }
    ASSERT_TRUE(use_target("").ok());
  }
}

TEST(WideBuilder, TheSameTreeWhateverWasBuiltBefore) {
  const SphereSet spheres = test::sphere_set(test::random_world("random", 9, 3000, 10, 0.1, 0.6));
  const SphereSet others = test::sphere_set(test::coincident_world(10, 800, 5));
  WideBuilder fresh, used;
  const TreePointer expected = built(fresh, spheres);
  built(used, others);
  EXPECT_EQ(bytes_of(*built(used, spheres)), bytes_of(*expected));
}

TEST(WideBuilder, ADroppedTreesMemoryIsUsedAgain) {
  const SphereSet spheres = test::sphere_set(test::random_world("random", 9, 3000, 10, 0.1, 0.6));
  WideBuilder builder;
  TreePointer tree = built(builder, spheres);
  const void* const nodes = tree->nodes;
  const void* const x = tree->spheres.x;
  tree.reset();
  tree = built(builder, spheres);
  EXPECT_EQ(tree->nodes, nodes);
  EXPECT_EQ(tree->spheres.x, x);
}

TEST(WideBuilder, AHeldTreeStaysAsItIs) {
  const SphereSet spheres = test::sphere_set(test::random_world("random", 9, 3000, 10, 0.1, 0.6));
  const SphereSet others = test::sphere_set(test::random_world("others", 10, 3000, 10, 0.1, 0.6));
  TreePointer held;
  {
    WideBuilder builder;
    held = built(builder, spheres);
    const std::string before = bytes_of(*held);
    for (int i = 0; i < 3; ++i) {
      const TreePointer other = built(builder, others);
      EXPECT_NE(other->nodes, held->nodes);
      EXPECT_NE(other->spheres.x, held->spheres.x);
    }
    EXPECT_EQ(bytes_of(*held), before);
  }
  // The tree outlives its builder.
  EXPECT_TRUE(validate_wide_tree(*held, spheres).ok());
}

// By the function that build() asks first: no machine has the memory for such a set.
TEST(WideBuilder, RefusesMoreSpheresThanNumbers) {
  EXPECT_TRUE(check_wide_count(0));
  EXPECT_TRUE(check_wide_count(std::int64_t{4294967295}));
  const Status refused = check_wide_count(std::int64_t{4294967296});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("at most 4294967295 spheres, and there are 4294967296"), std::string::npos);
  EXPECT_FALSE(check_wide_count(std::int64_t{1} << 62));
}

TEST(WideBuilder, NoSpheresNoNodes) {
  WideBuilder builder;
  const TreePointer tree = built(builder, SphereSet());
  EXPECT_EQ(tree->node_count, 0);
  EXPECT_EQ(tree->size, 0);
  EXPECT_EQ(tree->levels, 0);
}

}  // namespace
}  // namespace bihive
