// wide: the wide BIH, sixteen children per node, answered by vectors (wide/queries.h).

#include <algorithm>

#include "bihive/compare/boxes.h"
#include "bihive/compare/by_ray.h"
#include "bihive/compare/level_sums.h"
#include "bihive/compare/nearest_first.h"
#include "bihive/compare/ray_path.h"
#include "bihive/wide/point_queries.h"
#include "bihive/wide/wide_builder.h"

namespace bihive::workbench {
namespace {

Aabb box_of_child(const WideNode& node, int slot) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) box.lo[axis] = node.lo[axis][slot], box.hi[axis] = node.hi[axis][slot];
  return box;
}

// The work of one query at a time in the same tree, in the steps of its vectors: one for the boxes of a node, one for
// the spheres of a leaf. Its spheres are those of the tree: of equal ones in one place, the tree may have only the
// first.
class WideWork final : public ByRay<WideWork> {
 public:
  static constexpr std::int64_t kTestedTogether = kWidth;

  WideWork(const SphereSet& spheres, const WideTree& tree) : ByRay(spheres), tree_(tree) {}
  StructureFacts facts() const override { return {}; }

  template <class Answer, class Counter>
  void trace(const ScaledRay& ray, Answer& answer, Counter& counter) const {
    const RayAndBoxes boxes(ray);
    const auto entry = [&](const Aabb& box) { return boxes.entry(box); };
    traverse(
        entry, [&] { return answer.limit(); }, [&](std::int64_t id) { return test(ray, id, answer, counter); },
        counter);
  }
  template <class Counter>
  void search(Vec3d point, NearestSphere& nearest, Counter& counter) const {
    const double pad = rounding_pad(point);
    traverse([&](const Aabb& box) { return least_distance(point, box, pad); }, [&] { return nearest.limit(); },
             [&](std::int64_t id) {
               test(point, id, nearest, counter);
               return false;
             },
             counter);
  }

 private:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  const WideTree& tree_;

  template <class Entry, class Limit, class Visit, class Counter>
  void traverse(const Entry& entry, const Limit& limit, const Visit& visit, Counter& counter) const {
    struct Child {
      const WideNode* node;  // null: a leaf
      std::int64_t begin, count;
    };
    if (tree_.node_count == 0) return;
    counter.box_test();
    const auto open = [&](const Child& at, const auto& wait) {
      counter.node(at.node == nullptr);
      if (at.node == nullptr) {
        for (std::int64_t slot = at.begin; slot < at.begin + at.count; ++slot)
          if (visit(tree_.spheres.id(slot))) return true;
        return false;
      }
      for (int slot = 0; slot < at.node->child_count; ++slot) {
        const Aabb box = box_of_child(*at.node, slot);
        counter.box_test();
        if (at.node->is_leaf(slot))
          wait(Child{nullptr, at.node->sphere_begin(slot), at.node->sphere_count(slot)}, entry(box));
        else
          wait(Child{tree_.nodes + at.node->child_node(slot), 0, 0}, entry(box));
      }
      return false;
    };
    constexpr std::size_t kMostWaiting = (kWidth - 1) * (kMostLevels + 1) + 1;
    nearest_first<kMostWaiting>(Child{tree_.nodes, 0, 0}, entry(tree_.aabb), open, limit);
  }
};

class WideBih final : public Structure {
 public:
  WideBih(const SphereSet& spheres, std::shared_ptr<const WideTree> tree)
      : tree_(std::move(tree)), work_(spheres, *tree_) {}

  StructureFacts facts() const override {
    StructureFacts facts;
    facts.bytes = tree_->used_bytes();
    if (tree_->node_count == 0) return facts;
    LevelSums sums(tree_->aabb);
    struct Part {
      const WideNode* node;
      Aabb box;
      std::int64_t level;
    };
    std::vector<Part> pending{{tree_->nodes, tree_->aabb, 1}};
    std::vector<Aabb> boxes;
    while (!pending.empty()) {
      const Part at = pending.back();
      pending.pop_back();
      ++facts.nodes;
      sums.add(at.level, at.box, false, 0, 0);
      boxes.clear();
      for (int slot = 0; slot < at.node->child_count; ++slot) {
        boxes.push_back(box_of_child(*at.node, slot));
        if (!at.node->is_leaf(slot)) {
          pending.push_back({tree_->nodes + at.node->child_node(slot), boxes.back(), at.level + 1});
          continue;
        }
        ++facts.nodes;
        const std::int64_t spheres = at.node->sphere_count(slot);
        sums.add(at.level + 1, boxes.back(), true, spheres, (spheres + kWidth - 1) / kWidth);
      }
      sums.add_children(at.level, at.box, boxes);
    }
    sums.put(facts);
    return facts;
  }

  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const override {
    bihive::closest_hits(*tree_, rays, order, hits);
  }
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const override {
    bihive::occluded(*tree_, rays, order, is_occluded);
  }
  void nearest_spheres(const double* points, std::int64_t count, const HitSpan& found) const override {
    PointOptions options;
    options.threads = 1;
    // Bad points and a lack of memory are left: the points are finite, and the answers small.
    const auto nearest = bihive::nearest_spheres(*tree_, PointSpan::rows(points, count), 1,
                                                 std::numeric_limits<double>::infinity(), options);
    if (!nearest) throw std::bad_alloc();
    std::copy(nearest->distance.begin(), nearest->distance.end(), found.t);
    std::copy(nearest->sphere_id.begin(), nearest->sphere_id.end(), found.sphere_id);
  }

  Work work_of_ray(const Ray& ray, bool any_hit) const override { return work_.work_of_ray(ray, any_hit); }
  Work work_of_point(Vec3d point) const override { return work_.work_of_point(point); }
  RayPath path_of_ray(const Ray& ray, bool any_hit) const override { return work_.path_of_ray(ray, any_hit); }
  // The more the better: it sorts scattered rays.
  std::int64_t rays_per_call() const override { return 1 << 18; }

 private:
  std::shared_ptr<const WideTree> tree_;
  WideWork work_;
};

}  // namespace

StructurePath path_of_ray(const SphereSet& spheres, const WideTree& tree, const Ray& ray) {
  const WideWork work(spheres, tree);
  return {"wide", work.path_of_ray(ray, /*any_hit=*/false), work.work_of_ray(ray, false)};
}

Result<StructurePointer> build_wide(const SphereSet& spheres, const StructureParameters& parameters, int threads) {
  WideBuilder builder;
  Result<std::shared_ptr<const WideTree>> tree =
      builder.build(spheres, {parameters.max_prims, parameters.max_depth}, threads);
  if (!tree) return tree.error();
  return StructurePointer(std::make_unique<WideBih>(spheres, std::move(*tree)));
}

}  // namespace bihive::workbench
