// bvh-ploc: a BVH merged from below: clusters, in the order of the Z-curve, look for the neighbour with which their
// common box is smallest, and pairs that choose each other merge [Meister2018].

#include <algorithm>
#include <tuple>

#include "bihive/compare/box_tree.h"
#include "bihive/compare/morton.h"
#include "bihive/compare/sphere_limit.h"

namespace bihive::workbench {
namespace {

constexpr std::int64_t kNeighbours = 14;  // on each side
constexpr std::int64_t kPlocLeaf = 8;
// Past this level clusters are halved by count, which takes at most 32 more.
constexpr std::int64_t kLevelsOfMerges = 80;
constexpr std::uint32_t kNoChild = ~0U;

// A cluster is one sphere (`left`: its id, `right`: kNoChild), or two older clusters.
struct Cluster {
  Aabb box;
  std::uint32_t left, right;
  std::uint32_t spheres;
  double cost;  // SAH cost of the cheapest subtree, with unit costs for a node and a sphere test

  bool is_sphere() const { return right == kNoChild; }
};

class Merging {
 public:
  Merging(const SphereSet& spheres, const StructureParameters& parameters)
      : spheres_(spheres),
        neighbours_(parameters.candidates > 0 ? parameters.candidates : kNeighbours),
        max_prims_(parameters.max_prims > 0 ? parameters.max_prims : kPlocLeaf) {}

  BoxTree build() {
    BoxTree tree;
    if (spheres_.empty()) return tree;
    merge_all();
    lay_out(tree);
    fit_boxes(tree, spheres_);
    return tree;
  }

 private:
  const SphereSet& spheres_;
  const std::int64_t neighbours_, max_prims_;
  std::vector<Cluster> clusters_;      // a cluster comes after its children
  std::vector<std::uint32_t> active_;  // those without a parent, along the curve

  void merge_all() {
    for (const MortonSphere& one : along_the_z_curve(spheres_)) {
      const Aabb box = outward_box(spheres_, one.id);
      active_.push_back(static_cast<std::uint32_t>(clusters_.size()));
      clusters_.push_back({box, one.id, kNoChild, 1, 2 * half_surface(box)});
    }
    std::vector<std::int64_t> nearest;
    while (active_.size() > 1) {
      const std::int64_t count = std::ssize(active_);
      nearest.assign(static_cast<std::size_t>(count), -1);
      for (std::int64_t i = 0; i < count; ++i) nearest[static_cast<std::size_t>(i)] = nearest_of(i);
      // Merge pairs that chose each other, at the position of the first.
      std::size_t kept = 0;
      for (std::int64_t i = 0; i < count; ++i) {
        const std::int64_t other = nearest[static_cast<std::size_t>(i)];
        const bool both = nearest[static_cast<std::size_t>(other)] == i;
        if (both && other < i) continue;
        active_[kept++] = both ? merged(active_[static_cast<std::size_t>(i)], active_[static_cast<std::size_t>(other)])
                               : active_[static_cast<std::size_t>(i)];
      }
      active_.resize(kept);
    }
  }

  // Pairs compare alike from both sides, so the least pair always merges. Where surface areas are equal, as for
  // coincident spheres, clusters 0 and 1, 2 and 3 and so on choose each other, which halves their number.
  std::int64_t nearest_of(std::int64_t i) const {
    std::int64_t best = -1;
    std::tuple<double, std::int64_t, bool, std::int64_t> least;
    const std::int64_t last = std::min<std::int64_t>(std::ssize(active_) - 1, i + neighbours_);
    for (std::int64_t k = std::max<std::int64_t>(0, i - neighbours_); k <= last; ++k) {
      if (k == i) continue;
      Aabb box = clusters_[active_[static_cast<std::size_t>(i)]].box;
      box.add(clusters_[active_[static_cast<std::size_t>(k)]].box);
      const std::tuple rank{half_surface(box), std::abs(i - k), (i ^ k) != 1, std::min(i, k)};
      if (best < 0 || rank < least) best = k, least = rank;
    }
    return best;
  }

  std::uint32_t merged(std::uint32_t left, std::uint32_t right) {
    const Cluster &a = clusters_[left], &b = clusters_[right];
    Cluster both{a.box, left, right, a.spheres + b.spheres, 0};
    both.box.add(b.box);
    both.cost = std::min(half_surface(both.box) + a.cost + b.cost, cost_of_leaf(both));
    clusters_.push_back(both);
    return static_cast<std::uint32_t>(clusters_.size() - 1);
  }
  double cost_of_leaf(const Cluster& cluster) const {
    if (cluster.spheres > max_prims_) return std::numeric_limits<double>::infinity();
    return half_surface(cluster.box) * (1.0 + cluster.spheres);
  }

  // Numbers the nodes as a box tree needs them, children side by side.
  void lay_out(BoxTree& tree) const {
    struct Pending {
      std::uint32_t node, cluster;
      std::int64_t level;
    };
    tree.nodes.emplace_back();
    std::vector<Pending> pending{{0, active_.front(), 1}};
    while (!pending.empty()) {
      const Pending at = pending.back();
      pending.pop_back();
      const Cluster& cluster = clusters_[at.cluster];
      if (at.level == kLevelsOfMerges || cluster.is_sphere() || !(cluster.cost < cost_of_leaf(cluster))) {
        const std::vector<std::uint32_t> ids = spheres_of(at.cluster);
        halve(tree, at.node, ids.data(), ids.size());
        continue;
      }
      const auto left = static_cast<std::uint32_t>(tree.nodes.size());
      tree.nodes[at.node].first = left;
      tree.nodes.resize(tree.nodes.size() + 2);
      pending.push_back({left, cluster.left, at.level + 1});
      pending.push_back({left + 1, cluster.right, at.level + 1});
    }
    tree.nodes.shrink_to_fit();
    tree.sphere_ids.shrink_to_fit();
  }

  std::vector<std::uint32_t> spheres_of(std::uint32_t cluster) const {
    std::vector<std::uint32_t> ids, pending{cluster};
    while (!pending.empty()) {
      const Cluster& at = clusters_[pending.back()];
      pending.pop_back();
      if (at.is_sphere()) {
        ids.push_back(at.left);
      } else {
        pending.push_back(at.right);
        pending.push_back(at.left);
      }
    }
    return ids;
  }

  // Makes the node a leaf if the spheres are few enough for one.
  void halve(BoxTree& tree, std::uint32_t node, const std::uint32_t* ids, std::size_t count) const {
    if (static_cast<std::int64_t>(count) <= max_prims_) {
      tree.nodes[node].first = static_cast<std::uint32_t>(tree.sphere_ids.size());
      tree.nodes[node].count = static_cast<std::uint32_t>(count);
      tree.sphere_ids.insert(tree.sphere_ids.end(), ids, ids + count);
      return;
    }
    const auto left = static_cast<std::uint32_t>(tree.nodes.size());
    tree.nodes[node].first = left;
    tree.nodes.resize(tree.nodes.size() + 2);
    halve(tree, left, ids, count / 2);
    halve(tree, left + 1, ids + count / 2, count - count / 2);
  }
};

}  // namespace

Result<StructurePointer> build_bvh_ploc(const SphereSet& spheres, const StructureParameters& parameters, int) {
  return build_or_error(
      spheres, "bvh-ploc",
      [&]() -> StructurePointer {
        return std::make_unique<BoxTreeStructure>(spheres, Merging(spheres, parameters).build());
      },
      2);
}

}  // namespace bihive::workbench
