// bih: the reference bounding interval hierarchy of the thesis, traversed as bih/traversal.h defines it.

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "bihive/bih/child_boxes.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/compare/boxes.h"
#include "bihive/compare/by_ray.h"
#include "bihive/compare/level_sums.h"
#include "bihive/compare/ray_path.h"
#include "bihive/compare/sphere_limit.h"

namespace bihive::workbench {
namespace {

// Counts the steps that the traversal reports.
template <class Counter>
struct Observer {
  Counter& counter;

  void node_visit() { counter.node(false); }
  void leaf_visit() { counter.node(true); }
  void empty_gap() {}
  void sphere_test() {}  // test() counts it
};

class ReferenceBih final : public ByRay<ReferenceBih> {
 public:
  ReferenceBih(const SphereSet& spheres, const BuildParameters& parameters)
      : ByRay(spheres), own_(build_reference_tree(spheres, parameters)), tree_(own_) {}
  ReferenceBih(const SphereSet& spheres, const Tree& tree) : ByRay(spheres), tree_(tree) {}

  StructureFacts facts() const override {
    StructureFacts facts;
    facts.bytes = tree_.allocated_bytes();
    facts.nodes = static_cast<std::int64_t>(tree_.nodes.size());
    if (spheres().empty()) return facts;
    // The nodes' boxes, as the planes above cut them.
    struct Part {
      std::int64_t node;
      Aabb box;
      std::int64_t level;
    };
    LevelSums sums(tree_.aabb);
    std::vector<Part> pending{{0, tree_.aabb, 1}};
    while (!pending.empty()) {
      const auto [position, box, level] = pending.back();
      pending.pop_back();
      const Node& node = tree_.nodes[static_cast<std::size_t>(position)];
      sums.add(level, box, node.is_leaf(), node.is_leaf() ? node.sphere_count : 0);
      if (node.is_leaf()) continue;
      const ChildBoxes of_children = child_boxes(node, box);
      const std::array boxes{of_children.first, of_children.second};
      const bool is_split = node.kind == NodeKind::split;
      sums.add_children(level, box, std::span(boxes).first(is_split ? 2 : 1));
      pending.push_back({node.first, boxes[0], level + 1});
      if (is_split) pending.push_back({node.right_child(), boxes[1], level + 1});
    }
    sums.put(facts);
    return facts;
  }

  template <class Answer, class Counter>
  void trace(const ScaledRay& ray, Answer& answer, Counter& counter) const {
    // The answer tests each sphere, so that it is counted.
    struct Tests {
      const ReferenceBih& self;
      const ScaledRay& ray;
      Answer& answer;
      Counter& counter;

      bool test(std::int64_t id) const { return self.test(ray, id, answer, counter); }
      double limit() const { return answer.limit(); }
    };
    Tests tests{*this, ray, answer, counter};
    Observer<Counter> observer{counter};
    counter.box_test();
    walk(tree_, spheres(), ray, tests, observer);
  }

  template <class Counter>
  void search(Vec3d point, NearestSphere& nearest, Counter& counter) const {
    // Planes bound boxes that are rounded to nearest (docs/precision.md, "Padding").
    const double pad = rounding_pad(point) + 0x1p-24;
    struct Waiting {
      std::int64_t node;
      Aabb box;
      double least;
    };
    std::vector<Waiting> waiting;
    waiting.reserve(64);
    counter.box_test();
    waiting.push_back({0, tree_.aabb, least_distance(point, tree_.aabb, pad)});
    while (!waiting.empty()) {
      const Waiting at = waiting.back();
      waiting.pop_back();
      if (at.least > nearest.limit()) continue;
      const Node& node = tree_.nodes[static_cast<std::size_t>(at.node)];
      counter.node(node.is_leaf());
      if (node.is_leaf()) {
        for (std::int64_t i = node.first_sphere(); i < node.first_sphere() + node.sphere_count; ++i)
          test(point, tree_.sphere_ids[static_cast<std::size_t>(i)], nearest, counter);
        continue;
      }
      const ChildBoxes boxes = child_boxes(node, at.box);
      const auto wait = [&](std::int64_t child, const Aabb& box) {
        counter.box_test();
        if (!box.empty()) waiting.push_back({child, box, least_distance(point, box, pad)});
      };
      wait(node.first, boxes.first);
      if (node.kind != NodeKind::split) continue;
      wait(node.right_child(), boxes.second);
      // The nearer child comes last, and so is taken first.
      const std::size_t last = waiting.size() - 1;
      if (last > 0 && waiting[last].node == node.right_child() && waiting[last - 1].node == node.first &&
          waiting[last].least > waiting[last - 1].least)
        std::swap(waiting[last], waiting[last - 1]);
    }
  }

 private:
  Tree own_;
  const Tree& tree_;
};

}  // namespace

StructurePath path_of_ray(const SphereSet& spheres, const Tree& tree, const Ray& ray) {
  const ReferenceBih bih(spheres, tree);
  return {"bih", bih.path_of_ray(ray, /*any_hit=*/false), bih.work_of_ray(ray, false)};
}

Result<StructurePointer> build_bih(const SphereSet& spheres, const StructureParameters& parameters, int) {
  BuildParameters chosen;
  if (parameters.max_prims > 0) chosen.max_prims = parameters.max_prims;
  if (parameters.max_depth > 0) chosen.max_depth = parameters.max_depth;
  return build_or_error(spheres, "bih",
                        [&]() -> StructurePointer { return std::make_unique<ReferenceBih>(spheres, chosen); });
}

}  // namespace bihive::workbench
