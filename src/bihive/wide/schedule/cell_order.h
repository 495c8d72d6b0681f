// Order by cell: for rays that have nothing in common with their neighbours, such as random ones. In a large tree each
// reads nodes that no neighbour in memory reads. Sorted by origin and direction, rays that read the same nodes follow
// each other.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::wide {

/// Does sorting pay? It does for many rays, most of them far from the next, in a large tree.
bool scattered(const WideTree& tree, const RaySpan& rays);

/// Finds the order; keeps its working memory.
class CellOrder {
 public:
  /// order[k] is the number of the k-th ray. Any rays are valid, fewer than 2^32.
  void find(const WideTree& tree, const RaySpan& rays, std::vector<std::uint32_t>& order);

 private:
  void number_cells(const WideTree& tree, const RaySpan& rays, int bits);

  std::vector<std::uint32_t> cells_, ends_;
};

}  // namespace bihive::wide
