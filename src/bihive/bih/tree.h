// The bounding interval hierarchy as built by the reference builder, and the parameters of its build.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/bih/node.h"
#include "bihive/math/aabb.h"

namespace bihive {

/// No limit, for max_prims and max_depth.
constexpr std::int64_t kUnlimited = std::numeric_limits<std::int64_t>::max();

/// The thesis's MAX_PRIMS and MAX_TREE_DEPTH.
struct BuildParameters {
  std::int64_t max_prims = 8;           ///< a range of at most this many spheres becomes a leaf; >= 1
  std::int64_t max_depth = kUnlimited;  ///< no leaf lies deeper; the root has depth 1; >= 1
};

/// Immutable after the build. Everything is in the stored units of the sphere set from which it was built.
struct Tree {
  BuildParameters parameters;
  Aabb aabb;                             ///< of all spheres: the test before the root
  std::vector<Node> nodes;               ///< nodes[0] is the root; the children of a split are neighbours
  std::vector<std::int64_t> sphere_ids;  ///< leaf order -> id; a leaf owns neighbouring entries
  std::int64_t empty_leaves = 0;         ///< counted, not stored: each is the missing child of a one-sided node
  std::int64_t forced_leaves = 0;        ///< leaves over max_prims and above max_depth, because no split made progress

  /// Bytes that the tree really holds.
  std::int64_t allocated_bytes() const {
    return static_cast<std::int64_t>(sizeof(Tree) + nodes.capacity() * sizeof(Node) +
                                     sphere_ids.capacity() * sizeof(std::int64_t));
  }
};

}  // namespace bihive
