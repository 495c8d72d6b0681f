// Numbers of a wide tree, and the cost that a ray through it may have.
#pragma once

#include <cstdint>

#include "bihive/bih/statistics.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// Of an empty tree everything is 0.
struct WideStatistics {
  std::int64_t spheres = 0;
  std::int64_t nodes = 0;
  std::int64_t leaves = 0;
  int levels = 0;      ///< WideTree::levels
  MinAvgMax children;  ///< of a node
  MinAvgMax spheres_per_leaf;
  MinAvgMax nodes_above_leaf;  ///< from the root on

  /// Shares of lanes at work, 0 to 1: boxes of the nodes, and spheres of the leaves in steps of kWidth.
  double node_fill = 0, leaf_fill = 0;

  /// Surface that siblings have in common, pair by pair, per surface of the node's own box: over all nodes, weighted by
  /// that surface. 0: no boxes overlap.
  double overlap = 0;

  /// What a random line that meets the box of all spheres meets on its way through: nodes, leaves and spheres tested,
  /// were no hit to end it. A box is met by a line as often as its surface is large.
  double expected_nodes = 0, expected_leaves = 0, expected_spheres = 0;

  std::int64_t node_bytes = 0;       ///< kWidth boxes and links each
  std::int64_t sphere_bytes = 0;     ///< with their padding
  std::int64_t other_bytes = 0;      ///< repeated spheres and the tree itself
  std::int64_t used_bytes = 0;       ///< the sum: WideTree::used_bytes()
  std::int64_t allocated_bytes = 0;  ///< WideTree::allocated_bytes()
};

/// Takes time in proportion to the nodes.
WideStatistics wide_statistics(const WideTree& tree);

}  // namespace bihive
