// The binary tree between the builder's two steps: spheres are split in two until leaves are small, then sixteen
// neighbours become one wide node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "bihive/base/aligned_buffer.h"
#include "bihive/math/aabb.h"
#include "bihive/wide/wide_tree.h"

namespace bihive {

struct BinarySplit;

/// Neighbouring spheres in leaf order, with their box. Stored units.
struct BinaryNode {
  Aabb box;
  std::uint32_t count;
  std::uint32_t axis;  ///< split axis: the left child lies towards -inf
  BinarySplit* split;  ///< null: a leaf

  bool is_leaf() const { return split == nullptr; }
};

/// The two sides of a node, and what it costs to have the node's spheres in `k` slots of a wide node, k = 1 to 15, in
/// cost[k - 1]: the surface of all wide nodes needed below, to which a ray's node visits are proportional. With more
/// slots, more of what lies below fits into the wide node above (wide/build/slot_costs-inl.h).
struct BinarySplit {
  BinaryNode side[2];
  float cost[kWidth];
};

/// Half the surface of a box, in binary32: areas are only compared.
inline float half_area(const Aabb& box) {
  const Vec3f side = box.hi - box.lo;
  return (side.x * side.y + side.y * side.z) + side.z * side.x;
}

/// Memory for splits, in portions, reused by later builds. Any thread may take a portion.
class NodeArena {
 public:
  static constexpr std::size_t kPortionSplits = 56;

  /// Throws std::bad_alloc.
  BinarySplit* take_portion();
  /// All portions are free again.
  void clear();
  std::int64_t allocated_bytes() const;

 private:
  std::mutex mutex_;
  std::vector<AlignedBuffer> chunks_;
  std::size_t chunk_ = 0;  // the chunk that portions are taken from
  std::size_t used_ = 0;   // portions of it in use
};

/// Hands out splits one by one to a single thread.
class SplitSource {
 public:
  explicit SplitSource(NodeArena& arena) : arena_(arena) {}
  /// Returns an uninitialized split. Throws std::bad_alloc.
  BinarySplit* next() {
    if (left_ == 0) {
      next_ = arena_.take_portion();
      left_ = NodeArena::kPortionSplits;
    }
    --left_;
    return next_++;
  }

 private:
  NodeArena& arena_;
  BinarySplit* next_ = nullptr;
  std::size_t left_ = 0;
};

}  // namespace bihive
