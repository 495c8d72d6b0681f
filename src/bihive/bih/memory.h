// Predicts the memory of a tree from the number of spheres, before it is built.
#pragma once

#include <cstdint>

#include "bihive/bih/tree.h"

namespace bihive {

/// `low`: a balanced tree of full leaves (the thesis's Scenario 1), less a fifth for spheres that coincide. `high`: the
/// most scattered sets measured (small Scenarios 2). Sets of a file fall between; docs/bih.md names what can exceed it.
struct MemoryPrediction {
  struct Range {
    std::int64_t low = 0, high = 0;
  };
  Range nodes;            ///< inner nodes and leaves, empty leaves too
  Range compact_bytes;    ///< in a compact layout (bih/statistics.h)
  Range allocated_bytes;  ///< as this program allocates
  /// The same while it is built, for sets of a usual kind: nodes are twice in memory while their array grows.
  std::int64_t peak_bytes = 0;
};

MemoryPrediction predict_tree_memory(std::int64_t spheres, const BuildParameters& parameters);

}  // namespace bihive
