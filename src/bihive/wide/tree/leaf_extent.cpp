#include "bihive/wide/tree/leaf_extent.h"

#include <algorithm>
#include <cstdint>

namespace bihive {

float leaf_extent(const WideTree& tree) {
  constexpr std::int64_t kSamples = 8;
  float sum = 0;
  int count = 0;
  const std::int64_t step = std::max<std::int64_t>(1, tree.node_count / kSamples);
  for (std::int64_t i = tree.node_count - 1; i >= 0; i -= step) {
    const WideNode& node = tree.nodes[i];
    for (int slot = 0; slot < node.child_count; ++slot) {
      if (!node.is_leaf(slot)) continue;
      float extent = 0;
      for (int axis = 0; axis < 3; ++axis) extent = std::max(extent, node.hi[axis][slot] - node.lo[axis][slot]);
      sum += extent;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<float>(count) : 0;
}

}  // namespace bihive
