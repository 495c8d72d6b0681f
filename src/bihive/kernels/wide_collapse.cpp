#include "bihive/kernels/wide_collapse.h"

#include <algorithm>
#include <limits>

namespace bihive {
namespace {

constexpr float kInf = std::numeric_limits<float>::infinity();

// From this level on the child with most spheres is split, not the largest, so that levels stay few on any set.
constexpr int kLevelsByArea = 24;

// A wide node to be made.
struct Job {
  std::int64_t wide;     // its number
  std::uint32_t binary;  // number of the binary node that it stands for
  int level;             // 1 for the root
};

// The children of a wide node from left to right, and the splits between them: axis[i] is where the two sides that meet
// between children i and i + 1 were parted, and depth[i] how many splits lie above that one.
struct Children {
  int count = 0;
  std::uint32_t binary[kWidth];
  int depth_of_child[kWidth];
  std::uint32_t axis[kWidth];
  int depth[kWidth];
};

// What a wide node's children should hold at most: the largest power of sixteen full leaves below n.
std::int64_t target_count(std::int64_t n, std::int64_t full_leaf) {
  std::int64_t target = full_leaf;
  while (target < n / kWidth) target *= kWidth;
  return target;
}

Children choose_children(const std::vector<BinaryNode>& nodes, const Job& job, std::int64_t target) {
  Children children;
  children.count = 1;
  children.binary[0] = job.binary;
  children.depth_of_child[0] = 0;
  while (children.count < kWidth) {
    // Split the largest child that holds more than the target.
    int best = -1;
    float best_size = -1;
    for (int i = 0; i < children.count; ++i) {
      const BinaryNode& node = nodes[children.binary[i]];
      if (node.is_leaf() || (node.count <= target && children.count > 1)) continue;
      const float size = job.level < kLevelsByArea ? node.half_area() : static_cast<float>(node.count);
      if (size > best_size) {
        best = i;
        best_size = size;
      }
    }
    if (best < 0) break;
    const BinaryNode& node = nodes[children.binary[best]];
    const int depth = children.depth_of_child[best];
    for (int i = children.count; i > best + 1; --i) {
      children.binary[i] = children.binary[i - 1];
      children.depth_of_child[i] = children.depth_of_child[i - 1];
      children.axis[i - 1] = children.axis[i - 2];
      children.depth[i - 1] = children.depth[i - 2];
    }
    children.binary[best] = node.child;
    children.binary[best + 1] = node.child + 1;
    children.depth_of_child[best] = children.depth_of_child[best + 1] = depth + 1;
    children.axis[best] = node.axis;
    children.depth[best] = depth;
    ++children.count;
  }
  return children;
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

void fill_node(const std::vector<BinaryNode>& nodes, const Children& children, std::uint32_t binary, bool last_level,
               WideNode& wide) {
  const BinaryNode& parent = nodes[binary];
  wide = {};
  wide.first_sphere = parent.first;
  wide.child_count = static_cast<std::uint16_t>(children.count);
  for (int i = 0; i < kWidth; ++i) {
    const bool used = i < children.count;
    const BinaryNode& child = nodes[children.binary[used ? i : 0]];
    for (int axis = 0; axis < 3; ++axis) {
      wide.lo[axis][i] = used ? child.box.lo[axis] : kInf;
      wide.hi[axis][i] = used ? child.box.hi[axis] : -kInf;
    }
    wide.begin[i] = used ? child.first - parent.first : parent.count;
    if (used && (child.is_leaf() || last_level)) wide.leaf_mask = static_cast<std::uint16_t>(wide.leaf_mask | 1u << i);
  }
  wide.begin[kWidth] = parent.count;
  for (int octant = 0; octant < 4; ++octant) {
    int place = 0;
    add_in_order(children, octant, 0, children.count - 1, wide.order[octant], place);
    for (; place < kWidth; ++place) wide.order[octant] |= static_cast<std::uint64_t>(place) << (4 * place);
  }
}

}  // namespace

WideShape collapse(const std::vector<BinaryNode>& nodes, int most_levels, std::int64_t full_leaf,
                   std::vector<WideNode>& wide) {
  WideShape shape;
  std::vector<Job> jobs{{0, 0, 1}};
  wide.resize(1);
  while (!jobs.empty()) {
    const Job job = jobs.back();
    jobs.pop_back();
    shape.levels = std::max(shape.levels, job.level);

    // Where levels are few, do not wait for targets to be met.
    const bool last_level = job.level >= most_levels;
    const std::int64_t target =
        most_levels < kMostLevels ? full_leaf : target_count(nodes[job.binary].count, full_leaf);
    const Children children = choose_children(nodes, job, target);

    // Place the inner children side by side, and come back to them from left to right.
    const auto first_node = static_cast<std::int64_t>(wide.size());
    WideNode node;
    fill_node(nodes, children, job.binary, last_level, node);
    node.first_node = first_node;
    wide[static_cast<std::size_t>(job.wide)] = node;
    const int inner = node.child_count - __builtin_popcount(node.leaf_mask);
    wide.resize(wide.size() + static_cast<std::size_t>(inner));
    for (int i = children.count - 1; i >= 0; --i) {
      if (node.is_leaf(i))
        shape.largest_leaf = std::max(shape.largest_leaf, node.sphere_count(i));
      else
        jobs.push_back({node.child_node(i), children.binary[i], job.level + 1});
    }
  }
  return shape;
}

}  // namespace bihive
