// The boxes of a node's children, cut from the node's own box by its planes.
#pragma once

#include <algorithm>

#include "bihive/bih/node.h"
#include "bihive/math/aabb.h"

namespace bihive {

struct ChildBoxes {
  Aabb first;   ///< of the left, or only, child
  Aabb second;  ///< of a split's right child; the node's own box otherwise
};

/// For an inner node. `box` is in stored units, as the planes above the node cut it (the root's is Tree::aabb).
inline ChildBoxes child_boxes(const Node& node, const Aabb& box) {
  ChildBoxes boxes{box, box};
  const int axis = node.split_axis;
  // The planes of a clip node bound its child from below and above, those of a split the other way round.
  const bool clip = node.kind == NodeKind::clip;
  if (clip || node.kind == NodeKind::one_right)
    boxes.first.lo[axis] = std::max(box.lo[axis], clip ? node.left_clip : node.right_clip);
  if (clip || node.kind == NodeKind::one_left || node.kind == NodeKind::split)
    boxes.first.hi[axis] = std::min(box.hi[axis], clip ? node.right_clip : node.left_clip);
  if (node.kind == NodeKind::split) boxes.second.lo[axis] = std::max(box.lo[axis], node.right_clip);
  return boxes;
}

}  // namespace bihive
