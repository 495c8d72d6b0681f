#include "least_work.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>
#include <vector>

#include "bihive/base/timer.h"
#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/wide/queries.h"

namespace bihive::bench {
namespace {

constexpr std::int64_t kSample = 4096;  // rays of a set that are counted

// Vector instructions that the two ports must take, as the kernels have them: six multiply-adds, six minima and maxima
// and a comparison for boxes; fifteen for the first test of spheres.
constexpr double kBoxOperations = 13, kSphereOperations = 15;
// Per candidate of the second test, sixteen at a time: a square root of 19 cycles, 14 instructions.
constexpr double kCandidateCycles = (19 + 14 / 2.0) / 16;
// Per ray, eight at a time in binary64: a square root and a division to normalise (31 and 16 cycles), three divisions
// in binary32 for the boxes (sixteen at a time, 10 cycles), 60 instructions.
constexpr double kSetUpCycles = (31 + 16 + 60 / 2.0) / 8 + 3 * 10 / 16.0;
// Per decision, eight at a time: two divisions, a square root, 40 instructions.
constexpr double kDecisionCycles = (2 * 16 + 31 + 40 / 2.0) / 8;

// A ray in binary64 against boxes and spheres of the tree.
class CountedRay {
 public:
  CountedRay(const WideTree& tree, const Ray& ray) : tree_(tree), ray_(ray, tree.scale) {}

  // Returns the t at which the segment enters the box of a child, or +inf.
  double entry(const WideNode& node, int slot, double t_end) const {
    double t_in = ray_.t_min, t_out = t_end;
    for (int axis = 0; axis < 3; ++axis) {
      const double direction = ray_.direction[axis], origin = ray_.origin[axis];
      const double lo = double(node.lo[axis][slot]) - origin, hi = double(node.hi[axis][slot]) - origin;
      if (direction == 0) {
        if (lo > 0 || hi < 0) return std::numeric_limits<double>::infinity();
        continue;
      }
      t_in = std::max(t_in, std::min(lo / direction, hi / direction));
      t_out = std::min(t_out, std::max(lo / direction, hi / direction));
    }
    return t_in <= t_out ? t_in : std::numeric_limits<double>::infinity();
  }

  // The nearest hit in a leaf before t_end, or t_end. Adds its candidates.
  double nearest(std::int64_t first, std::int64_t count, std::int64_t left, double t_end, double& candidates) const {
    for (std::int64_t slot = first; slot < first + count; ++slot) {
      const Vec3d to_centre = tree_.centre(slot) - ray_.origin;
      const double radius = tree_.spheres.radius(slot);
      const double t = dot(to_centre, ray_.direction) / ray_.direction_squared;
      const Vec3d apart = to_centre - t * ray_.direction;
      if (dot(apart, apart) > radius * radius) continue;
      candidates += 1;
      ScaledRay own = ray_;
      own.left_centre = tree_.centre(slot);
      own.left_radius = tree_.spheres.id(slot) == left ? radius : -1;
      t_end = std::min(t_end, sphere_hit(own, tree_.centre(slot), radius));
    }
    return t_end;
  }

  double t_max() const { return ray_.t_max; }

 private:
  const WideTree& tree_;
  ScaledRay ray_;
};

struct Child {
  std::int64_t node;
  int slot;
  double t_in;
};

class Counter {
 public:
  Counter(const WideTree& tree, LeastWork& sums) : tree_(tree), sums_(sums) {}

  void count(const Ray& world, bool any_hit) {
    const CountedRay ray(tree_, world);
    const Hit hit = any_hit ? Hit{} : closest_hit(tree_, world);
    if (any_hit && occluded(tree_, world)) {
      count_shortest_path(world, ray);
    } else {
      count_all(ray, hit.found() ? hit.t : ray.t_max());
    }
    count_in_order(world, ray, any_hit);
    if (hit.found()) sums_.decisions += 1;
  }

  double bytes() const { return double(nodes_.size() * sizeof(WideNode)) + double(lines_.size() * 64); }

 private:
  // Everything that begins before the answer.
  void count_all(const CountedRay& ray, double t_end) {
    std::vector<std::int64_t> waiting{0};
    while (!waiting.empty()) {
      const std::int64_t at = waiting.back();
      waiting.pop_back();
      visit_node(at, sums_.nodes);
      const WideNode& node = tree_.nodes[at];
      for (int slot = 0; slot < node.child_count; ++slot) {
        if (ray.entry(node, slot, t_end) == std::numeric_limits<double>::infinity()) continue;
        if (!node.is_leaf(slot))
          waiting.push_back(node.child_node(slot));
        else
          visit_leaf(node, slot, sums_.leaves);
      }
    }
  }

  // The leaf with an occluder that lies highest in the tree.
  void count_shortest_path(const Ray& world, const CountedRay& ray) {
    std::vector<Child> level{{0, -1, 0}}, next;
    for (double depth = 1; !level.empty(); ++depth, std::swap(level, next)) {
      next.clear();
      for (const Child& child : level) {
        const WideNode& node = tree_.nodes[child.node];
        for (int slot = 0; slot < node.child_count; ++slot) {
          if (ray.entry(node, slot, ray.t_max()) == std::numeric_limits<double>::infinity()) continue;
          if (!node.is_leaf(slot)) {
            next.push_back({node.child_node(slot), -1, 0});
            continue;
          }
          double candidates = 0;
          const double end = std::numeric_limits<double>::infinity();
          if (!(ray.nearest(node.sphere_begin(slot), node.sphere_count(slot), world.leaves, end, candidates) < end))
            continue;
          sums_.nodes += depth;
          visit_leaf(node, slot, sums_.leaves);
          return;
        }
      }
    }
  }

  void count_in_order(const Ray& world, const CountedRay& ray, bool any_hit) {
    double t_end = ray.t_max();
    std::vector<Child> waiting{{0, -1, 0}};
    while (!waiting.empty()) {
      const Child child = waiting.back();
      waiting.pop_back();
      if (child.t_in > t_end) continue;
      const WideNode& node = tree_.nodes[child.node];
      if (child.slot >= 0) {
        sums_.leaves_in_order += leaf_vectors(node, child.slot);
        const double before = std::numeric_limits<double>::infinity();
        const double t = ray.nearest(node.sphere_begin(child.slot), node.sphere_count(child.slot), world.leaves, before,
                                     sums_.candidates);
        if (any_hit && t < before) return;
        t_end = std::min(t_end, t);
        continue;
      }
      sums_.nodes_in_order += 1;
      const std::size_t from = waiting.size();
      for (int slot = 0; slot < node.child_count; ++slot) {
        const double t_in = ray.entry(node, slot, t_end);
        if (t_in == std::numeric_limits<double>::infinity()) continue;
        waiting.push_back(node.is_leaf(slot) ? Child{child.node, slot, t_in} : Child{node.child_node(slot), -1, t_in});
      }
      std::sort(waiting.begin() + static_cast<std::ptrdiff_t>(from), waiting.end(),
                [](const Child& a, const Child& b) { return a.t_in > b.t_in; });
    }
  }

  static double leaf_vectors(const WideNode& node, int slot) {
    return double((node.sphere_count(slot) + kWidth - 1) / kWidth);
  }

  void visit_node(std::int64_t at, double& count) {
    count += 1;
    nodes_.insert(at);
  }

  void visit_leaf(const WideNode& node, int slot, double& count) {
    count += leaf_vectors(node, slot);
    // Four or five arrays, line by line.
    const std::int64_t first = node.sphere_begin(slot), last = first + node.sphere_count(slot) - 1;
    for (std::int64_t line = first / 16; line <= last / 16; ++line)
      for (std::int64_t array = 0; array < (tree_.spheres.r == nullptr ? 4 : 5); ++array)
        lines_.insert(line * 8 + array);
  }

  const WideTree& tree_;
  LeastWork& sums_;
  std::unordered_set<std::int64_t> nodes_, lines_;
};

}  // namespace

double LeastWork::cycles(int lanes) const {
  const double vectors = 16.0 / lanes;
  return vectors * (kSetUpCycles + nodes * kBoxOperations / 2 + leaves * kSphereOperations / 2 +
                    std::min(candidates, 1.0) * kCandidateCycles + decisions * kDecisionCycles);
}

LeastWork least_work(const WideTree& tree, const RaySet& set) {
  LeastWork sums;
  const RaySpan rays = set.rays.span();
  if (tree.node_count == 0 || rays.count == 0) return sums;
  Counter counter(tree, sums);
  const std::int64_t counted = std::min(kSample, rays.count);
  for (std::int64_t k = 0; k < counted; ++k) counter.count(rays.at(k * rays.count / counted), set.facts.any_hit);
  const auto n = static_cast<double>(counted);
  const double of_a_ray =
      24.0 + (rays.t_max != nullptr ? 8 : 0) + (rays.leaves != nullptr ? 8 : 0) + (set.facts.any_hit ? 1 : 16);
  return {sums.nodes / n,      sums.leaves / n,    sums.nodes_in_order / n,       sums.leaves_in_order / n,
          sums.candidates / n, sums.decisions / n, of_a_ray + counter.bytes() / n};
}

double clock_rate() {
  double best = 0;
  for (int turn = 0; turn < 5; ++turn) {
    constexpr std::int64_t kProducts = 1 << 21;
    std::uint64_t sum = 3;
    const Timer timer;
    for (std::int64_t i = 0; i < kProducts; i += 8)
      for (int k = 0; k < 8; ++k) {
        sum *= sum;
        asm volatile("" : "+r"(sum));
      }
    best = std::max(best, 3 * double(kProducts) / timer.elapsed_ms() * 1000);
  }
  return best;
}

}  // namespace bihive::bench
