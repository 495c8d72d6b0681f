// Order by cell: for rays that have nothing in common with their neighbours, as random ones have not. In a large tree
// each reads parts of it that no other ray near it in memory reads. Sorted by where they start and which way they go,
// those that read the same parts follow each other.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/wide/ray_batch.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::wide {

/// Are there so many rays, most of them far from the next, and is the tree so large, that sorting pays?
bool scattered(const WideTree& tree, const RaySpan& rays);

/// Finds the order; keeps its working memory.
class CellOrder {
 public:
  /// order[k] is the number of the ray that comes k-th. Any rays may come, below 2^32.
  void find(const WideTree& tree, const RaySpan& rays, std::vector<std::uint32_t>& order);

 private:
  void number_cells(const WideTree& tree, const RaySpan& rays, int bits);

  std::vector<std::uint32_t> cells_, ends_;
};

}  // namespace bihive::wide
