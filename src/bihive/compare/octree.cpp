// octree: cubes halved along all three axes at once [Meagher1982]. A sphere is listed in every leaf that it reaches
// into.
//
// A node's box is that of the spheres' parts in its cube, so rays pass empty space around them. Cubes of which one
// octant alone has spheres have no node.

#include <algorithm>
#include <deque>
#include <numeric>

#include "bihive/compare/boxes.h"
#include "bihive/compare/by_ray.h"
#include "bihive/compare/level_sums.h"
#include "bihive/compare/nearest_first.h"
#include "bihive/compare/sphere_limit.h"

namespace bihive::workbench {
namespace {

constexpr std::int64_t kOctreeLeaf = 8;     // spheres, unless division does not pay
constexpr std::int64_t kMostHalvings = 50;  // of the cube around everything
constexpr std::size_t kMostOctantsWaiting = 7 * (kMostHalvings + 1) + 1;
// Cubes stay whole where all lists together would have more entries than this, per sphere.
constexpr std::int64_t kMostOctreeEntries = 12;

// A leaf lists `spheres` entries from `first` on; an inner node has the children from node `first` on.
struct OctreeNode {
  Aabb box;
  std::uint32_t first = 0;
  std::uint32_t spheres = 0;
  std::uint32_t children = 0;

  bool is_leaf() const { return children == 0; }
};

struct Cube {
  Vec3d lo;
  double side = 0;

  Cube octant(int number) const {
    Cube half{lo, side / 2};
    for (int axis = 0; axis < 3; ++axis)
      if ((number >> axis & 1) != 0) half.lo[axis] += half.side;
    return half;
  }
  Aabb box() const {
    Aabb box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = rounded_down(lo[axis]);
      box.hi[axis] = rounded_up(lo[axis] + side);
    }
    return box;
  }
};

class Octree final : public ByRay<Octree> {
 public:
  Octree(const SphereSet& spheres, const StructureParameters& parameters) : ByRay(spheres) {
    if (spheres.empty()) return;
    max_prims_ = parameters.max_prims > 0 ? parameters.max_prims : kOctreeLeaf;
    max_depth_ = parameters.max_depth > 0 ? parameters.max_depth : kMostHalvings + 1;
    build();
  }

  StructureFacts facts() const override {
    StructureFacts facts;
    facts.bytes = static_cast<std::int64_t>(sizeof(Octree) + nodes_.capacity() * sizeof(OctreeNode) +
                                            ids_.capacity() * sizeof(std::uint32_t));
    facts.nodes = static_cast<std::int64_t>(nodes_.size());
    if (nodes_.empty()) return facts;
    LevelSums sums(nodes_[0].box);
    std::vector<std::int64_t> level(nodes_.size(), 1);
    std::vector<Aabb> boxes;
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      const OctreeNode& node = nodes_[i];
      sums.add(level[i], node.box, node.is_leaf(), node.spheres);
      if (node.is_leaf()) continue;
      boxes.clear();
      for (std::uint32_t child = node.first; child < node.first + node.children; ++child) {
        level[child] = level[i] + 1;
        boxes.push_back(nodes_[child].box);
      }
      sums.add_children(level[i], node.box, boxes);
    }
    sums.put(facts);
    return facts;
  }

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
    traverse([&](const Aabb& box) { return least_distance_to_cell(point, box, pad); }, [&] { return nearest.limit(); },
             [&](std::int64_t id) {
               test(point, id, nearest, counter);
               return false;
             },
             counter);
  }

 private:
  std::int64_t max_prims_ = kOctreeLeaf, max_depth_ = 0;
  std::vector<OctreeNode> nodes_;  // [0] is the root; children come after their parent
  std::vector<std::uint32_t> ids_;

  template <class Entry, class Limit, class Visit, class Counter>
  void traverse(const Entry& entry, const Limit& limit, const Visit& visit, Counter& counter) const {
    const auto open = [&](std::uint32_t at, const auto& wait) {
      const OctreeNode& node = nodes_[at];
      counter.node(node.is_leaf());
      for (std::uint32_t i = node.first; i < node.first + node.spheres; ++i)
        if (visit(std::int64_t{ids_[i]})) return true;
      for (std::uint32_t child = node.first; child < node.first + node.children; ++child) {
        counter.box_test();
        wait(child, entry(nodes_[child].box));
      }
      return false;
    };
    counter.box_test();
    nearest_first<kMostOctantsWaiting>(std::uint32_t{0}, entry(nodes_[0].box), open, limit);
  }

  // The spheres that reach into a cube.
  struct Range {
    std::uint32_t node = 0;
    std::int64_t level = 1, halvings = 0;
    Cube cube;
    Aabb box;  // of their parts
    std::vector<std::uint32_t> ids;
  };

  Range whole() const {
    Range range;
    range.ids.resize(static_cast<std::size_t>(spheres().size()));
    std::iota(range.ids.begin(), range.ids.end(), 0U);
    for (const std::uint32_t id : range.ids) range.box.add(outward_box(spheres(), id));
    range.cube.lo = to_double(range.box.lo);
    const Vec3d size = to_double(range.box.hi) - range.cube.lo;
    range.cube.side = std::max({size.x, size.y, size.z});
    return range;
  }

  // Level after level, so that the entries that remain go to all octants alike.
  void build() {
    std::deque<Range> pending{whole()};
    std::int64_t entries = spheres().size();
    nodes_.emplace_back();
    for (; !pending.empty(); pending.pop_front()) {
      const Range& range = pending.front();
      std::vector<Range> octants = divide(range);
      std::int64_t more = -std::ssize(range.ids);
      for (const Range& octant : octants) more += std::ssize(octant.ids);
      OctreeNode node{range.box, 0, 0, 0};
      if (!octants.empty() && entries + more <= kMostOctreeEntries * spheres().size() + 64) {
        entries += more;
        node.first = static_cast<std::uint32_t>(nodes_.size());
        node.children = static_cast<std::uint32_t>(octants.size());
        for (Range& octant : octants) {
          octant.node = static_cast<std::uint32_t>(nodes_.size());
          nodes_.emplace_back();
          pending.push_back(std::move(octant));
        }
      } else {
        node.first = static_cast<std::uint32_t>(ids_.size());
        node.spheres = static_cast<std::uint32_t>(range.ids.size());
        ids_.insert(ids_.end(), range.ids.begin(), range.ids.end());
      }
      nodes_[pending.front().node] = node;
    }
    nodes_.shrink_to_fit();
    ids_.shrink_to_fit();
  }

  // The octants that have spheres: of the first cube on the way down with more than one of them. None: a leaf.
  std::vector<Range> divide(const Range& range) const {
    if (std::ssize(range.ids) <= max_prims_ || range.level >= max_depth_) return {};
    std::vector<Range> octants;
    Cube cube = range.cube;
    std::int64_t halvings = range.halvings;
    while (octants.size() <= 1) {
      if (!octants.empty()) cube = octants[0].cube;
      if (++halvings > kMostHalvings || !(cube.side > 0)) return {};
      octants.clear();
      for (int number = 0; number < 8; ++number) {
        Range octant{0, range.level + 1, halvings, cube.octant(number), {}, {}};
        const Aabb cell = octant.cube.box();
        for (const std::uint32_t id : range.ids) {
          const Aabb part = clipped_box(spheres(), id, cell);
          if (part.empty()) continue;
          octant.ids.push_back(id);
          octant.box.add(part);
        }
        if (!octant.ids.empty()) octants.push_back(std::move(octant));
      }
      if (octants.empty()) return {};
    }
    // A node pays if the octants' surfaces save more tests than entering it costs.
    double tests = half_surface(range.box);
    for (const Range& octant : octants) tests += half_surface(octant.box) * double(octant.ids.size());
    return tests < half_surface(range.box) * double(range.ids.size()) ? std::move(octants) : std::vector<Range>();
  }
};

}  // namespace

Result<StructurePointer> build_octree(const SphereSet& spheres, const StructureParameters& parameters, int) {
  return build_or_error(
      spheres, "octree", [&]() -> StructurePointer { return std::make_unique<Octree>(spheres, parameters); },
      kMostOctreeEntries);
}

}  // namespace bihive::workbench
