#include "bihive/wide/wide_validate.h"

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "bihive/math/infinity.h"

namespace bihive {
namespace {

Error wrong(const std::string& what, std::int64_t node) {
  return {"wide tree: node " + std::to_string(node) + ": " + what, "", 0, 0, ""};
}
Error wrong(const std::string& what) {
  return {"wide tree: " + what, "", 0, 0, ""};
}

// A node to visit, with its box, range and level as its parent states them.
struct Visit {
  std::int64_t node;
  Aabb box;
  std::int64_t first, count;
  int level;
};

Aabb box_of_child(const WideNode& node, int slot) {
  return {{node.lo[0][slot], node.lo[1][slot], node.lo[2][slot]},
          {node.hi[0][slot], node.hi[1][slot], node.hi[2][slot]}};
}

bool holds(const Aabb& outer, const Aabb& inner) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(outer.lo[axis] <= inner.lo[axis] && inner.hi[axis] <= outer.hi[axis])) return false;
  return true;
}

// The first entries of an order name each child once.
bool is_permutation(std::uint64_t order, int children) {
  unsigned seen = 0;
  for (int i = 0; i < children; ++i) seen |= 1u << (order >> (4 * i) & 15);
  return seen == (1u << children) - 1;
}

// Checks a node by itself.
const char* wrong_in(const WideNode& node, const Visit& visit) {
  if (node.child_count < 1 || node.child_count > kWidth) return "has no children, or too many";
  if (node.first_sphere != visit.first || node.begin[0] != 0 ||
      node.begin[kWidth] != static_cast<std::uint64_t>(visit.count))
    return "does not have the range that the node above gives it";
  for (int slot = 0; slot < kWidth; ++slot) {
    if (node.begin[slot + 1] < node.begin[slot]) return "has ranges out of order";
    const bool used = slot < node.child_count;
    if (used == (node.sphere_count(slot) == 0)) return "has an empty child, or spheres in a slot without a child";
    if (!used && node.is_leaf(slot)) return "has a leaf in a slot without a child";
    for (int axis = 0; axis < 3 && !used; ++axis)
      if (node.lo[axis][slot] != kInfiniteFloat || node.hi[axis][slot] != -kInfiniteFloat)
        return "has a box in a slot without a child";
  }
  for (const std::uint64_t order : node.order)
    if (!is_permutation(order, node.child_count)) return "has an order that does not name every child once";
  return nullptr;
}

// Checks the slots from `first` on: they hold spheres of the set, each once, inside their box.
Status check_leaf(const WideTree& tree, const SphereSet& set, const Aabb& box, std::int64_t first, std::int64_t count,
                  std::int64_t at, std::vector<bool>& met) {
  for (std::int64_t i = first; i < first + count; ++i) {
    const std::int64_t id = tree.spheres.id(i);
    if (id >= set.size()) return wrong("holds a sphere that does not exist", at);
    if (met[static_cast<std::size_t>(id)]) return wrong("holds a sphere of another leaf", at);
    met[static_cast<std::size_t>(id)] = true;
    if (tree.spheres.centre(i) != set.stored_centre(id) || tree.spheres.radius(i) != set.stored_radius(id))
      return wrong("holds sphere " + std::to_string(id) + " with another centre or radius", at);
    if (!holds(box, set.stored_box(id))) return wrong("a box above cuts sphere " + std::to_string(id), at);
  }
  return Done{};
}

// Marks the duplicates that no leaf holds: each equals the sphere of its group that a leaf holds, and comes after it.
Status check_piles(const WideTree& tree, const SphereSet& set, std::vector<bool>& met) {
  std::size_t first = 0;
  std::int64_t before = -1;
  for (const Pile& pile : tree.piles) {
    if (std::int64_t{pile.id} <= before || pile.id >= set.size() || !met[pile.id] || pile.first_other != first ||
        pile.end_of_others <= first || pile.end_of_others > tree.others_in_piles.size())
      return wrong("the duplicates of sphere " + std::to_string(pile.id) + " are not a group");
    std::int64_t last = before = pile.id;
    for (; first < pile.end_of_others; ++first) {
      const std::int64_t other = tree.others_in_piles[first];
      if (other <= last || other >= set.size() || met[static_cast<std::size_t>(other)] ||
          set.stored_centre(other) != set.stored_centre(pile.id) ||
          set.stored_radius(other) != set.stored_radius(pile.id))
        return wrong("the duplicates of sphere " + std::to_string(pile.id) + " include another sphere");
      met[static_cast<std::size_t>(other)] = true;
      last = other;
    }
  }
  if (first != tree.others_in_piles.size()) return wrong("it has duplicates of no sphere");
  return Done{};
}

Status check_repeated(const WideTree& tree, const SphereSet& set) {
  // Equal spheres are neighbours once sorted.
  const auto key = [&](std::int64_t id) {
    return std::tuple(set.stored_centre(id).x, set.stored_centre(id).y, set.stored_centre(id).z, set.stored_radius(id));
  };
  std::vector<std::int64_t> ids(static_cast<std::size_t>(set.size()));
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::int64_t>(i);
  std::sort(ids.begin(), ids.end(), [&](std::int64_t a, std::int64_t b) { return key(a) < key(b); });
  std::vector<std::int64_t> expected;
  for (std::size_t i = 0; i < ids.size(); ++i)
    if ((i > 0 && key(ids[i - 1]) == key(ids[i])) || (i + 1 < ids.size() && key(ids[i + 1]) == key(ids[i])))
      expected.push_back(ids[i]);
  std::sort(expected.begin(), expected.end());
  if (expected.size() != tree.repeated.size())
    return wrong("it knows " + std::to_string(tree.repeated.size()) + " repeated spheres of " +
                 std::to_string(expected.size()));
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const RepeatedSphere& sphere = tree.repeated[i];
    const bool placed = std::int64_t{sphere.slot} < tree.placed;
    if (sphere.id != expected[i] || !placed || key(sphere.id) != key(tree.spheres.id(sphere.slot)) ||
        (i > 0 && key(sphere.id) == key(tree.repeated[i - 1].id) && sphere.slot != tree.repeated[i - 1].slot))
      return wrong("repeated sphere " + std::to_string(i) + " is another one");
  }
  return Done{};
}

}  // namespace

Status validate_wide_tree(const WideTree& tree, const SphereSet& set) {
  if (tree.size != set.size()) return wrong("it does not have one slot per sphere");
  if (tree.scale != set.scale()) return wrong("its scale differs from the spheres'");
  if (tree.origin != set.origin()) return wrong("its origin differs from the spheres'");
  if (set.empty()) return tree.node_count == 0 ? Status(Done{}) : wrong("it has nodes without spheres");
  if (tree.node_count < 1) return wrong("it has no root");
  if (tree.spheres.has_palette == (tree.spheres.r != nullptr)) return wrong("it has a palette and radii, or neither");

  // Traverse it; mark nodes and spheres as they are met.
  std::vector<bool> node_met(static_cast<std::size_t>(tree.node_count)),
      sphere_met(static_cast<std::size_t>(set.size()));
  std::int64_t largest_leaf = 0;
  int levels = 0;
  std::vector<Visit> waiting{{0, tree.aabb, 0, tree.placed, 1}};
  while (!waiting.empty()) {
    const Visit visit = waiting.back();
    waiting.pop_back();
    const std::int64_t at = visit.node;
    if (at < 0 || at >= tree.node_count) return wrong("is outside the tree", at);
    if (node_met[static_cast<std::size_t>(at)]) return wrong("is reached twice", at);
    node_met[static_cast<std::size_t>(at)] = true;
    levels = std::max(levels, visit.level);
    const WideNode& node = tree.nodes[at];
    if (const char* what = wrong_in(node, visit)) return wrong(what, at);
    for (int slot = 0; slot < node.child_count; ++slot) {
      const Aabb box = box_of_child(node, slot);
      if (!holds(visit.box, box)) return wrong("has a child outside of its own box", at);
      const std::int64_t first = node.sphere_begin(slot), count = node.sphere_count(slot);
      if (!node.is_leaf(slot)) {
        waiting.push_back({node.child_node(slot), box, first, count, visit.level + 1});
        continue;
      }
      largest_leaf = std::max(largest_leaf, count);
      Status leaf = check_leaf(tree, set, box, first, count, at, sphere_met);
      if (!leaf) return leaf;
    }
  }

  Status piles = check_piles(tree, set, sphere_met);
  if (!piles) return piles;

  // Everything was met, and the tree's own numbers agree.
  for (std::size_t i = 0; i < node_met.size(); ++i)
    if (!node_met[i]) return wrong("is not reached from the root", static_cast<std::int64_t>(i));
  for (std::size_t i = 0; i < sphere_met.size(); ++i)
    if (!sphere_met[i]) return wrong("sphere " + std::to_string(i) + " is in no leaf");
  if (levels != tree.levels || levels > kMostLevels) return wrong("it has " + std::to_string(levels) + " levels");
  if (largest_leaf != tree.largest_leaf) return wrong("its largest leaf has " + std::to_string(largest_leaf));
  for (std::int64_t i = tree.placed; i < tree.placed + kWidth; ++i)
    if (tree.spheres.radius(i) != 0 || !(tree.spheres.x[i] > 2)) return wrong("its padding can be hit");
  return check_repeated(tree, set);
}

}  // namespace bihive
