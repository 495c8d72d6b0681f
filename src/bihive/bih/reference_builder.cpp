#include "bihive/bih/reference_builder.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "bihive/base/watch.h"
#include "bihive/math/infinity.h"

namespace bihive {
namespace {

// A clip node is made if the node's box is this many times longer than its content. Found by fitting the thesis's
// counts of optimized nodes [Aroxa2014, Table 4.2].
constexpr float kClipGain = 1.3f;

// Limits for hostile sets. Each turn halves one side of a box of at most 2 stored units, and binary32 ends 150 halvings
// below that. So a node takes at most about 450 turns.
constexpr int kMostTurns = 1000;
constexpr std::int64_t kDeepest = 1000;

// A range of the index array that has yet to become a subtree at nodes[node].
struct Job {
  std::int64_t node;
  std::int64_t first, last;  // half-open, positions in sphere_ids
  Aabb grid;                 // the box that is halved
  Aabb box;                  // the box of the range that the planes above promise
  std::int64_t depth;
};

// The planes that a partition of a range found.
struct Partition {
  std::int64_t middle;                // first position of the right side
  float left_clip = -kInfiniteFloat;  // largest upper bound on the left
  float right_clip = kInfiniteFloat;  // smallest lower bound on the right
  float lowest = kInfiniteFloat;      // smallest lower bound of all
  float highest = -kInfiniteFloat;    // largest upper bound of all
};

// The half that the latest turn of the loop found really empty.
struct EmptyHalf {
  bool exists = false;
  int axis = 0;
  bool right_is_empty = false;
  float clip = 0;
};

// Spheres or boxes: their number, and the box of each.
std::int64_t size_of(const SphereSet& spheres) {
  return spheres.size();
}
std::int64_t size_of(const std::vector<Aabb>& boxes) {
  return static_cast<std::int64_t>(boxes.size());
}
Aabb box_of(const SphereSet& spheres, std::int64_t id) {
  return spheres.stored_box(id);
}
Aabb box_of(const std::vector<Aabb>& boxes, std::int64_t id) {
  return boxes[static_cast<std::size_t>(id)];
}

template <class Spheres>
class Builder {
 public:
  Builder(const Spheres& spheres, const BuildParameters& parameters) : spheres_(spheres) {
    tree_.parameters = parameters;
  }

  Tree build() {
    // Start with all spheres in one range and their common box.
    const std::int64_t count = size_of(spheres_);
    spheres_read_ = count;
    tree_.sphere_ids.resize(static_cast<std::size_t>(count));
    for (std::int64_t id = 0; id < count; ++id) {
      tree_.sphere_ids[static_cast<std::size_t>(id)] = id;
      tree_.aabb.add(box_of(spheres_, id));
    }
    tree_.nodes.emplace_back();
    jobs_.push_back({0, 0, count, tree_.aabb, tree_.aabb, 1});

    // Turn ranges into subtrees until none is left.
    while (!jobs_.empty()) {
      const Job job = jobs_.back();
      jobs_.pop_back();
      stop_if_cancelled(static_cast<double>(in_leaves_) / static_cast<double>(std::max<std::int64_t>(count, 1)));
      build_subtree(job);
    }
    tree_.nodes.shrink_to_fit();
    return std::move(tree_);
  }

  std::int64_t spheres_read() const { return spheres_read_; }

 private:
  void build_subtree(const Job& job) {
    // Stop at a small range or at the deepest level.
    if (job.last - job.first <= tree_.parameters.max_prims || job.depth >= tree_.parameters.max_depth)
      return make_leaf(job, false);
    if (job.depth >= kDeepest) return make_leaf(job, true);

    // Halve the grid box until both halves are occupied.
    Aabb grid = job.grid;
    EmptyHalf empty;
    int previous_axis = -1;
    float previous_split = 0;
    for (int turn = 0; turn < kMostTurns; ++turn) {
      const int axis = longest_axis(grid);
      const float split = 0.5f * (grid.lo[axis] + grid.hi[axis]);
      const Partition part = partition(job, axis, split);

      // Cut empty space away on both sides by a clip node.
      const float box_length = job.box.hi[axis] - job.box.lo[axis];
      if (part.lowest > job.box.lo[axis] && part.highest < job.box.hi[axis] &&
          kClipGain * (part.highest - part.lowest) < box_length)
        return make_clip(job, axis, part, grid);

      const bool all_left = part.middle == job.last;
      const bool all_right = part.middle == job.first;
      if (!all_left && !all_right) return make_split(job, axis, split, part, grid, empty);

      // All spheres are on one side: keep that half, and remember whether the other half is really empty.
      if (axis == previous_axis && split == previous_split) return make_leaf(job, true);
      previous_axis = axis;
      previous_split = split;
      if (all_left) {
        grid.hi[axis] = split;
        empty = {part.left_clip <= split, axis, true, part.left_clip};
      } else {
        grid.lo[axis] = split;
        empty = {part.right_clip >= split, axis, false, part.right_clip};
      }
    }
    make_leaf(job, true);
  }

  static int longest_axis(const Aabb& grid) {
    const float x = grid.hi.x - grid.lo.x;
    const float y = grid.hi.y - grid.lo.y;
    const float z = grid.hi.z - grid.lo.z;
    if (x > y && x > z) return 0;
    return y > z ? 1 : 2;
  }

  // Sends a sphere left if the middle of its box is at or below the split. Works in place.
  Partition partition(const Job& job, int axis, float split) {
    spheres_read_ += job.last - job.first;
    Partition part;
    std::int64_t left = job.first;
    std::int64_t right = job.last;
    while (left < right) {
      std::int64_t& id = tree_.sphere_ids[static_cast<std::size_t>(left)];
      const Aabb box = box_of(spheres_, id);
      const float lo = box.lo[axis];
      const float hi = box.hi[axis];
      part.lowest = std::min(part.lowest, lo);
      part.highest = std::max(part.highest, hi);
      if (0.5f * (lo + hi) <= split) {
        part.left_clip = std::max(part.left_clip, hi);
        ++left;
      } else {
        part.right_clip = std::min(part.right_clip, lo);
        --right;
        std::swap(id, tree_.sphere_ids[static_cast<std::size_t>(right)]);
      }
    }
    part.middle = left;
    return part;
  }

  Node& node_at(std::int64_t position) { return tree_.nodes[static_cast<std::size_t>(position)]; }

  std::int64_t add_nodes(int count) {
    const auto first = static_cast<std::int64_t>(tree_.nodes.size());
    tree_.nodes.resize(tree_.nodes.size() + static_cast<std::size_t>(count));
    return first;
  }

  void make_leaf(const Job& job, bool forced) {
    Node& node = node_at(job.node);
    node.kind = NodeKind::leaf;
    node.first = job.first;
    node.sphere_count = job.last - job.first;
    in_leaves_ += node.sphere_count;
    if (forced) ++tree_.forced_leaves;
  }

  void make_clip(const Job& job, int axis, const Partition& part, const Aabb& grid) {
    const std::int64_t child = add_nodes(1);
    Node& node = node_at(job.node);
    node.kind = NodeKind::clip;
    node.split_axis = static_cast<std::uint8_t>(axis);
    node.left_clip = part.lowest;
    node.right_clip = part.highest;
    node.first = child;
    Aabb box = job.box;
    box.lo[axis] = part.lowest;
    box.hi[axis] = part.highest;
    jobs_.push_back({child, job.first, job.last, grid, box, job.depth + 1});
  }

  void make_split(const Job& job, int axis, float split, const Partition& part, const Aabb& grid,
                  const EmptyHalf& empty) {
    // Put a one-sided node above the split if the turn before found an empty half. The empty leaf is only counted.
    std::int64_t position = job.node;
    std::int64_t depth = job.depth;
    if (empty.exists && depth + 1 < std::min(tree_.parameters.max_depth, kDeepest)) {
      const std::int64_t child = add_nodes(1);
      Node& above = node_at(position);
      above.kind = empty.right_is_empty ? NodeKind::one_left : NodeKind::one_right;
      above.split_axis = static_cast<std::uint8_t>(empty.axis);
      above.left_clip = empty.right_is_empty ? empty.clip : -kInfiniteFloat;
      above.right_clip = empty.right_is_empty ? kInfiniteFloat : empty.clip;
      above.first = child;
      ++depth;
      ++tree_.empty_leaves;
      position = child;
    }

    // The split itself: two planes, two children.
    const std::int64_t children = add_nodes(2);
    Node& node = node_at(position);
    node.kind = NodeKind::split;
    node.split_axis = static_cast<std::uint8_t>(axis);
    node.left_clip = part.left_clip;
    node.right_clip = part.right_clip;
    node.first = children;
    Job right{children + 1, part.middle, job.last, grid, job.box, depth + 1};
    right.grid.lo[axis] = split;
    right.box.lo[axis] = part.right_clip;
    jobs_.push_back(right);
    Job left{children, job.first, part.middle, grid, job.box, depth + 1};
    left.grid.hi[axis] = split;
    left.box.hi[axis] = part.left_clip;
    jobs_.push_back(left);
  }

  const Spheres& spheres_;
  Tree tree_;
  std::vector<Job> jobs_;
  std::int64_t spheres_read_ = 0;
  std::int64_t in_leaves_ = 0;  // spheres
};

}  // namespace

Tree build_reference_tree(const SphereSet& spheres, const BuildParameters& parameters, std::int64_t* spheres_read) {
  BIHIVE_CHECK_GE(parameters.max_prims, 1);
  BIHIVE_CHECK_GE(parameters.max_depth, 1);
  Builder builder(spheres, parameters);
  Tree tree = builder.build();
  if (spheres_read != nullptr) *spheres_read = builder.spheres_read();
  return tree;
}

Tree build_reference_tree(const std::vector<Aabb>& boxes, const BuildParameters& parameters) {
  BIHIVE_CHECK_GE(parameters.max_prims, 1);
  BIHIVE_CHECK_GE(parameters.max_depth, 1);
  return Builder(boxes, parameters).build();
}

}  // namespace bihive
