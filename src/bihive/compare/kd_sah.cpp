// kd-sah: a k-d tree by the surface area heuristic: planes divide space without overlap, and a sphere is listed in
// every leaf that it reaches into [Wald2006].
//
// A sphere is clipped to the cell of each node on its way down, so that a plane counts it on the sides where it is. No
// list remembers the spheres that a ray has met: a second test gives the same bits.

#include <algorithm>
#include <bit>
#include <deque>
#include <numeric>

#include "bihive/compare/boxes.h"
#include "bihive/compare/by_ray.h"
#include "bihive/compare/level_sums.h"
#include "bihive/compare/nearest_first.h"
#include "bihive/compare/sphere_limit.h"

namespace bihive::workbench {
namespace {

constexpr std::int64_t kPlanes = 31;  // compared along each axis, beside the two ends of the spheres
constexpr std::int64_t kMostKdLevels = 64;
constexpr double kEntryCost = 1, kTestCost = 1;
// Planes that cut spheres stop dividing where all lists together would have more entries than this, per sphere.
constexpr std::int64_t kMostKdEntries = 12;

// A leaf lists `count` spheres from entry `first` on; an inner node has the children `first` (below the plane) and
// `first` + 1.
struct KdNode {
  float plane = 0;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  int axis = 3;  // 3: a leaf

  bool is_leaf() const { return axis == 3; }
};

struct KdPlane {
  double cost = std::numeric_limits<double>::infinity();
  int axis = 0;
  float position = 0;
  bool pays = false;
};

class KdSah final : public ByRay<KdSah> {
 public:
  KdSah(const SphereSet& spheres, const StructureParameters& parameters) : ByRay(spheres) {
    if (spheres.empty()) return;
    max_prims_ = std::max<std::int64_t>(1, parameters.max_prims);
    planes_ = parameters.candidates > 0 ? parameters.candidates : kPlanes;
    // The usual bound of levels [Wald2006], unless there is a parameter.
    const std::int64_t usual = 9 + 13 * std::int64_t(std::bit_width(std::uint64_t(spheres.size()))) / 10;
    levels_ = std::min<std::int64_t>(kMostKdLevels, parameters.max_depth > 0 ? parameters.max_depth : usual);
    for (std::int64_t id = 0; id < spheres.size(); ++id) box_.add(outward_box(spheres, id));
    build();
  }

  StructureFacts facts() const override {
    StructureFacts facts;
    facts.bytes = static_cast<std::int64_t>(sizeof(KdSah) + nodes_.capacity() * sizeof(KdNode) +
                                            ids_.capacity() * sizeof(std::uint32_t));
    facts.nodes = static_cast<std::int64_t>(nodes_.size());
    if (nodes_.empty()) return facts;
    struct Part {
      std::uint32_t node;
      Aabb cell;
      std::int64_t level;
    };
    LevelSums sums(box_);
    std::vector<Part> pending{{0, box_, 1}};
    while (!pending.empty()) {
      const Part at = pending.back();
      pending.pop_back();
      const KdNode& node = nodes_[at.node];
      sums.add(at.level, at.cell, node.is_leaf(), node.count);
      if (node.is_leaf()) continue;
      const std::array cells{part_below(at.cell, node.axis, node.plane), part_above(at.cell, node.axis, node.plane)};
      sums.add_children(at.level, at.cell, cells);
      pending.push_back({node.first, cells[0], at.level + 1});
      pending.push_back({node.first + 1, cells[1], at.level + 1});
    }
    sums.put(facts);
    return facts;
  }

  template <class Answer, class Counter>
  void trace(const ScaledRay& ray, Answer& answer, Counter& counter) const {
    struct Part {
      std::uint32_t node;
      Interval inside;
    };
    const Slabs slabs(ray);
    const auto open = [&](const Part& at, const auto& wait) {
      const KdNode& node = nodes_[at.node];
      counter.node(node.is_leaf());
      if (node.is_leaf()) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
          if (test(ray, std::int64_t{ids_[i]}, answer, counter)) return true;
        return false;
      }
      // Each child has a part of the ray's interval; the parts overlap by the padding of the plane.
      const Interval below = slabs.below(at.inside, node.axis, double(node.plane));
      const Interval above = slabs.above(at.inside, node.axis, double(node.plane));
      const bool below_first = ray.direction[node.axis] >= 0;
      const Interval near_part = below_first ? below : above, far_part = below_first ? above : below;
      if (!near_part.empty()) wait(Part{node.first + (below_first ? 0 : 1), near_part}, near_part.t_near);
      if (!far_part.empty()) wait(Part{node.first + (below_first ? 1 : 0), far_part}, far_part.t_near);
      return false;
    };
    counter.box_test();
    const Interval inside = RayAndBoxes(ray).inside(box_);
    if (!inside.empty())
      nearest_first<kMostKdLevels + 1>(Part{0, inside}, inside.t_near, open, [&] { return answer.limit(); });
  }

  template <class Counter>
  void search(Vec3d point, NearestSphere& nearest, Counter& counter) const {
    struct Part {
      std::uint32_t node;
      Aabb cell;
    };
    const double pad = rounding_pad(point);
    const auto open = [&](const Part& at, const auto& wait) {
      const KdNode& node = nodes_[at.node];
      counter.node(node.is_leaf());
      if (node.is_leaf()) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
          test(point, std::int64_t{ids_[i]}, nearest, counter);
        return false;
      }
      const auto wait_for = [&](std::uint32_t child, const Aabb& cell) {
        counter.box_test();
        wait(Part{child, cell}, least_distance_to_cell(point, cell, pad));
      };
      wait_for(node.first, part_below(at.cell, node.axis, node.plane));
      wait_for(node.first + 1, part_above(at.cell, node.axis, node.plane));
      return false;
    };
    counter.box_test();
    nearest_first<kMostKdLevels + 1>(Part{0, box_}, least_distance_to_cell(point, box_, pad), open,
                                     [&] { return nearest.limit(); });
  }

 private:
  std::int64_t max_prims_ = 1, planes_ = kPlanes, levels_ = 0;
  Aabb box_;
  std::vector<KdNode> nodes_;
  std::vector<std::uint32_t> ids_;

  struct Range {
    std::uint32_t node;
    std::int64_t level;
    Aabb cell;
    std::vector<std::uint32_t> ids;
  };

  // Level after level, so that the entries that remain go to all parts alike.
  void build() {
    std::int64_t entries = spheres().size();
    std::deque<Range> pending{{0, 1, box_, {}}};
    pending.back().ids.resize(static_cast<std::size_t>(entries));
    std::iota(pending.back().ids.begin(), pending.back().ids.end(), 0U);
    nodes_.emplace_back();
    for (; !pending.empty(); pending.pop_front()) {
      const Range& range = pending.front();
      Range below{0, range.level + 1, {}, {}}, above = below;
      const KdPlane plane = divide(range, below, above);
      const std::int64_t more = std::ssize(below.ids) + std::ssize(above.ids) - std::ssize(range.ids);
      if (!plane.pays || entries + more > kMostKdEntries * spheres().size() + 64) {
        nodes_[range.node].first = static_cast<std::uint32_t>(ids_.size());
        nodes_[range.node].count = static_cast<std::uint32_t>(range.ids.size());
        ids_.insert(ids_.end(), range.ids.begin(), range.ids.end());
        continue;
      }
      entries += more;
      below.node = static_cast<std::uint32_t>(nodes_.size());
      above.node = below.node + 1;
      nodes_[range.node] = {plane.position, below.node, 0, plane.axis};
      nodes_.resize(nodes_.size() + 2);
      pending.push_back(std::move(below));
      pending.push_back(std::move(above));
    }
    nodes_.shrink_to_fit();
    ids_.shrink_to_fit();
  }

  // Lists the spheres on both sides of the best plane, if it pays.
  KdPlane divide(const Range& range, Range& below, Range& above) const {
    if (std::ssize(range.ids) <= max_prims_ || range.level >= levels_) return {};
    std::vector<Aabb> parts;  // of the spheres, within the cell
    for (const std::uint32_t id : range.ids) parts.push_back(clipped_box(spheres(), id, range.cell));
    KdPlane best = best_plane(range.cell, parts);
    const double surface = half_surface(range.cell);
    best.pays = surface * kEntryCost + best.cost < surface * double(parts.size()) * kTestCost;
    if (!best.pays) return best;
    below.cell = part_below(range.cell, best.axis, best.position);
    above.cell = part_above(range.cell, best.axis, best.position);
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (parts[i].lo[best.axis] < best.position) below.ids.push_back(range.ids[i]);
      if (parts[i].hi[best.axis] > best.position) above.ids.push_back(range.ids[i]);
    }
    return best;
  }

  // Compares planes at equal distances across the cell, and those that cut off empty space at the spheres' ends.
  KdPlane best_plane(const Aabb& cell, const std::vector<Aabb>& parts) const {
    Aabb all;
    for (const Aabb& part : parts) all.add(part);
    KdPlane best;
    std::vector<float> planes;
    std::vector<std::int64_t> begins, ends;  // parts that begin, or end, between a plane and the one before
    for (int axis = 0; axis < 3; ++axis) {
      const double lo = cell.lo[axis], size = double(cell.hi[axis]) - lo;
      planes = {all.lo[axis], all.hi[axis]};
      for (std::int64_t k = 1; k <= planes_; ++k)
        planes.push_back(static_cast<float>(lo + size * double(k) / double(planes_ + 1)));
      std::sort(planes.begin(), planes.end());
      begins.assign(planes.size() + 1, 0);
      ends.assign(planes.size() + 1, 0);
      for (const Aabb& part : parts) {
        ++begins[static_cast<std::size_t>(std::upper_bound(planes.begin(), planes.end(), part.lo[axis]) -
                                          planes.begin())];
        ++ends[static_cast<std::size_t>(std::lower_bound(planes.begin(), planes.end(), part.hi[axis]) -
                                        planes.begin())];
      }
      std::int64_t below = 0, above = std::ssize(parts);
      for (std::size_t k = 0; k < planes.size(); ++k) {
        below += begins[k];
        above -= ends[k];
        if (!(planes[k] > cell.lo[axis] && planes[k] < cell.hi[axis])) continue;
        const double cost = kTestCost * (half_surface(part_below(cell, axis, planes[k])) * double(below) +
                                         half_surface(part_above(cell, axis, planes[k])) * double(above));
        if (cost < best.cost) best = {cost, axis, planes[k], false};
      }
    }
    return best;
  }
};

}  // namespace

Result<StructurePointer> build_kd_sah(const SphereSet& spheres, const StructureParameters& parameters, int) {
  return build_or_error(
      spheres, "kd-sah", [&]() -> StructurePointer { return std::make_unique<KdSah>(spheres, parameters); },
      kMostKdEntries);
}

}  // namespace bihive::workbench
