// ctest: asan-long
#include "bihive/bih/statistics.h"

#include <gtest/gtest.h>

namespace bihive {
namespace {

Node inner(NodeKind kind, std::int64_t first) {
  Node node;
  node.kind = kind;
  node.first = first;
  return node;
}

Node leaf(std::int64_t first, std::int64_t count) {
  Node node;
  node.first = first;
  node.sphere_count = count;
  return node;
}

TEST(Statistics, CountATreeOfEveryKindOfNode) {
  // split( clip( one_left( leaf 6, empty ) ), split( leaf 1, leaf 4 ) )
  Tree tree;
  tree.nodes = {inner(NodeKind::split, 1),
                inner(NodeKind::clip, 3),
                inner(NodeKind::split, 4),
                inner(NodeKind::one_left, 6),
                leaf(6, 1),
                leaf(7, 4),
                leaf(0, 6)};
  tree.empty_leaves = 1;
  tree.forced_leaves = 1;
  const TreeStatistics s = tree_statistics(tree);
  EXPECT_EQ(s.spheres, 11);
  EXPECT_EQ(s.inner_nodes, 4);
  EXPECT_EQ(s.leaves, 4);
  EXPECT_EQ(s.optimized_nodes, 1);
  EXPECT_EQ(s.one_sided_nodes, 1);
  EXPECT_EQ(s.forced_leaves, 1);
  EXPECT_EQ(s.spheres_per_leaf.min, 0);
  EXPECT_EQ(s.spheres_per_leaf.avg, 2.75);
  EXPECT_EQ(s.spheres_per_leaf.max, 6);
  EXPECT_EQ(s.depth.min, 3);
  EXPECT_EQ(s.depth.avg, (4 + 4 + 3 + 3) / 4.0);
  EXPECT_EQ(s.depth.max, 4);
  EXPECT_EQ(s.leaves_with, (std::array<std::int64_t, 6>{1, 1, 0, 0, 1, 1}));
}

TEST(Statistics, OfOneLeaf) {
  Tree tree;
  tree.nodes = {leaf(0, 3)};
  const TreeStatistics s = tree_statistics(tree);
  EXPECT_EQ(s.inner_nodes, 0);
  EXPECT_EQ(s.leaves, 1);
  EXPECT_EQ(s.depth.min, 1);
  EXPECT_EQ(s.depth.max, 1);
  EXPECT_EQ(s.spheres_per_leaf.avg, 3);
}

TEST(Statistics, CompactBytesAreTwelveFourAndTwentyFour) {
  const CompactBytes bytes = compact_bytes(4095, 4096, 4096);
  EXPECT_EQ(bytes.nodes, 98292);
  EXPECT_EQ(bytes.indices, 16384);
  EXPECT_EQ(bytes.aabb, 24);
  EXPECT_EQ(bytes.total(), 114700);
}

}  // namespace
}  // namespace bihive
