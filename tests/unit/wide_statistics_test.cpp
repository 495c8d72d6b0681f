// Numbers of wide trees that are known by hand, and sums that must agree with the tree.
// ctest: asan-long
#include "bihive/wide/wide_statistics.h"

#include <gtest/gtest.h>

#include "bihive/math/infinity.h"
#include "bihive/wide/wide_builder.h"
#include "support/scenes.h"

namespace bihive {
namespace {

// A tree made by hand: the root has two inner children and a leaf; these have two leaves each.
class ByHand {
 public:
  ByHand() {
    for (WideNode& node : nodes_)
      for (int axis = 0; axis < 3; ++axis)
        for (int slot = 0; slot < kWidth; ++slot)
          node.lo[axis][slot] = kInfiniteFloat, node.hi[axis][slot] = -kInfiniteFloat;
    // Cubes of side 2 in a row along x: [0, 2], [2, 4] and, overlapping the second by half, [3, 5].
    put(nodes_[0], 0, 0, 2, 0);
    put(nodes_[0], 1, 2, 4, 20);
    put(nodes_[0], 2, 3, 5, 40);
    nodes_[0].begin[3] = 45;
    nodes_[0].leaf_mask = 4;
    nodes_[0].child_count = 3;
    nodes_[0].first_node = 1;
    // Halves of the first cube along x, and the second cube twice over.
    put(nodes_[1], 0, 0, 1, 0);
    put(nodes_[1], 1, 1, 2, 4);
    nodes_[1].begin[2] = 20;
    put(nodes_[2], 0, 2, 4, 0);
    put(nodes_[2], 1, 2, 4, 17);
    nodes_[2].begin[2] = 20;
    for (const int i : {1, 2}) nodes_[i].leaf_mask = 3, nodes_[i].child_count = 2;
    tree_.nodes = nodes_;
    tree_.node_count = 3;
    tree_.levels = 2;
    tree_.size = tree_.placed = 45;
    tree_.aabb = {{0, 0, 0}, {5, 2, 2}};
    tree_.spheres.has_palette = true;
  }
  const WideTree& tree() const { return tree_; }

 private:
  WideNode nodes_[3] = {};
  WideTree tree_;

  static void put(WideNode& node, int slot, float x0, float x1, std::uint32_t begin) {
    node.lo[0][slot] = x0;
    node.hi[0][slot] = x1;
    for (int axis = 1; axis < 3; ++axis) node.lo[axis][slot] = 0, node.hi[axis][slot] = 2;
    node.begin[slot] = begin;
  }
};

TEST(WideStatistics, OfATreeMadeByHand) {
  const ByHand by_hand;
  const WideStatistics s = wide_statistics(by_hand.tree());
  EXPECT_EQ(s.spheres, 45);
  EXPECT_EQ(s.nodes, 3);
  EXPECT_EQ(s.leaves, 5);
  EXPECT_EQ(s.levels, 2);
  EXPECT_EQ(s.children.min, 2);
  EXPECT_EQ(s.children.max, 3);
  EXPECT_DOUBLE_EQ(s.children.avg, 7.0 / 3);
  EXPECT_EQ(s.spheres_per_leaf.min, 3);  // 20 - 17
  EXPECT_EQ(s.spheres_per_leaf.max, 17);
  EXPECT_DOUBLE_EQ(s.spheres_per_leaf.avg, 9);
  EXPECT_EQ(s.nodes_above_leaf.min, 1);
  EXPECT_EQ(s.nodes_above_leaf.max, 2);
  EXPECT_DOUBLE_EQ(s.nodes_above_leaf.avg, 9.0 / 5);
  EXPECT_DOUBLE_EQ(s.node_fill, 7.0 / 48);
  EXPECT_DOUBLE_EQ(s.leaf_fill, 45.0 / (16 * 6));  // the leaf of 17 takes two steps
  // Half surfaces: a cube 12, half of one 8, the row of all 24.
  EXPECT_DOUBLE_EQ(s.expected_nodes, (24.0 + 12 + 12) / 24);
  EXPECT_DOUBLE_EQ(s.expected_leaves, (12.0 + 8 + 8 + 12 + 12) / 24);
  EXPECT_DOUBLE_EQ(s.expected_spheres, (12.0 * 5 + 8 * 4 + 8 * 16 + 12 * 17 + 12 * 3) / 24);
  // The cubes share a square of 4 (half surface 4) and half a cube (8); the halves share a square; the last all.
  EXPECT_DOUBLE_EQ(s.overlap, (4.0 + 8 + 4 + 12) / (24 + 12 + 12));
}

TEST(WideStatistics, AgreeWithTheTree) {
  for (const int n : {1, 16, 17, 300, 5000}) {
    const SphereSet spheres = test::sphere_set(test::random_world("random", 3, n, 10, 0.1, 0.6));
    WideBuilder builder;
    const std::shared_ptr<const WideTree> tree = *builder.build(spheres);
    const WideStatistics s = wide_statistics(*tree);
    EXPECT_EQ(s.spheres, n);
    EXPECT_EQ(s.nodes, tree->node_count);
    EXPECT_EQ(s.spheres_per_leaf.max, tree->largest_leaf);
    EXPECT_EQ(s.nodes_above_leaf.max, tree->levels);
    EXPECT_NEAR(s.spheres_per_leaf.avg * double(s.leaves), n, 1e-6);
    EXPECT_NEAR(s.children.avg * double(s.nodes), double(s.leaves + s.nodes - 1), 1e-6);
    EXPECT_EQ(s.node_bytes + s.sphere_bytes + s.other_bytes, tree->used_bytes());
    EXPECT_EQ(s.node_bytes, s.nodes * 512);
    EXPECT_EQ(s.sphere_bytes, (tree->spheres.has_palette ? 16 : 20) * (n + kWidth));
    EXPECT_GE(s.allocated_bytes, s.used_bytes);
    EXPECT_GE(s.expected_nodes, 1);
    EXPECT_LE(s.expected_nodes, double(s.nodes));
    EXPECT_LE(s.expected_spheres, n);
    EXPECT_GT(s.node_fill, 0);
    EXPECT_LE(s.node_fill, 1);
    EXPECT_LE(s.leaf_fill, 1);
  }
}

TEST(WideStatistics, OfNoSpheresAndOfPoints) {
  WideBuilder builder;
  const WideStatistics none = wide_statistics(**builder.build(SphereSet()));
  EXPECT_EQ(none.nodes, 0);
  EXPECT_EQ(none.expected_nodes, 0);
  test::World points;
  for (int i = 0; i < 40; ++i) points.add(1, 2, 3, 0);
  const SphereSet spheres = test::sphere_set(points);
  const WideStatistics s = wide_statistics(**builder.build(spheres));
  EXPECT_EQ(s.spheres, 40);
  EXPECT_EQ(s.overlap, 0);
  EXPECT_EQ(s.expected_spheres, 40);
}

}  // namespace
}  // namespace bihive
