// The statistics of a tree: the rows of the thesis's Table 4.2, and its memory.
#pragma once

#include <array>
#include <cstdint>

#include "bihive/bih/tree.h"

namespace bihive {

struct MinAvgMax {
  std::int64_t min = 0;
  double avg = 0;
  std::int64_t max = 0;
};

/// Leaves include empty and forced ones. The root has depth 1.
struct TreeStatistics {
  std::int64_t spheres = 0;
  std::int64_t inner_nodes = 0;  ///< clip + one-sided + split nodes
  std::int64_t leaves = 0;
  std::int64_t optimized_nodes = 0;  ///< clip nodes
  std::int64_t one_sided_nodes = 0;
  std::int64_t forced_leaves = 0;
  MinAvgMax spheres_per_leaf;
  MinAvgMax depth;                            ///< of leaves
  std::array<std::int64_t, 6> leaves_with{};  ///< leaves with 0, 1, 2, 3, 4 and more spheres
};

TreeStatistics tree_statistics(const Tree& tree);

/// Memory in a compact layout: 12 bytes per node (inner or leaf), 4 per sphere for the index array, 24 for the box. The
/// thesis names these three and gives no sizes; 12 is our inference.
struct CompactBytes {
  std::int64_t nodes = 0, indices = 0, aabb = 24;
  std::int64_t total() const { return nodes + indices + aabb; }
};
CompactBytes compact_bytes(std::int64_t inner_nodes, std::int64_t leaves, std::int64_t spheres);

}  // namespace bihive
