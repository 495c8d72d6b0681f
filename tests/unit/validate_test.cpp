// validate_tree() finds every kind of fault in a tree.
#include "bihive/bih/validate.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

#include "bihive/bih/reference_builder.h"
#include "support/hostile_sets.h"

namespace bihive {
namespace {

class Validate : public testing::Test {
 protected:
  const SphereSet spheres_ = test::sphere_set(test::random_world("random", 3, 200, 10, 0.1, 0.6));
  const Tree right_ = build_reference_tree(spheres_, {4, kUnlimited});

  /// The message for a right tree after `harm`, or "" if nothing is found.
  std::string after(const std::function<void(Tree&)>& harm) const {
    Tree tree = right_;
    harm(tree);
    const Status status = validate_tree(tree, spheres_);
    return status.ok() ? "" : status.error().to_string();
  }
  static std::size_t first_of(const Tree& tree, NodeKind kind) {
    for (std::size_t i = 0; i < tree.nodes.size(); ++i)
      if (tree.nodes[i].kind == kind && (kind != NodeKind::leaf || tree.nodes[i].sphere_count > 0)) return i;
    ADD_FAILURE() << "no such node in the tree";
    return 0;
  }
};

#define EXPECT_WRONG(message, ...)                                                   \
  EXPECT_NE(after([](Tree& tree) { __VA_ARGS__; }).find(message), std::string::npos) \
      << after([](Tree& tree) { __VA_ARGS__; })

TEST_F(Validate, AcceptsTheBuildersTree) {
  EXPECT_EQ(after([](Tree&) {}), "");
}

TEST_F(Validate, FindsPlanesThatCutSpheres) {
  EXPECT_WRONG("cuts sphere", Node& n = tree.nodes[first_of(tree, NodeKind::split)];
               n.left_clip = std::nextafter(n.left_clip, -2.0f));
  EXPECT_WRONG("cuts sphere", Node& n = tree.nodes[first_of(tree, NodeKind::split)];
               n.right_clip = std::nextafter(n.right_clip, 2.0f));
  EXPECT_WRONG("cuts sphere", Node& n = tree.nodes[first_of(tree, NodeKind::clip)];
               n.left_clip = std::nextafter(n.left_clip, 2.0f));
  EXPECT_WRONG("cuts sphere", Node& n = tree.nodes[first_of(tree, NodeKind::clip)];
               n.right_clip = std::nextafter(n.right_clip, -2.0f));
  EXPECT_WRONG("cuts sphere", tree.aabb.hi.y = std::nextafter(tree.aabb.hi.y, -2.0f));
}

TEST_F(Validate, FindsSpheresLostOrDoubled) {
  EXPECT_WRONG("another leaf", tree.sphere_ids[0] = tree.sphere_ids[1]);
  EXPECT_WRONG("does not exist", tree.sphere_ids[0] = 200);
  EXPECT_WRONG("does not exist", tree.sphere_ids[0] = -1);
  EXPECT_WRONG("one entry per sphere", tree.sphere_ids.pop_back());
  EXPECT_WRONG("in no leaf", --tree.nodes[first_of(tree, NodeKind::leaf)].sphere_count);
  EXPECT_WRONG("outside the index array", tree.nodes[first_of(tree, NodeKind::leaf)].sphere_count = -1);
  EXPECT_WRONG("outside the index array", tree.nodes[first_of(tree, NodeKind::leaf)].first = 199;
               tree.nodes[first_of(tree, NodeKind::leaf)].sphere_count = 2);
}

TEST_F(Validate, FindsNodesLostOrShared) {
  EXPECT_WRONG("not reached", tree.nodes.push_back({}));
  EXPECT_WRONG("reached twice", tree.nodes[first_of(tree, NodeKind::clip)].first = 0);
  EXPECT_WRONG("outside the tree",
               tree.nodes[first_of(tree, NodeKind::clip)].first = static_cast<std::int64_t>(tree.nodes.size()));
  EXPECT_WRONG("outside the tree", tree.nodes[first_of(tree, NodeKind::clip)].first = -1);
  EXPECT_WRONG("no root", tree.nodes.clear());
  EXPECT_WRONG("no axis", tree.nodes[0].split_axis = 3);
}

TEST_F(Validate, FindsBrokenLimitsAndCounts) {
  EXPECT_WRONG("deeper", tree.parameters.max_depth = 3);
  EXPECT_WRONG("forced leaves", tree.parameters.max_prims = 1);
  EXPECT_WRONG("forced leaves", ++tree.forced_leaves);
  EXPECT_WRONG("empty", ++tree.empty_leaves);
}

TEST_F(Validate, FindsPlanesThatAreNoNumbers) {
  EXPECT_WRONG("plane", tree.nodes[first_of(tree, NodeKind::split)].left_clip = NAN);
  EXPECT_WRONG("plane", tree.nodes[first_of(tree, NodeKind::clip)].right_clip = NAN);
}

}  // namespace
}  // namespace bihive
