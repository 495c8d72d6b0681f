// The binary tree between the builder's two steps: spheres are split in two until leaves are small, then sixteen
// neighbours become one wide node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "bihive/kernels/aligned_buffer.h"
#include "bihive/math/aabb.h"

namespace bihive {

/// Neighbouring spheres in leaf order, with their box. Stored units.
struct BinaryNode {
  Aabb box;
  std::uint32_t count;
  std::uint32_t axis;    ///< of the split: the left child lies towards -inf
  BinaryNode* children;  ///< left and right; null: a leaf

  bool is_leaf() const { return children == nullptr; }
};

/// Half the surface of a box, in binary32: areas are only compared.
inline float half_area(const Aabb& box) {
  const Vec3f side = box.hi - box.lo;
  return (side.x * side.y + side.y * side.z) + side.z * side.x;
}

/// Memory for nodes, in blocks, kept from build to build. Any thread may take a block.
class NodeArena {
 public:
  static constexpr std::size_t kBlockNodes = 200;

  /// Throws std::bad_alloc.
  BinaryNode* take_block();
  /// All blocks are free again.
  void clear();
  std::int64_t allocated_bytes() const;

 private:
  std::mutex mutex_;
  std::vector<AlignedBuffer> chunks_;
  std::size_t chunk_ = 0;  // the one that blocks are taken from
  std::size_t used_ = 0;   // blocks of it that are taken
};

/// Hands out nodes one by one to a single thread.
class NodeSource {
 public:
  explicit NodeSource(NodeArena& arena) : arena_(arena) {}
  /// Two neighbouring nodes, not set to anything. Throws std::bad_alloc.
  BinaryNode* pair() {
    if (left_ == 0) {
      next_ = arena_.take_block();
      left_ = NodeArena::kBlockNodes;
    }
    BinaryNode* const nodes = next_;
    next_ += 2;
    left_ -= 2;
    return nodes;
  }

 private:
  NodeArena& arena_;
  BinaryNode* next_ = nullptr;
  std::size_t left_ = 0;
};

}  // namespace bihive
