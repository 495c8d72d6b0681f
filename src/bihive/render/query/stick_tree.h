// The tree of the sticks that the wide engine's rays meet: boxes, sixteen to a node, tested by vectors.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/math/aabb.h"

namespace bihive {

constexpr int kStickWidth = 16;

/// In stored units. The box of a slot without a child is one that no ray enters.
struct alignas(64) StickNode {
  float lo[3][kStickWidth], hi[3][kStickWidth];
  std::int32_t child[kStickWidth];  ///< a node; below 0: ~child is the index of a stick
};

/// Immutable once built.
class StickTree {
 public:
  StickTree() = default;
  /// Of fewer than 2^31 boxes, each of which is a stick's own. std::bad_alloc: there is not enough memory.
  /// Within a WatchedWork it may throw Cancelled.
  explicit StickTree(const std::vector<Aabb>& boxes);

  /// nodes()[0] is the root; without sticks there is none.
  const std::vector<StickNode>& nodes() const { return nodes_; }
  /// Around all sticks, and the mean of the longest sides of their own boxes.
  const Aabb& box() const { return box_; }
  double mean_extent() const { return mean_extent_; }
  /// From the root to the deepest node.
  int levels() const { return levels_; }

 private:
  std::vector<StickNode> nodes_;
  Aabb box_;
  double mean_extent_ = 0;
  int levels_ = 0;
};

/// What a traversal asks about the sticks near a ray.
class StickTests {
 public:
  StickTests(const StickTests&) = delete;
  StickTests& operator=(const StickTests&) = delete;

  /// The index of a stick. True ends the traversal; else `limit` may have become smaller.
  virtual bool test(std::int64_t index) = 0;

  double limit;  ///< sticks beyond this t do not matter

 protected:
  explicit StickTests(double limit_of_ray) : limit(limit_of_ray) {}
  ~StickTests() = default;
};

/// Takes a valid ray, in the stored units of the boxes, to every stick whose box it may enter up to tests.limit, nearly
/// from near to far. `more_pad` as for Slabs (bih/traversal.h).
void traverse(const StickTree& tree, const ScaledRay& ray, double more_pad, StickTests& tests);

}  // namespace bihive
