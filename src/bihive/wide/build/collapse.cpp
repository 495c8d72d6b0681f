#include "bihive/wide/build/collapse.h"

#include <algorithm>
#include <cstring>
#include <new>

#include "bihive/base/parallel.h"
#include "bihive/math/infinity.h"
#include "bihive/wide/build/tuning.h"

namespace bihive {
namespace {

// The children of a wide node from left to right, and the splits between them: axis[i] is the axis of the split between
// children i and i + 1, and depth[i] the number of splits above it.
struct Children {
  int count = 0;
  const BinaryNode* binary[kWidth];
  int depth_of_child[kWidth];
  std::uint32_t axis[kWidth];
  int depth[kWidth];
};

// Splits a child: its two sides take its slot and the next.
void split_child(Children& children, int slot) {
  for (int i = children.count; i > slot + 1; --i) {
    children.binary[i] = children.binary[i - 1];
    children.depth_of_child[i] = children.depth_of_child[i - 1];
    children.axis[i - 1] = children.axis[i - 2];
    children.depth[i - 1] = children.depth[i - 2];
  }
  const BinaryNode& node = *children.binary[slot];
  const int depth = children.depth_of_child[slot];
  for (int side = 0; side < 2; ++side) {
    children.binary[slot + side] = &node.split->side[side];
    children.depth_of_child[slot + side] = depth + 1;
  }
  children.axis[slot] = node.axis;
  children.depth[slot] = depth;
  ++children.count;
}

// Splits the child with most spheres, again and again.
void choose_by_count(Children& children) {
  while (children.count < kWidth) {
    int best = -1;
    for (int i = 0; i < children.count; ++i)
      if (!children.binary[i]->is_leaf() && (best < 0 || children.binary[i]->count > children.binary[best]->count))
        best = i;
    if (best < 0) return;
    split_child(children, best);
  }
}

float cost_in_slots(const BinaryNode& node, int slots) {
  return node.is_leaf() ? 0 : node.split->cost[slots - 1];
}

// Splits the child at `slot` as its costs say (wide/build/slot_costs-inl.h), so that it takes at most `slots`; returns
// how many it takes.
int choose_by_cost(Children& children, int slot, int slots, bool is_root) {
  const BinaryNode& node = *children.binary[slot];
  if (node.is_leaf() || slots == 1) return 1;
  const BinaryNode& left = node.split->side[0];
  const BinaryNode& right = node.split->side[1];
  int best = 1;
  float best_cost = kInfiniteFloat;
  for (int i = 1; i < slots; ++i) {
    const float cost = cost_in_slots(left, i) + cost_in_slots(right, slots - i);
    if (cost < best_cost) {
      best = i;
      best_cost = cost;
    }
  }
  if (!is_root && best_cost >= node.split->cost[0]) return 1;
  split_child(children, slot);
  const int taken = choose_by_cost(children, slot, best, false);
  return taken + choose_by_cost(children, slot + taken, slots - best, false);
}

// Slots from near to far for directions of that octant: at every split the nearer side comes first.
void add_in_order(const Children& children, int octant, int first, int last, std::uint64_t& order, int& place) {
  if (first == last) {
    order |= static_cast<std::uint64_t>(first) << (4 * place++);
    return;
  }
  int top = first;
  for (int i = first; i < last; ++i)
    if (children.depth[i] < children.depth[top]) top = i;
  const bool right_first = (octant >> children.axis[top] & 1) != 0;
  if (right_first) add_in_order(children, octant, top + 1, last, order, place);
  add_in_order(children, octant, first, top, order, place);
  if (!right_first) add_in_order(children, octant, top + 1, last, order, place);
}

void fill_orders(const Children& children, WideNode& wide) {
  for (int octant = 0; octant < 4; ++octant) {
    int place = 0;
    wide.order[octant] = 0;
    add_in_order(children, octant, 0, children.count - 1, wide.order[octant], place);
    for (; place < kWidth; ++place) wide.order[octant] |= static_cast<std::uint64_t>(place) << (4 * place);
  }
}

}  // namespace

WideNode Collapse::make_node(const Job& job, Subtree& subtree, std::vector<Job>& jobs) const {
  // Choose by cost, but by count when few levels remain.
  const bool last_level = job.level >= parameters_.most_levels;
  Children children;
  children.count = 1;
  children.binary[0] = job.binary;
  children.depth_of_child[0] = 0;
  if (job.level + kLevelsByCost < parameters_.most_levels)
    choose_by_cost(children, 0, kWidth, true);
  else
    choose_by_count(children);

  // Boxes and ranges.
  WideNode wide;
  std::memset(&wide, 0, sizeof wide);
  wide.first_sphere = job.first;
  wide.child_count = static_cast<std::uint16_t>(children.count);
  std::uint32_t begin = 0;
  for (int i = 0; i < children.count; ++i) {
    const BinaryNode& child = *children.binary[i];
    for (int axis = 0; axis < 3; ++axis) {
      wide.lo[axis][i] = child.box.lo[axis];
      wide.hi[axis][i] = child.box.hi[axis];
    }
    wide.begin[i] = begin;
    begin += child.count;
    if (child.is_leaf() || last_level) {
      wide.leaf_mask = static_cast<std::uint16_t>(wide.leaf_mask | 1u << i);
      subtree.largest_leaf = std::max(subtree.largest_leaf, std::int64_t{child.count});
    }
  }
  for (int i = children.count; i < kWidth; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      wide.lo[axis][i] = kInfiniteFloat;
      wide.hi[axis][i] = -kInfiniteFloat;
    }
    wide.begin[i] = begin;
  }
  wide.begin[kWidth] = begin;
  fill_orders(children, wide);

  // Place the inner children side by side, and queue them from left to right.
  subtree.levels = std::max(subtree.levels, job.level);
  wide.first_node = static_cast<std::int64_t>(subtree.nodes.size());
  const int inner = children.count - __builtin_popcount(wide.leaf_mask);
  subtree.nodes.resize(subtree.nodes.size() + static_cast<std::size_t>(inner));
  for (int i = children.count - 1; i >= 0; --i)
    if (!wide.is_leaf(i)) jobs.push_back({wide.child_node(i), children.binary[i], wide.sphere_begin(i), job.level + 1});
  return wide;
}

void Collapse::make_subtree(Subtree& subtree) const {
  subtree.nodes.clear();
  subtree.jobs.clear();
  subtree.largest_leaf = 0;
  subtree.levels = 0;
  subtree.root_node = make_node(subtree.root, subtree, subtree.jobs);
  while (!subtree.jobs.empty()) {
    const Job job = subtree.jobs.back();
    subtree.jobs.pop_back();
    const WideNode node = make_node(job, subtree, subtree.jobs);
    subtree.nodes[static_cast<std::size_t>(job.place)] = node;
  }
}

void Collapse::run(const BinaryNode& root, const CollapseParameters& parameters, int threads, WatchedWork& work) {
  parameters_ = parameters;

  // Build the top here; each subtree of at most kSubtreeSpheres spheres becomes a task.
  subtree_count_ = 0;
  top_.nodes.clear();
  top_.nodes.resize(1);
  top_.largest_leaf = 0;
  top_.levels = 0;
  top_.jobs.assign(1, {0, &root, 0, 1});
  while (!top_.jobs.empty()) {
    const Job job = top_.jobs.back();
    top_.jobs.pop_back();
    if (job.binary->count <= kSubtreeSpheres) {
      if (subtree_count_ == subtrees_.size()) subtrees_.emplace_back();
      subtrees_[subtree_count_++].root = job;
      continue;
    }
    const WideNode node = make_node(job, top_, top_.jobs);
    top_.nodes[static_cast<std::size_t>(job.place)] = node;
  }
  parallel_for(threads, static_cast<std::int64_t>(subtree_count_), [this, &work](std::int64_t i) {
    if (work.cancelled()) return;
    Subtree& subtree = subtrees_[static_cast<std::size_t>(i)];
    try {
      subtree.out_of_memory = false;
      make_subtree(subtree);
    } catch (const std::bad_alloc&) {
      subtree.out_of_memory = true;
    }
  });

  work.stop_if_cancelled();

  // Put the subtrees one after the other.
  node_count_ = static_cast<std::int64_t>(top_.nodes.size());
  largest_leaf_ = top_.largest_leaf;
  levels_ = top_.levels;
  for (std::size_t i = 0; i < subtree_count_; ++i) {
    Subtree& subtree = subtrees_[i];
    if (subtree.out_of_memory) throw std::bad_alloc();
    subtree.base = node_count_;
    node_count_ += static_cast<std::int64_t>(subtree.nodes.size());
    largest_leaf_ = std::max(largest_leaf_, subtree.largest_leaf);
    levels_ = std::max(levels_, subtree.levels);
  }
}

void Collapse::copy_to(WideNode* to, int threads) const {
  std::memcpy(to, top_.nodes.data(), top_.nodes.size() * sizeof(WideNode));
  parallel_for(threads, static_cast<std::int64_t>(subtree_count_), [this, to](std::int64_t i) {
    const Subtree& subtree = subtrees_[static_cast<std::size_t>(i)];
    WideNode& root = to[subtree.root.place];
    root = subtree.root_node;
    root.first_node += subtree.base;
    for (std::size_t k = 0; k < subtree.nodes.size(); ++k) {
      WideNode& node = to[subtree.base + static_cast<std::int64_t>(k)];
      node = subtree.nodes[k];
      node.first_node += subtree.base;
    }
  });
}

std::int64_t Collapse::allocated_bytes() const {
  std::size_t bytes = top_.nodes.capacity() * sizeof(WideNode) + subtrees_.capacity() * sizeof(Subtree);
  for (const Subtree& subtree : subtrees_)
    bytes += subtree.nodes.capacity() * sizeof(WideNode) + subtree.jobs.capacity() * sizeof(Job);
  return static_cast<std::int64_t>(bytes);
}

}  // namespace bihive
