// pkd: a balanced k-d tree of the spheres themselves, without nodes of its own [Wald2015]: the children of sphere k of
// the order are 2 k + 1 and 2 k + 2.
//
// A sphere's centre divides space across the axis along which the centres of its part spread most. Each part knows its
// largest radius, by which spheres may reach across.

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "bihive/compare/boxes.h"
#include "bihive/compare/by_ray.h"
#include "bihive/compare/level_sums.h"
#include "bihive/compare/sphere_limit.h"

namespace bihive::workbench {
namespace {

// Spheres of the left child in a tree whose last level is filled from the left.
std::size_t left_size(std::size_t count) {
  std::size_t full = 1;  // spheres of all levels but the last
  while (2 * full + 1 <= count) full = 2 * full + 1;
  const std::size_t last = count - full, half_of_last = (full + 1) / 2;
  return (full - 1) / 2 + std::min(last, half_of_last);
}

class Pkd final : public ByRay<Pkd> {
 public:
  explicit Pkd(const SphereSet& spheres) : ByRay(spheres) {
    const auto count = static_cast<std::size_t>(spheres.size());
    ids_.resize(count);
    axes_.resize(count);
    largest_.resize(count);
    std::vector<std::uint32_t> pool(count);
    std::iota(pool.begin(), pool.end(), 0U);
    for (std::int64_t id = 0; id < spheres.size(); ++id) box_.add(outward_box(spheres, id));
    place(pool);
    for (std::size_t k = count; k-- > 0;) {
      largest_[k] = spheres.r()[ids_[k]];
      for (const std::size_t child : {2 * k + 1, 2 * k + 2})
        if (child < count) largest_[k] = std::max(largest_[k], largest_[child]);
    }
  }

  StructureFacts facts() const override {
    StructureFacts facts;
    facts.bytes = static_cast<std::int64_t>(sizeof(Pkd) + ids_.capacity() * (2 * sizeof(std::uint32_t) + 1));
    facts.nodes = spheres().size();
    struct Part {
      std::size_t sphere;
      Aabb box;
      std::int64_t level;
    };
    LevelSums sums(box_);
    std::vector<Part> pending;
    if (!ids_.empty()) pending.push_back({0, box_, 1});
    while (!pending.empty()) {
      const auto [k, box, level] = pending.back();
      pending.pop_back();
      sums.add(level, box, is_leaf(k), 1);
      if (is_leaf(k)) continue;
      const int axis = axes_[k];
      const std::size_t left = 2 * k + 1, right = left + 1;
      std::array boxes{box, box};
      boxes[0].hi[axis] = std::min(box.hi[axis], static_cast<float>(left_end(k)));
      pending.push_back({left, boxes[0], level + 1});
      if (right < ids_.size()) {
        boxes[1].lo[axis] = std::max(box.lo[axis], static_cast<float>(right_begin(k)));
        pending.push_back({right, boxes[1], level + 1});
      }
      sums.add_children(level, box, std::span(boxes).first(right < ids_.size() ? 2 : 1));
    }
    sums.put(facts);
    return facts;
  }

  template <class Answer, class Counter>
  void trace(const ScaledRay& ray, Answer& answer, Counter& counter) const {
    const Slabs slabs(ray);
    counter.box_test();
    struct Waiting {
      std::size_t node;
      Interval part;
    };
    Waiting at{0, RayAndBoxes(ray).inside(box_)};
    if (at.part.empty()) return;
    std::array<Waiting, kMostLevelsOfPkd> waiting;
    std::size_t waiting_count = 0;
    for (;;) {
      const std::size_t k = at.node;
      counter.node(is_leaf(k));
      if (test(ray, std::int64_t{ids_[k]}, answer, counter)) return;

      // Go to the child on the ray's near side first.
      constexpr Interval kNone{std::numeric_limits<double>::infinity(), 0};
      const std::size_t left = 2 * k + 1, right = left + 1;
      const int axis = axes_[k];
      Waiting next{left, left < ids_.size() ? slabs.below(at.part, axis, left_end(k)) : kNone};
      Waiting far{right, right < ids_.size() ? slabs.above(at.part, axis, right_begin(k)) : kNone};
      if (ray.direction[axis] < 0) std::swap(next, far);
      if (!far.part.empty()) waiting[waiting_count++] = far;
      while (next.part.empty() || next.part.t_near > answer.limit()) {
        if (waiting_count == 0) return;
        next = waiting[--waiting_count];
      }
      at = next;
    }
  }

  template <class Counter>
  void search(Vec3d point, NearestSphere& nearest, Counter& counter) const {
    const double pad = rounding_pad(point);
    struct Waiting {
      std::size_t node;
      double least;  // distance of anything in it
    };
    std::array<Waiting, kMostLevelsOfPkd> waiting;
    std::size_t waiting_count = 0;
    Waiting at{0, -std::numeric_limits<double>::infinity()};
    for (;;) {
      const std::size_t k = at.node;
      counter.node(is_leaf(k));
      test(point, std::int64_t{ids_[k]}, nearest, counter);
      const std::size_t left = 2 * k + 1, right = left + 1;
      const double beyond = point[axes_[k]] - split(k);
      Waiting next{left, at.least}, far{right, at.least};
      if (left < ids_.size()) next.least = std::max(at.least, beyond - double(largest_[left]) - pad);
      if (right < ids_.size()) far.least = std::max(at.least, -beyond - double(largest_[right]) - pad);
      if (beyond > 0) std::swap(next, far);
      if (far.node < ids_.size()) waiting[waiting_count++] = far;
      while (next.node >= ids_.size() || next.least > nearest.limit()) {
        if (waiting_count == 0) return;
        next = waiting[--waiting_count];
      }
      at = next;
    }
  }

 private:
  static constexpr std::size_t kMostLevelsOfPkd = 33;
  Aabb box_;
  std::vector<std::uint32_t> ids_;
  std::vector<std::uint8_t> axes_;
  std::vector<float> largest_;  // radius of a sphere and all below it

  bool is_leaf(std::size_t k) const { return 2 * k + 1 >= ids_.size(); }
  double split(std::size_t k) const { return spheres().stored_centre(ids_[k])[axes_[k]]; }
  // How far the spheres of the children reach across.
  double left_end(std::size_t k) const { return split(k) + double(largest_[2 * k + 1]); }
  double right_begin(std::size_t k) const { return split(k) - double(largest_[2 * k + 2]); }

  // Puts the middle sphere of each range into its node, the others left and right of it.
  void place(std::vector<std::uint32_t>& pool) {
    struct Range {
      std::size_t node, begin, end;
    };
    std::vector<Range> pending;
    if (!pool.empty()) pending.push_back({0, 0, pool.size()});
    while (!pending.empty()) {
      const Range range = pending.back();
      pending.pop_back();
      const int axis = widest_axis(pool, range.begin, range.end);
      const std::size_t middle = range.begin + left_size(range.end - range.begin);
      const auto at = [&](std::size_t i) { return pool.begin() + static_cast<std::ptrdiff_t>(i); };
      std::nth_element(at(range.begin), at(middle), at(range.end), [&](std::uint32_t a, std::uint32_t b) {
        const double x = spheres().stored_centre(a)[axis], y = spheres().stored_centre(b)[axis];
        return x != y ? x < y : a < b;
      });
      ids_[range.node] = pool[middle];
      axes_[range.node] = static_cast<std::uint8_t>(axis);
      if (range.begin < middle) pending.push_back({2 * range.node + 1, range.begin, middle});
      if (middle + 1 < range.end) pending.push_back({2 * range.node + 2, middle + 1, range.end});
    }
  }

  int widest_axis(const std::vector<std::uint32_t>& pool, std::size_t begin, std::size_t end) const {
    Vec3d lo{1, 1, 1}, hi{-1, -1, -1};
    for (std::size_t i = begin; i < end; ++i)
      for (int axis = 0; axis < 3; ++axis) {
        lo[axis] = std::min(lo[axis], spheres().stored_centre(pool[i])[axis]);
        hi[axis] = std::max(hi[axis], spheres().stored_centre(pool[i])[axis]);
      }
    const Vec3d size = hi - lo;
    return size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  }
};

}  // namespace

Result<StructurePointer> build_pkd(const SphereSet& spheres, const StructureParameters&, int) {
  return build_or_error(spheres, "pkd", [&]() -> StructurePointer { return std::make_unique<Pkd>(spheres); });
}

}  // namespace bihive::workbench
