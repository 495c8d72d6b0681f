// Statistics of a wide tree, and the expected cost of a ray.
#pragma once

#include <cstdint>

#include "bihive/bih/statistics.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

/// All numbers of an empty tree are 0.
struct WideStatistics {
  std::int64_t spheres = 0;
  std::int64_t nodes = 0;
  std::int64_t leaves = 0;
  int levels = 0;      ///< WideTree::levels
  MinAvgMax children;  ///< of a node
  MinAvgMax spheres_per_leaf;
  MinAvgMax nodes_above_leaf;  ///< from the root on

  /// Lane utilization, 0 to 1: boxes of the nodes, and spheres of the leaves in steps of kWidth.
  double node_fill = 0, leaf_fill = 0;

  /// Surface shared by siblings, pair by pair, per surface of the node's own box: over all nodes, weighted by that
  /// surface. 0: no boxes overlap.
  double overlap = 0;

  /// Nodes, leaves and spheres tested along a random line through the box of all spheres, without ending at a hit. The
  /// probability that a line meets a box is proportional to its surface.
  double expected_nodes = 0, expected_leaves = 0, expected_spheres = 0;

  std::int64_t node_bytes = 0;       ///< kWidth boxes and links each
  std::int64_t sphere_bytes = 0;     ///< with their padding
  std::int64_t other_bytes = 0;      ///< repeated spheres, the outer tree, and the tree itself
  std::int64_t used_bytes = 0;       ///< the sum: WideTree::used_bytes()
  std::int64_t allocated_bytes = 0;  ///< WideTree::allocated_bytes()
};

/// Takes time in proportion to the nodes.
WideStatistics wide_statistics(const WideTree& tree);

}  // namespace bihive
