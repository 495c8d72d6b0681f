// The binary tree between the builder's two steps: spheres are split in two until leaves are small, then sixteen
// neighbours become one wide node.
#pragma once

#include <cstdint>

#include "bihive/math/aabb.h"

namespace bihive {

/// A range of spheres in leaf order with its box. Stored units.
struct BinaryNode {
  Aabb box;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  std::uint32_t child = 0;  ///< number of the left child, the right one follows; 0: a leaf
  std::uint32_t axis = 0;   ///< of the split: the left child lies towards -inf

  bool is_leaf() const { return child == 0; }
  /// Half the surface of the box, in binary32: only compared.
  float half_area() const {
    const Vec3f side = box.hi - box.lo;
    return (side.x * side.y + side.y * side.z) + side.z * side.x;
  }
};

}  // namespace bihive
