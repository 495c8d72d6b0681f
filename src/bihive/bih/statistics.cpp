#include "bihive/bih/statistics.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace bihive {
namespace {

// Adds up leaves one by one.
class LeafCounter {
 public:
  void add(std::int64_t spheres, std::int64_t depth) {
    const bool first = leaves_ == 0;
    ++leaves_;
    sphere_sum_ += spheres;
    depth_sum_ += depth;
    spheres_.min = first ? spheres : std::min(spheres_.min, spheres);
    spheres_.max = first ? spheres : std::max(spheres_.max, spheres);
    depth_.min = first ? depth : std::min(depth_.min, depth);
    depth_.max = first ? depth : std::max(depth_.max, depth);
    ++leaves_with_[static_cast<std::size_t>(std::min<std::int64_t>(spheres, 5))];
  }

  void write_to(TreeStatistics& statistics) const {
    statistics.leaves = leaves_;
    statistics.spheres = sphere_sum_;
    statistics.spheres_per_leaf = spheres_;
    statistics.depth = depth_;
    statistics.leaves_with = leaves_with_;
    if (leaves_ == 0) return;
    statistics.spheres_per_leaf.avg = static_cast<double>(sphere_sum_) / static_cast<double>(leaves_);
    statistics.depth.avg = static_cast<double>(depth_sum_) / static_cast<double>(leaves_);
  }

 private:
  std::int64_t leaves_ = 0, sphere_sum_ = 0, depth_sum_ = 0;
  MinAvgMax spheres_, depth_;
  std::array<std::int64_t, 6> leaves_with_{};
};

}  // namespace

TreeStatistics tree_statistics(const Tree& tree) {
  // Visit every node with its depth.
  TreeStatistics statistics;
  LeafCounter leaves;
  std::vector<std::pair<std::int64_t, std::int64_t>> pending{{0, 1}};
  while (!pending.empty()) {
    const auto [position, depth] = pending.back();
    pending.pop_back();
    const Node& node = tree.nodes[static_cast<std::size_t>(position)];
    switch (node.kind) {
      case NodeKind::leaf:
        leaves.add(node.sphere_count, depth);
        break;
      case NodeKind::split:
        ++statistics.inner_nodes;
        pending.emplace_back(node.right_child(), depth + 1);
        pending.emplace_back(node.left_child(), depth + 1);
        break;
      case NodeKind::one_left:
      case NodeKind::one_right:
        ++statistics.inner_nodes;
        ++statistics.one_sided_nodes;
        leaves.add(0, depth + 1);
        pending.emplace_back(node.first, depth + 1);
        break;
      case NodeKind::clip:
        ++statistics.inner_nodes;
        ++statistics.optimized_nodes;
        pending.emplace_back(node.first, depth + 1);
        break;
    }
  }
  leaves.write_to(statistics);
  statistics.forced_leaves = tree.forced_leaves;
  return statistics;
}

CompactBytes compact_bytes(std::int64_t inner_nodes, std::int64_t leaves, std::int64_t spheres) {
  constexpr std::int64_t kNodeBytes = 12;
  constexpr std::int64_t kIndexBytes = 4;
  CompactBytes bytes;
  bytes.nodes = kNodeBytes * (inner_nodes + leaves);
  bytes.indices = kIndexBytes * spheres;
  return bytes;
}

}  // namespace bihive
