#include "bihive/compare/box_queries.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "bihive/base/readable.h"
#include "bihive/base/timer.h"
#include "bihive/bih/child_boxes.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/bih/traversal.h"
#include "bihive/compare/boxes.h"
#include "bihive/compare/by_ray.h"
#include "bihive/compare/sah_builder.h"
#include "bihive/math/rng.h"

namespace bihive::workbench {
namespace {

constexpr double kEndless = std::numeric_limits<double>::infinity();

// The boxes, and copies for the trees: scaled by a power of two into [-1, 1], and rounded outward.
class BoxItems {
 public:
  explicit BoxItems(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
    double farthest = 0;
    for (const Box& box : boxes_)
      for (int axis = 0; axis < 3; ++axis)
        farthest = std::max({farthest, std::abs(box.lo[axis]), std::abs(box.hi[axis])});
    int exponent = 0;
    std::frexp(farthest, &exponent);
    scale_ = std::ldexp(1.0, -exponent);
    for (const Box& box : boxes_) {
      outward_.emplace_back();
      for (int axis = 0; axis < 3; ++axis) {
        outward_.back().lo[axis] = rounded_down(box.lo[axis] * scale_);
        outward_.back().hi[axis] = rounded_up(box.hi[axis] * scale_);
      }
    }
  }

  std::int64_t count() const { return std::ssize(boxes_); }
  Aabb box(std::uint32_t id) const { return outward_[id]; }
  Vec3d centre(std::uint32_t id) const { return (to_double(outward_[id].lo) + to_double(outward_[id].hi)) * 0.5; }

  const std::vector<Box>& boxes() const { return boxes_; }
  const std::vector<Aabb>& outward() const { return outward_; }
  double scale() const { return scale_; }
  ScaledRay scaled(const Ray& ray) const { return ScaledRay(ray, scale_); }

 private:
  std::vector<Box> boxes_;
  std::vector<Aabb> outward_;
  double scale_ = 1;
};

// Whether a point in stored units may lie in a box that is rounded outward.
bool may_contain(const Aabb& box, Vec3d point) {
  for (int axis = 0; axis < 3; ++axis)
    if (point[axis] < double(box.lo[axis]) || point[axis] > double(box.hi[axis])) return false;
  return true;
}

// Tests the boxes of leaves against a ray or a point, and keeps those that pass.
template <class Query>
struct AllBoxes {
  const BoxItems& items;
  const Query& query;
  std::vector<std::int64_t>& found;
  Count& counter;

  bool test(std::int64_t id) const {
    counter.sphere_test(id);
    const Box& box = items.boxes()[static_cast<std::size_t>(id)];
    bool passes = false;
    if constexpr (std::is_same_v<Query, Ray>)
      passes = meets(box, query);
    else
      passes = contains(box, query);
    if (passes) found.push_back(id);
    return false;
  }
  double limit() const { return kEndless; }
};

// The queries of a structure that has take(query, answer): it passes each box that the query may meet to answer.test().
template <class Self>
class BoxesByQuery : public BoxStructure {
 public:
  explicit BoxesByQuery(const std::vector<Box>& boxes) : items_(boxes) {}

  void boxes_of_ray(const Ray& ray, std::vector<std::int64_t>& found, Work& work) const override {
    answer(ray, found, work);
  }
  void boxes_of_point(Vec3d point, std::vector<std::int64_t>& found, Work& work) const override {
    answer(point, found, work);
  }

 protected:
  const BoxItems& items() const { return items_; }

 private:
  BoxItems items_;

  template <class Query>
  void answer(const Query& query, std::vector<std::int64_t>& found, Work& work) const {
    found.clear();
    Count counter{work};
    static_cast<const Self&>(*this).take(query, AllBoxes<Query>{items_, query, found, counter});
    work = counter.work;
    std::sort(found.begin(), found.end());
  }
};

class BruteBoxes final : public BoxesByQuery<BruteBoxes> {
 public:
  using BoxesByQuery::BoxesByQuery;
  StructureFacts facts() const override { return {}; }

  template <class Query>
  void take(const Query&, AllBoxes<Query> answer) const {
    for (std::int64_t id = 0; id < items().count(); ++id) answer.test(id);
  }
};

class SahBoxes final : public BoxesByQuery<SahBoxes> {
 public:
  explicit SahBoxes(const std::vector<Box>& boxes)
      : BoxesByQuery(boxes), tree_(SahBuilder<BoxItems>(items(), {}).build()) {}
  StructureFacts facts() const override { return facts_of(tree_); }

  void take(const Ray& ray, AllBoxes<Ray> answer) const {
    const ScaledRay scaled = items().scaled(ray);
    const RayAndBoxes boxes(scaled);
    const auto entry = [&](const Aabb& box) {
      const Interval part = boxes.inside(box);
      return part.empty() ? kEndless : part.t_near;
    };
    traverse(
        tree_, entry, [] { return kEndless; }, [&](std::int64_t id) { return answer.test(id); }, answer.counter);
  }
  void take(Vec3d point, AllBoxes<Vec3d> answer) const {
    const Vec3d stored = point * items().scale();
    traverse(
        tree_, [&](const Aabb& box) { return may_contain(box, stored) ? 0 : kEndless; }, [] { return kEndless; },
        [&](std::int64_t id) { return answer.test(id); }, answer.counter);
  }

 private:
  BoxTree tree_;
};

class BihBoxes final : public BoxesByQuery<BihBoxes> {
 public:
  explicit BihBoxes(const std::vector<Box>& boxes)
      : BoxesByQuery(boxes), tree_(build_reference_tree(items().outward(), BuildParameters{})) {}

  StructureFacts facts() const override {
    const TreeStatistics statistics = tree_statistics(tree_);
    StructureFacts facts;
    facts.bytes = tree_.allocated_bytes();
    facts.nodes = static_cast<std::int64_t>(tree_.nodes.size());
    facts.leaves = statistics.leaves;
    facts.references = statistics.spheres;
    facts.depth = statistics.depth.max;
    return facts;
  }

  void take(const Ray& ray, AllBoxes<Ray> answer) const {
    struct Steps {
      Count& counter;
      void node_visit() { counter.node(false); }
      void leaf_visit() { counter.node(true); }
      void empty_gap() {}
      void sphere_test() {}  // the answer counts it
    };
    Steps steps{answer.counter};
    answer.counter.box_test();
    static const SphereSet none;  // the answer tests boxes
    walk(tree_, none, items().scaled(ray), answer, steps);
  }
  void take(Vec3d point, AllBoxes<Vec3d> answer) const {
    struct Part {
      std::int64_t node;
      Aabb box;
    };
    const Vec3d stored = point * items().scale();
    std::vector<Part> pending;
    const auto wait = [&](std::int64_t node, const Aabb& box) {
      answer.counter.box_test();
      if (may_contain(box, stored)) pending.push_back({node, box});
    };
    wait(0, tree_.aabb);
    while (!pending.empty()) {
      const Part at = pending.back();
      pending.pop_back();
      const Node& node = tree_.nodes[static_cast<std::size_t>(at.node)];
      answer.counter.node(node.is_leaf());
      if (node.is_leaf()) {
        for (std::int64_t i = node.first_sphere(); i < node.first_sphere() + node.sphere_count; ++i)
          answer.test(tree_.sphere_ids[static_cast<std::size_t>(i)]);
        continue;
      }
      const ChildBoxes boxes = child_boxes(node, at.box);
      wait(node.first, boxes.first);
      if (node.kind == NodeKind::split) wait(node.right_child(), boxes.second);
    }
  }

 private:
  Tree tree_;
};

template <class Made>
Result<std::unique_ptr<const BoxStructure>> build_boxes(const std::vector<Box>& boxes) {
  const std::int64_t count = std::ssize(boxes);
  if (count > std::int64_t{std::numeric_limits<std::uint32_t>::max()})
    return Error{grouped(count) + " boxes are too many: at most 4,294,967,295", "", 0, 0, ""};
  try {
    return std::unique_ptr<const BoxStructure>(std::make_unique<Made>(boxes));
  } catch (const std::bad_alloc&) {
    return Error{"not enough memory for " + grouped(count) + " boxes", "", 0, 0, ""};
  }
}

// Answers all queries, and compares them with those of brute force, or keeps them as such.
template <class Query, class Ask>
BoxKindResult answer_boxes(const std::vector<Query>& queries, const Ask& ask,
                           std::vector<std::vector<std::int64_t>>& truth) {
  BoxKindResult result;
  result.queries = std::ssize(queries);
  const auto count = static_cast<double>(queries.size());
  const bool is_truth = truth.empty();
  std::vector<std::int64_t> found;
  Work work;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    ask(queries[i], found, work);
    result.found += static_cast<double>(found.size()) / count;
    if (is_truth)
      truth.push_back(found);
    else
      result.different += found == truth[i] ? 0 : 1;
  }
  result.nodes = static_cast<double>(work.nodes) / count;
  result.box_tests = static_cast<double>(work.box_tests) / count;
  result.item_tests = static_cast<double>(work.sphere_tests) / count;
  const Timer timer;
  for (const Query& query : queries) ask(query, found, work);
  result.ms = timer.elapsed_ms();
  return result;
}

}  // namespace

bool contains(const Box& box, Vec3d point) {
  for (int axis = 0; axis < 3; ++axis)
    if (!(box.lo[axis] <= point[axis] && point[axis] <= box.hi[axis])) return false;
  return true;
}

bool meets(const Box& box, const Ray& ray) {
  Interval part{ray.t_min, ray.t_max};
  for (int axis = 0; axis < 3; ++axis) {
    const double origin = double(ray.origin[axis]), direction = double(ray.direction[axis]);
    if (direction == 0) {
      if (!(box.lo[axis] <= origin && origin <= box.hi[axis])) return false;
      continue;
    }
    const double below = (box.lo[axis] - origin) / direction, above = (box.hi[axis] - origin) / direction;
    part.t_near = std::max(part.t_near, std::min(below, above));
    part.t_far = std::min(part.t_far, std::max(below, above));
  }
  return !part.empty();
}

const std::vector<BoxStructureRow>& box_structures() {
  static const std::vector<BoxStructureRow> rows{
      {"bih", "reference BIH of the thesis", build_boxes<BihBoxes>},
      {"bvh-sah", "BVH by the surface area heuristic", build_boxes<SahBoxes>},
      {"brute", "every box, one after the other", build_boxes<BruteBoxes>},
  };
  return rows;
}

Result<std::vector<BoxStructureResult>> compare_box_structures(const std::vector<Box>& boxes, std::int64_t count) {
  constexpr std::int64_t kMostTests = 1 << 28;
  const std::int64_t queries = std::clamp<std::int64_t>(kMostTests / std::ssize(boxes), 1, count);
  Box bounds = boxes.front();
  for (const Box& box : boxes)
    for (int axis = 0; axis < 3; ++axis) {
      bounds.lo[axis] = std::min(bounds.lo[axis], box.lo[axis]);
      bounds.hi[axis] = std::max(bounds.hi[axis], box.hi[axis]);
    }
  SplitMix64 random(11);
  const auto position = [&] {
    Vec3d point;
    for (int axis = 0; axis < 3; ++axis)
      point[axis] = bounds.lo[axis] + (bounds.hi[axis] - bounds.lo[axis]) * random.next_double();
    return point;
  };
  std::vector<Ray> rays;
  std::vector<Vec3d> points;
  for (std::int64_t i = 0; i < queries; ++i) {
    Ray ray;
    ray.origin = to_float(position());
    Vec3d direction;
    do {
      for (int axis = 0; axis < 3; ++axis) direction[axis] = 2 * random.next_double() - 1;
    } while (dot(direction, direction) > 1 || dot(direction, direction) < 1e-3);
    ray.direction = to_float(direction);
    rays.push_back(ray);
    points.push_back(position());
  }

  // Brute force goes first: it says what is right.
  std::vector<std::vector<std::int64_t>> truth_of_rays, truth_of_points;
  std::vector<BoxStructureResult> results;
  for (auto row = box_structures().rbegin(); row != box_structures().rend(); ++row) {
    BoxStructureResult result{*row, 0, {}, {}, {}};
    const Timer timer;
    const auto structure = row->build(boxes);
    if (!structure) return structure.error();
    result.build_ms = timer.elapsed_ms();
    result.facts = (*structure)->facts();
    const auto ray = [&](const Ray& one, auto& found, Work& work) { (*structure)->boxes_of_ray(one, found, work); };
    const auto point = [&](Vec3d one, auto& found, Work& work) { (*structure)->boxes_of_point(one, found, work); };
    result.rays = answer_boxes(rays, ray, truth_of_rays);
    result.points = answer_boxes(points, point, truth_of_points);
    results.push_back(result);
  }
  std::reverse(results.begin(), results.end());
  return results;
}

}  // namespace bihive::workbench
