// The reference builder on sets that are small enough to follow by hand.
#include "bihive/bih/tree.h"

#include <gtest/gtest.h>

#include <limits>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/bih/validate.h"
#include "support/hostile_sets.h"

namespace bihive {
namespace {

// A set of known scale: the largest bound is in (8, 16], so stored = world / 16 (bounds are exact there).
constexpr float kScale = 1 / 16.0f;

Tree built(const test::World& world, std::int64_t max_prims, std::int64_t max_depth = kUnlimited) {
  const SphereSet spheres = test::sphere_set(world);
  Tree tree = build_reference_tree(spheres, {max_prims, max_depth});
  const Status status = validate_tree(tree, spheres);
  EXPECT_TRUE(status.ok()) << status.error().to_string();
  return tree;
}

const Node& at(const Tree& tree, std::int64_t position) {
  return tree.nodes[static_cast<std::size_t>(position)];
}

TEST(Tree, OfNothingIsOneEmptyLeaf) {
  const Tree tree = built({}, 1);
  ASSERT_EQ(tree.nodes.size(), 1u);
  EXPECT_TRUE(at(tree, 0).is_leaf());
  EXPECT_EQ(at(tree, 0).sphere_count, 0);
  EXPECT_TRUE(tree.aabb.empty());
}

TEST(Tree, OfTwoSpheresIsASplitWithAGap) {
  test::World world;
  world.add(-9, 0, 0, 1);
  world.add(9, 0, 0, 1);
  const Tree tree = built(world, 1);
  ASSERT_EQ(tree.nodes.size(), 3u);
  EXPECT_EQ(at(tree, 0).kind, NodeKind::split);
  EXPECT_EQ(at(tree, 0).split_axis, 0);
  EXPECT_EQ(at(tree, 0).left_clip, -8 * kScale);
  EXPECT_EQ(at(tree, 0).right_clip, 8 * kScale);
  EXPECT_EQ(tree.aabb.lo, (Vec3f{-10 * kScale, -1 * kScale, -1 * kScale}));
  EXPECT_EQ(tree.aabb.hi, (Vec3f{10 * kScale, 1 * kScale, 1 * kScale}));
  EXPECT_EQ(tree.sphere_ids, (std::vector<std::int64_t>{0, 1}));
}

TEST(Tree, HalvesTheLaterOfEqualSides) {
  test::World world;
  for (const double x : {-9.0, 9.0})
    for (const double y : {-9.0, 9.0})
      for (const double z : {-9.0, 9.0}) world.add(x, y, z, 1);
  EXPECT_EQ(at(built(world, 1), 0).split_axis, 2);
  world.x[0] = -9.5f;
  EXPECT_EQ(at(built(world, 1), 0).split_axis, 0);
  world.y[0] = -9.5f;
  EXPECT_EQ(at(built(world, 1), 0).split_axis, 1) << "x must be strictly longer than both";
}

TEST(Tree, SendsACentreOnTheSplitLeft) {
  test::World world;
  world.add(-9, 0, 0, 1);
  world.add(0, 0, 0, 1);
  world.add(9, 0, 0, 1);
  const Tree tree = built(world, 2);
  EXPECT_EQ(at(tree, at(tree, 0).left_child()).sphere_count, 2);
  EXPECT_EQ(at(tree, at(tree, 0).right_child()).sphere_count, 1);
}

TEST(Tree, CutsFreeSpaceOnBothSidesByAClipNode) {
  // The left pair lies in the middle of a box that the right pair makes long.
  test::World world;
  world.add(-10, -1, 0, 0.5);
  world.add(-10, 1, 0, 0.5);
  world.add(10, -9, 0, 0.5);
  world.add(10, 9, 0, 0.5);
  const Tree tree = built(world, 1);
  const Node& clip = at(tree, at(tree, 0).left_child());
  ASSERT_EQ(clip.kind, NodeKind::clip);
  EXPECT_EQ(clip.split_axis, 1);
  EXPECT_EQ(clip.left_clip, -1.5f * kScale);
  EXPECT_EQ(clip.right_clip, 1.5f * kScale);
  const Node& split = at(tree, clip.first);
  ASSERT_EQ(split.kind, NodeKind::split);
  EXPECT_EQ(split.split_axis, 1);
  EXPECT_EQ(split.left_clip, -0.5f * kScale);
  EXPECT_EQ(split.right_clip, 0.5f * kScale);
  const TreeStatistics s = tree_statistics(tree);
  EXPECT_EQ(s.inner_nodes, 4);
  EXPECT_EQ(s.leaves, 4);
  EXPECT_EQ(s.optimized_nodes, 1);
  EXPECT_EQ(s.depth.min, 3);
  EXPECT_EQ(s.depth.max, 4);
}

TEST(Tree, ClipsOnlyWhereItGainsEnough) {
  // Contents of length 3 in a box of length 3.9 = 1.3 x 3 and a little less or more.
  for (const double outer : {1.8, 2.2}) {
    test::World world;
    world.add(-10, -1, 0, 0.5);
    world.add(-10, 1, 0, 0.5);
    world.add(10, -outer + 0.25, 0, 0.25);
    world.add(10, outer - 0.25, 0, 0.25);
    EXPECT_EQ(tree_statistics(built(world, 1)).optimized_nodes, outer > 1.95 ? 1 : 0) << outer;
  }
}

test::World world_with_an_empty_half() {
  test::World world;
  world.add(-10, -9, 0, 0.5);
  world.add(-10, -6, 0, 0.5);
  world.add(10, -9, 0, 0.5);
  world.add(10, 9, 0, 0.5);
  return world;
}

TEST(Tree, RemembersTheLatestEmptyHalfByAOneSidedNode) {
  // The left pair: y is halved at 0, x at -5.25, y at -4.75, x at -7.875, each with the other half empty; then y at
  // -7.125 separates the two spheres. Only the last of the four empty halves becomes a node.
  const Tree tree = built(world_with_an_empty_half(), 1);
  const Node& above = at(tree, at(tree, 0).left_child());
  ASSERT_EQ(above.kind, NodeKind::one_left);
  EXPECT_EQ(above.split_axis, 0);
  EXPECT_EQ(above.left_clip, -9.5f * kScale);
  EXPECT_EQ(above.right_clip, std::numeric_limits<float>::infinity());
  const Node& split = at(tree, above.first);
  ASSERT_EQ(split.kind, NodeKind::split);
  EXPECT_EQ(split.split_axis, 1);
  EXPECT_EQ(split.left_clip, -8.5f * kScale);
  EXPECT_EQ(split.right_clip, -6.5f * kScale);
  const TreeStatistics s = tree_statistics(tree);
  EXPECT_EQ(s.inner_nodes, 4);
  EXPECT_EQ(s.leaves, 5) << "the empty leaf counts";
  EXPECT_EQ(s.leaves_with[0], 1);
  EXPECT_EQ(s.depth.max, 4);
  EXPECT_EQ(tree.nodes.size(), 8u) << "the empty leaf is not stored";
}

TEST(Tree, MirroredTheEmptyHalfIsOnTheOtherSide) {
  test::World world = world_with_an_empty_half();
  for (float& x : world.x) x = -x;
  const Tree tree = built(world, 1);
  const Node& above = at(tree, at(tree, 0).right_child());
  ASSERT_EQ(above.kind, NodeKind::one_right);
  EXPECT_EQ(above.right_clip, 9.5f * kScale);
  EXPECT_EQ(above.left_clip, -std::numeric_limits<float>::infinity());
}

TEST(Tree, DropsTheOneSidedNodeWhereItWouldGoTooDeep) {
  EXPECT_EQ(tree_statistics(built(world_with_an_empty_half(), 1, 4)).one_sided_nodes, 1);
  const TreeStatistics shallow = tree_statistics(built(world_with_an_empty_half(), 1, 3));
  EXPECT_EQ(shallow.one_sided_nodes, 0);
  EXPECT_EQ(shallow.leaves, 4);
  EXPECT_EQ(shallow.depth.max, 3);
}

TEST(Tree, OfCoincidentSpheresIsAForcedLeaf) {
  const Tree tree = built(test::pile("pile", 9, 3, -2, 1, 0.5), 8);
  EXPECT_EQ(tree.nodes.size(), 1u);
  EXPECT_EQ(tree.forced_leaves, 1);
  EXPECT_EQ(built(test::pile("pile", 8, 3, -2, 1, 0.5), 8).forced_leaves, 0) << "small enough by itself";
  EXPECT_EQ(built(test::pile("pile", 9, 3, -2, 1, 0.5), 1, 1).forced_leaves, 0) << "the depth ends it, no force";
}

TEST(Tree, CountsWhatItHolds) {
  const Tree tree = built(test::random_world("random", 1, 100, 10, 1, 1), 4);
  EXPECT_GE(tree.allocated_bytes(), static_cast<std::int64_t>(tree.nodes.size() * sizeof(Node) + 100 * 8));
}

}  // namespace
}  // namespace bihive
