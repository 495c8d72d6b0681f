// A binary tree of boxes (BVH): its layout, its one traversal, and the structure that builders share.
#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "bihive/compare/boxes.h"
#include "bihive/compare/by_ray.h"

namespace bihive::workbench {

/// Builders keep within it; a traversal leaves at most one child waiting on each level.
constexpr std::int64_t kMostBoxLevels = 128;

/// A leaf lists `count` spheres from entry `first` on; an inner node has count 0, and the children `first` and
/// `first` + 1.
struct BoxNode {
  Aabb box;
  std::uint32_t first = 0;
  std::uint32_t count = 0;

  bool is_leaf() const { return count > 0; }
};
static_assert(sizeof(BoxNode) == 32);

/// nodes[0] is the root; children come after their parent. An empty set has no nodes.
struct BoxTree {
  std::vector<BoxNode> nodes;
  std::vector<std::uint32_t> sphere_ids;  ///< in the order of leaves
};

/// Makes all boxes from those of the items, box_of(id), from the last node to the first.
template <class BoxOf>
void fit_boxes(BoxTree& tree, const BoxOf& box_of) {
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    BoxNode& node = tree.nodes[i];
    node.box = {};
    if (node.is_leaf()) {
      for (std::uint32_t k = node.first; k < node.first + node.count; ++k) node.box.add(box_of(tree.sphere_ids[k]));
    } else {
      node.box.add(tree.nodes[node.first].box);
      node.box.add(tree.nodes[node.first + 1].box);
    }
  }
}
inline void fit_boxes(BoxTree& tree, const SphereSet& spheres) {
  fit_boxes(tree, [&](std::uint32_t id) { return outward_box(spheres, id); });
}
StructureFacts facts_of(const BoxTree& tree);

/// Takes a query from box to box. `entry(box)` returns a number that says where the query enters it, or +inf: never;
/// `limit()` the number beyond which nothing is of interest; `visit(id)` true to end.
template <class Entry, class Limit, class Visit, class Counter>
void traverse(const BoxTree& tree, const Entry& entry, const Limit& limit, const Visit& visit, Counter& counter) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  struct Waiting {
    std::uint32_t node;
    double entry;
  };
  std::array<Waiting, kMostBoxLevels> waiting;  // NOLINT(cppcoreguidelines-pro-type-member-init): written before read
  std::size_t waiting_count = 0;

  counter.box_test();
  Waiting at{0, entry(tree.nodes[0].box)};
  if (at.entry == kNever) return;
  for (;;) {
    const BoxNode& node = tree.nodes[at.node];
    Waiting next{0, kNever};
    counter.node(node.is_leaf());
    if (node.is_leaf()) {
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
        if (visit(std::int64_t{tree.sphere_ids[i]})) return;
    } else {
      // Go to the child that is entered first. The other one waits.
      counter.box_test();
      counter.box_test();
      next = {node.first, entry(tree.nodes[node.first].box)};
      Waiting far{node.first + 1, entry(tree.nodes[node.first + 1].box)};
      if (far.entry < next.entry) std::swap(next, far);
      if (far.entry != kNever) waiting[waiting_count++] = far;
    }

    // Enter the next node that may matter; at the limit itself it may hold a smaller id.
    while (next.entry == kNever || next.entry > limit()) {
      if (waiting_count == 0) return;
      next = waiting[--waiting_count];
    }
    at = next;
  }
}

/// A structure that is a box tree, whoever built it.
class BoxTreeStructure final : public ByRay<BoxTreeStructure> {
 public:
  BoxTreeStructure(const SphereSet& spheres, BoxTree tree) : ByRay(spheres), tree_(std::move(tree)) {}

  StructureFacts facts() const override { return facts_of(tree_); }

  template <class Answer, class Counter>
  void trace(const ScaledRay& ray, Answer& answer, Counter& counter) const {
    const RayAndBoxes boxes(ray);
    const auto entry = [&](const Aabb& box) { return boxes.entry(box); };
    traverse(
        tree_, entry, [&] { return answer.limit(); }, [&](std::int64_t id) { return test(ray, id, answer, counter); },
        counter);
  }
  template <class Counter>
  void search(Vec3d point, NearestSphere& nearest, Counter& counter) const {
    const double pad = rounding_pad(point);
    traverse(
        tree_, [&](const Aabb& box) { return least_distance(point, box, pad); }, [&] { return nearest.limit(); },
        [&](std::int64_t id) {
          test(point, id, nearest, counter);
          return false;
        },
        counter);
  }

 private:
  BoxTree tree_;
};

}  // namespace bihive::workbench
