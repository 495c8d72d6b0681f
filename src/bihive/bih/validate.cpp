#include "bihive/bih/validate.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bihive/bih/statistics.h"
#include "bihive/math/infinity.h"

namespace bihive {
namespace {

Error wrong(const std::string& what, std::int64_t position) {
  return {"tree: node " + std::to_string(position) + ": " + what, "", 0, 0, ""};
}

// A node to visit, with the box that the planes above promise and its depth.
struct Visit {
  std::int64_t position;
  Aabb promised;
  std::int64_t depth;
};

// The visits of an inner node's children.
std::vector<Visit> children_of(const Node& node, const Visit& visit) {
  const int axis = node.split_axis;
  std::vector<Visit> children{{node.first, visit.promised, visit.depth + 1}};
  const auto narrow = [axis](Aabb& box, float lo, float hi) {
    box.lo[axis] = std::max(box.lo[axis], lo);
    box.hi[axis] = std::min(box.hi[axis], hi);
  };
  switch (node.kind) {
    case NodeKind::clip:
      narrow(children[0].promised, node.left_clip, node.right_clip);
      break;
    case NodeKind::one_left:
      narrow(children[0].promised, -kInfiniteFloat, node.left_clip);
      break;
    case NodeKind::one_right:
      narrow(children[0].promised, node.right_clip, kInfiniteFloat);
      break;
    case NodeKind::split:
      children.push_back({node.right_child(), visit.promised, visit.depth + 1});
      narrow(children[0].promised, -kInfiniteFloat, node.left_clip);
      narrow(children[1].promised, node.right_clip, kInfiniteFloat);
      break;
    case NodeKind::leaf:
      break;
  }
  return children;
}

}  // namespace

Status validate_tree(const Tree& tree, const SphereSet& spheres) {
  if (tree.nodes.empty()) return wrong("there is no root", 0);
  if (static_cast<std::int64_t>(tree.sphere_ids.size()) != spheres.size())
    return wrong("the index array does not have one entry per sphere", 0);

  // Traverse the tree; mark each node and sphere reached.
  std::vector<bool> node_met(tree.nodes.size()), sphere_met(tree.sphere_ids.size());
  std::int64_t oversized = 0;
  std::vector<Visit> pending{{0, tree.aabb, 1}};
  while (!pending.empty()) {
    const Visit visit = pending.back();
    pending.pop_back();
    const std::int64_t at = visit.position;
    if (at < 0 || at >= static_cast<std::int64_t>(tree.nodes.size())) return wrong("is outside the tree", at);
    if (node_met[static_cast<std::size_t>(at)]) return wrong("is reached twice", at);
    node_met[static_cast<std::size_t>(at)] = true;
    const Node& node = tree.nodes[static_cast<std::size_t>(at)];
    if (visit.depth > tree.parameters.max_depth) return wrong("lies deeper than max_depth", at);
    if (!node.is_leaf()) {
      if (node.split_axis > 2) return wrong("has no axis", at);
      if (std::isnan(node.left_clip) || std::isnan(node.right_clip))
        return wrong("has a plane that is not a number", at);
      for (const Visit& child : children_of(node, visit)) pending.push_back(child);
      continue;
    }

    // A leaf holds every sphere once, inside the planes above it.
    const std::int64_t end = node.first_sphere() + node.sphere_count;
    if (node.first_sphere() < 0 || node.sphere_count < 0 || end > spheres.size())
      return wrong("has a range outside the index array", at);
    if (node.sphere_count > tree.parameters.max_prims && visit.depth < tree.parameters.max_depth) ++oversized;
    for (std::int64_t i = node.first_sphere(); i < end; ++i) {
      const std::int64_t id = tree.sphere_ids[static_cast<std::size_t>(i)];
      if (id < 0 || id >= spheres.size()) return wrong("holds a sphere that does not exist", at);
      if (sphere_met[static_cast<std::size_t>(id)]) return wrong("holds a sphere of another leaf", at);
      sphere_met[static_cast<std::size_t>(id)] = true;
      const Aabb box = spheres.stored_box(id);
      for (int axis = 0; axis < 3; ++axis)
        if (box.lo[axis] < visit.promised.lo[axis] || box.hi[axis] > visit.promised.hi[axis])
          return wrong("a clip plane above cuts sphere " + std::to_string(id), at);
    }
  }

  // The traversal reached everything, and the counts agree.
  for (std::size_t i = 0; i < node_met.size(); ++i)
    if (!node_met[i]) return wrong("is not reached from the root", static_cast<std::int64_t>(i));
  for (std::size_t i = 0; i < sphere_met.size(); ++i)
    if (!sphere_met[i]) return wrong("sphere " + std::to_string(i) + " is in no leaf", 0);
  const TreeStatistics statistics = tree_statistics(tree);
  if (statistics.inner_nodes != statistics.leaves - 1 + statistics.optimized_nodes)
    return wrong("inner nodes are not leaves - 1 + optimized nodes", 0);
  if (statistics.one_sided_nodes != tree.empty_leaves)
    return wrong("one-sided nodes: " + std::to_string(statistics.one_sided_nodes) +
                     ", but empty leaves: " + std::to_string(tree.empty_leaves),
                 0);
  if (oversized != tree.forced_leaves)
    return wrong("leaves over max_prims and above max_depth: " + std::to_string(oversized) +
                     ", but forced leaves: " + std::to_string(tree.forced_leaves),
                 0);
  return Done{};
}

}  // namespace bihive
