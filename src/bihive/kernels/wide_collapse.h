// Sixteen neighbours of the binary tree become one wide node.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/kernels/binary_tree.h"
#include "bihive/kernels/wide_tree.h"

namespace bihive {

struct WideShape {
  int levels = 0;
  std::int64_t largest_leaf = 0;
};

/// Appends the wide nodes of the binary tree under nodes[0] to `wide`; node 0 is the root. `most_levels`: wide nodes on
/// a way from the root at most, at least 1; what is left at the last one becomes leaves of any size. `full_leaf`:
/// spheres that one leaf should hold.
WideShape collapse(const std::vector<BinaryNode>& nodes, int most_levels, std::int64_t full_leaf,
                   std::vector<WideNode>& wide);

}  // namespace bihive
