#include "bihive/render/query/stick_tree.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

#include "bihive/base/check.h"

namespace bihive {
namespace {

// An inner node of the binary tree, or sticks that lie side by side in its leaves.
struct Branch {
  std::int64_t node = -1;  // below 0: sticks
  std::int64_t first = 0, count = 0;
  Aabb box;

  bool is_stick() const { return node < 0 && count == 1; }
};

double half_surface(const Aabb& box) {
  const Vec3d size = to_double(box.hi) - to_double(box.lo);
  return size.x * size.y + size.y * size.z + size.z * size.x;
}

class Collapse {
 public:
  Collapse(const std::vector<Aabb>& boxes, const Tree& tree, std::vector<StickNode>& nodes)
      : boxes_(boxes), tree_(tree), nodes_(nodes) {
    // Fit the boxes of the binary tree. Children come after their parent.
    fitted_.resize(tree.nodes.size());
    for (std::size_t i = tree.nodes.size(); i-- > 0;) {
      const Node& node = tree.nodes[i];
      if (node.is_leaf()) {
        fitted_[i] = box_of(node.first_sphere(), node.sphere_count);
        continue;
      }
      BIHIVE_CHECK(node.first > static_cast<std::int64_t>(i));
      fitted_[i] = fitted_[static_cast<std::size_t>(node.first)];
      if (node.kind == NodeKind::split) fitted_[i].add(fitted_[static_cast<std::size_t>(node.right_child())]);
    }
  }

  // Returns the number of levels.
  int run() {
    struct Pending {
      std::size_t number;
      int level;
      Branch branch;
    };
    int levels = 0;
    nodes_.emplace_back();
    std::vector<Pending> pending{{0, 1, branch_of(0)}};
    while (!pending.empty()) {
      const auto [number, level, branch] = pending.back();
      pending.pop_back();
      levels = std::max(levels, level);
      collect(branch);
      StickNode made;
      for (std::size_t slot = 0; slot < kStickWidth; ++slot) {
        const bool is_used = slot < count_;
        const Aabb box = is_used ? children_[slot].box : Aabb();
        for (int axis = 0; axis < 3; ++axis) {
          made.lo[axis][slot] = box.lo[axis];
          made.hi[axis][slot] = box.hi[axis];
        }
        made.child[slot] = 0;
        if (!is_used) continue;
        const Branch& child = children_[slot];
        if (child.is_stick()) {
          made.child[slot] = ~static_cast<std::int32_t>(stick(child.first));
        } else {
          made.child[slot] = static_cast<std::int32_t>(nodes_.size());
          pending.push_back({nodes_.size(), level + 1, child});
          nodes_.emplace_back();
        }
      }
      nodes_[number] = made;
    }
    return levels;
  }

 private:
  std::int64_t stick(std::int64_t place) const { return tree_.sphere_ids[static_cast<std::size_t>(place)]; }

  Aabb box_of(std::int64_t first, std::int64_t count) const {
    Aabb box;
    for (std::int64_t i = first; i < first + count; ++i) box.add(boxes_[static_cast<std::size_t>(stick(i))]);
    return box;
  }

  Branch branch_of(std::int64_t position) const {
    const Node* node = &tree_.nodes[static_cast<std::size_t>(position)];
    while (!node->is_leaf() && node->kind != NodeKind::split) {
      position = node->first;
      node = &tree_.nodes[static_cast<std::size_t>(position)];
    }
    const Aabb& box = fitted_[static_cast<std::size_t>(position)];
    if (node->is_leaf()) return {-1, node->first_sphere(), node->sphere_count, box};
    return {position, 0, 0, box};
  }

  std::pair<Branch, Branch> parts_of(const Branch& branch) const {
    if (branch.node >= 0) {
      const Node& node = tree_.nodes[static_cast<std::size_t>(branch.node)];
      return {branch_of(node.first), branch_of(node.right_child())};
    }
    const std::int64_t half = branch.count / 2, middle = branch.first + half;
    return {{-1, branch.first, half, box_of(branch.first, half)},
            {-1, middle, branch.count - half, box_of(middle, branch.count - half)}};
  }

  // The children of a node: the branch with the largest surface is divided until all slots are full.
  void collect(const Branch& branch) {
    children_[0] = branch;
    count_ = 1;
    while (count_ < kStickWidth) {
      std::size_t largest = count_;
      for (std::size_t i = 0; i < count_; ++i)
        if (!children_[i].is_stick() &&
            (largest == count_ || half_surface(children_[i].box) > half_surface(children_[largest].box)))
          largest = i;
      if (largest == count_) return;
      auto [one, other] = parts_of(children_[largest]);
      children_[largest] = one;
      children_[count_++] = other;
    }
  }

  const std::vector<Aabb>& boxes_;
  const Tree& tree_;
  std::vector<StickNode>& nodes_;
  std::vector<Aabb> fitted_;
  std::array<Branch, kStickWidth> children_;
  std::size_t count_ = 0;
};

}  // namespace

StickTree::StickTree(const std::vector<Aabb>& boxes, const Tree& tree) {
  if (boxes.empty()) return;
  levels_ = Collapse(boxes, tree, nodes_).run();
  double sum = 0;
  for (const Aabb& box : boxes) {
    box_.add(box);
    const Vec3d size = to_double(box.hi) - to_double(box.lo);
    sum += std::max({size.x, size.y, size.z});
  }
  mean_extent_ = sum / static_cast<double>(boxes.size());
}

}  // namespace bihive
