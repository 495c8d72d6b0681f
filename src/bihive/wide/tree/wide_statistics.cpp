#include "bihive/wide/wide_statistics.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace bihive {
namespace {

// A minimum, a mean and a maximum of whole numbers.
class Spread {
 public:
  void add(std::int64_t value) {
    spread_.min = count_ == 0 ? value : std::min(spread_.min, value);
    spread_.max = count_ == 0 ? value : std::max(spread_.max, value);
    sum_ += value;
    ++count_;
  }
  std::int64_t count() const { return count_; }
  std::int64_t sum() const { return sum_; }
  MinAvgMax result() const {
    MinAvgMax result = spread_;
    if (count_ > 0) result.avg = static_cast<double>(sum_) / static_cast<double>(count_);
    return result;
  }

 private:
  std::int64_t count_ = 0, sum_ = 0;
  MinAvgMax spread_;
};

Aabb box_of(const WideNode& node, int slot) {
  return {{node.lo[0][slot], node.lo[1][slot], node.lo[2][slot]},
          {node.hi[0][slot], node.hi[1][slot], node.hi[2][slot]}};
}

// Half the surface; 0 for the empty box.
double half_surface(const Aabb& box) {
  if (box.empty()) return 0;
  const double x = double(box.hi.x) - double(box.lo.x);
  const double y = double(box.hi.y) - double(box.lo.y);
  const double z = double(box.hi.z) - double(box.lo.z);
  return x * y + y * z + z * x;
}

Aabb common_part(const Aabb& a, const Aabb& b) {
  Aabb both;
  for (int axis = 0; axis < 3; ++axis) {
    both.lo[axis] = std::max(a.lo[axis], b.lo[axis]);
    both.hi[axis] = std::min(a.hi[axis], b.hi[axis]);
  }
  return both;
}

// Sums of surfaces over all nodes.
struct Surfaces {
  double nodes = 0, leaves = 0, leaf_spheres = 0, overlaps = 0;

  void add(const WideNode& node) {
    Aabb boxes[kWidth];
    Aabb all;
    for (int slot = 0; slot < node.child_count; ++slot) {
      boxes[slot] = box_of(node, slot);
      all.add(boxes[slot]);
      if (node.is_leaf(slot)) {
        leaves += half_surface(boxes[slot]);
        leaf_spheres += half_surface(boxes[slot]) * static_cast<double>(node.sphere_count(slot));
      }
      for (int other = 0; other < slot; ++other) overlaps += half_surface(common_part(boxes[slot], boxes[other]));
    }
    nodes += half_surface(all);
  }
};

}  // namespace

WideStatistics wide_statistics(const WideTree& tree) {
  WideStatistics statistics;
  statistics.spheres = tree.size;
  statistics.nodes = tree.node_count;
  statistics.levels = tree.levels;
  statistics.node_bytes = tree.node_count * static_cast<std::int64_t>(sizeof(WideNode));
  statistics.other_bytes =
      static_cast<std::int64_t>(sizeof(WideTree) + tree.repeated.size() * sizeof(RepeatedSphere) +
                                tree.repeated_filter.size() * sizeof(std::uint32_t) + tree.piles.size() * sizeof(Pile) +
                                tree.others_in_piles.size() * sizeof(std::uint32_t)) +
      (tree.outer != nullptr ? tree.outer->used_bytes() : 0);
  statistics.used_bytes = tree.used_bytes();
  statistics.sphere_bytes = statistics.used_bytes - statistics.node_bytes - statistics.other_bytes;
  statistics.allocated_bytes = tree.allocated_bytes();
  if (tree.node_count == 0) return statistics;

  // Visit every node, with the number of nodes from the root to it.
  Spread children, spheres_per_leaf, nodes_above_leaf;
  std::int64_t leaf_lanes = 0;
  Surfaces surfaces;
  std::vector<std::pair<std::int64_t, std::int64_t>> pending{{0, 1}};
  while (!pending.empty()) {
    const auto [number, level] = pending.back();
    pending.pop_back();
    const WideNode& node = tree.nodes[number];
    children.add(node.child_count);
    surfaces.add(node);
    for (int slot = 0; slot < node.child_count; ++slot) {
      if (!node.is_leaf(slot)) {
        pending.emplace_back(node.child_node(slot), level + 1);
        continue;
      }
      const std::int64_t spheres = node.sphere_count(slot);
      spheres_per_leaf.add(spheres);
      nodes_above_leaf.add(level);
      leaf_lanes += (spheres + kWidth - 1) / kWidth * kWidth;
    }
  }
  statistics.leaves = spheres_per_leaf.count();
  statistics.children = children.result();
  statistics.spheres_per_leaf = spheres_per_leaf.result();
  statistics.nodes_above_leaf = nodes_above_leaf.result();
  statistics.node_fill = static_cast<double>(children.sum()) / static_cast<double>(kWidth * children.count());
  statistics.leaf_fill = static_cast<double>(tree.placed) / static_cast<double>(leaf_lanes);

  // A box without a surface is a line or a point. A ray meets everything on it, or nothing.
  if (surfaces.nodes > 0) statistics.overlap = surfaces.overlaps / surfaces.nodes;
  const double all = half_surface(tree.aabb);
  if (all > 0) {
    statistics.expected_nodes = surfaces.nodes / all;
    statistics.expected_leaves = surfaces.leaves / all;
    statistics.expected_spheres = surfaces.leaf_spheres / all;
  } else {
    statistics.expected_nodes = static_cast<double>(statistics.nodes);
    statistics.expected_leaves = static_cast<double>(statistics.leaves);
    statistics.expected_spheres = static_cast<double>(statistics.spheres);
  }
  return statistics;
}

}  // namespace bihive
