// One node of the bounding interval hierarchy: two planes across one axis, or a range of spheres.
#pragma once

#include <cstdint>

namespace bihive {

enum class NodeKind : std::uint8_t {
  leaf,       ///< spheres first_sphere ... first_sphere + sphere_count - 1 in leaf order
  split,      ///< left child below left_clip, right child above right_clip
  one_left,   ///< a split whose right child is an empty leaf: left_clip bounds the one child from above
  one_right,  ///< a split whose left child is an empty leaf: right_clip bounds the one child from below
  clip,       ///< one child between left_clip (from below) and right_clip (from above); the thesis's "optimized node"
};

/// Planes are in stored units. On `split_axis`, everything below a split's left child is <= left_clip, everything below
/// its right child is >= right_clip. Where left_clip < right_clip there is a gap; otherwise the children may overlap.
struct Node {
  float left_clip = 0;
  float right_clip = 0;
  NodeKind kind = NodeKind::leaf;
  std::uint8_t split_axis = 0;
  /// Inner node: position of the (left) child; a split's right child is the next one. Leaf: first_sphere.
  std::int64_t first = 0;
  std::int64_t sphere_count = 0;  ///< leaf only

  bool is_leaf() const { return kind == NodeKind::leaf; }
  std::int64_t left_child() const { return first; }
  std::int64_t right_child() const { return first + 1; }
  std::int64_t first_sphere() const { return first; }
};

}  // namespace bihive
