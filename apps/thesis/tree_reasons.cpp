#include "tree_reasons.h"

#include <algorithm>
#include <array>
#include <set>

#include "bihive/bih/reference_builder.h"
#include "pictures.h"
#include "statistics.h"

namespace bihive::thesis {
namespace {

// The levels down to which uncovered space is measured.
constexpr std::size_t kVoidLevels = 10;

// The region of a node, in stored units.
struct Region {
  std::array<double, 3> lo, hi;
  double volume() const { return (hi[0] - lo[0]) * (hi[1] - lo[1]) * (hi[2] - lo[2]); }
  // The slab between two planes, as far as it lies inside.
  Region between(std::size_t axis, double low, double high) const {
    Region part = *this;
    part.lo[axis] = std::clamp(low, lo[axis], hi[axis]);
    part.hi[axis] = std::clamp(high, part.lo[axis], hi[axis]);
    return part;
  }
};

// The volume of the union of boxes, exactly: slab by slab along this axis, and each slab so along the next one.
double volume_of_union(const std::vector<Region>& boxes, std::size_t axis = 0) {
  if (axis == 3) return 1;
  std::set<double> planes;
  for (const Region& box : boxes) planes.insert({box.lo[axis], box.hi[axis]});
  double volume = 0;
  std::vector<Region> slab;
  for (auto low = planes.begin(); low != planes.end() && std::next(low) != planes.end(); ++low) {
    const double high = *std::next(low);
    slab.clear();
    for (const Region& box : boxes)
      if (box.lo[axis] <= *low && box.hi[axis] >= high) slab.push_back(box);
    if (!slab.empty()) volume += (high - *low) * volume_of_union(slab, axis + 1);
  }
  return volume;
}

template <class Holds>
double percent_of_splits(const Tree& tree, const Holds& holds) {
  double splits = 0, held = 0;
  for (const Node& node : tree.nodes) {
    if (node.kind != NodeKind::split) continue;
    ++splits;
    held += holds(node) ? 1 : 0;
  }
  return splits > 0 ? 100 * held / splits : 0;
}

struct Pending {
  std::int64_t node;
  std::size_t depth;
  Region region;
};

Json reasons_of(const Tree& tree) {
  std::vector<double> spheres, depths;  // one per leaf
  const auto leaf = [&](std::int64_t count, std::size_t depth) {
    spheres.push_back(static_cast<double>(count));
    depths.push_back(static_cast<double>(depth));
  };
  const Vec3d lo = to_double(tree.aabb.lo), hi = to_double(tree.aabb.hi);
  const Region root{{lo.x, lo.y, lo.z}, {hi.x, hi.y, hi.z}};
  std::vector<std::vector<Region>> levels(kVoidLevels);
  std::vector<Pending> pending{{0, 1, root}};
  while (!pending.empty()) {
    const auto [position, depth, region] = pending.back();
    pending.pop_back();
    const Node& node = tree.nodes[static_cast<std::size_t>(position)];
    // A leaf covers its region on all levels below too.
    for (std::size_t level = depth; level <= (node.is_leaf() ? kVoidLevels : std::min(depth, kVoidLevels)); ++level)
      levels[level - 1].push_back(region);
    if (node.is_leaf()) {
      leaf(node.sphere_count, depth);
      continue;
    }
    const std::size_t axis = node.split_axis;
    const Region left = region.between(axis, region.lo[axis], node.left_clip);
    const Region right = region.between(axis, node.right_clip, region.hi[axis]);
    if (node.kind == NodeKind::split) {
      pending.push_back({node.right_child(), depth + 1, right});
      pending.push_back({node.left_child(), depth + 1, left});
      continue;
    }
    // A one-sided node has an empty leaf beside its child.
    if (node.kind != NodeKind::clip) leaf(0, depth + 1);
    const Region child = node.kind == NodeKind::clip       ? region.between(axis, node.left_clip, node.right_clip)
                         : node.kind == NodeKind::one_left ? left
                                                           : right;
    pending.push_back({node.first, depth + 1, child});
  }
  Json reasons{{"spheres_per_leaf", spread_of(spheres).mean},
               {"spheres_per_leaf_sd", spread_of(spheres).sd},
               {"depth_sd", spread_of(depths).sd},
               {"overlap_percent", overlap_percent(tree)},
               {"gap_percent", percent_of_splits(tree, [](const Node& n) { return n.left_clip < n.right_clip; })},
               {"void_percent", 0}};
  for (const std::vector<Region>& level : levels)
    reasons["void_percent_by_level"].push_back(100 * (1 - volume_of_union(level) / root.volume()));
  reasons["void_percent"] = reasons["void_percent_by_level"].back();
  return reasons;
}

// Number by number.
Json means_of(const std::vector<Json>& all) {
  Json means = all.front().flatten();
  for (const auto& [path, value] : means.items()) {
    std::vector<double> sample;
    for (const Json& one : all) sample.push_back(one.at(Json::json_pointer(path)).get<double>());
    value = spread_of(sample).mean;
  }
  return means.unflatten();
}

}  // namespace

double overlap_percent(const Tree& tree) {
  return percent_of_splits(tree, [](const Node& node) { return node.left_clip > node.right_clip; });
}

Json measure_reasons(const Experiment& experiment, const std::vector<std::int64_t>& spheres,
                     const std::vector<std::int64_t>& max_prims, std::int64_t seeds) {
  Json rows = Json::array();
  for (const std::int64_t scenario : experiment.values.integers("scenarios"))
    for (const std::int64_t count : spheres)
      for (const std::int64_t prims : max_prims) {
        const std::vector<Json> all = over_seeds(experiment, scenario, seeds, [&](std::uint64_t seed) {
          const SphereSet set = experiment.values.scene(scenario, count, seed).spheres;
          Json reasons = reasons_of(build_reference_tree(set, {prims, kUnlimited}));
          reasons["coinciding"] = coinciding_spheres(set);
          return reasons;
        });
        if (experiment.cancel.cancelled()) return {};
        Json row{{"scenario", scenario}, {"spheres", count}, {"max_prims", prims}, {"seeds", all.size()}};
        row.update(means_of(all));
        rows.push_back(std::move(row));
      }
  return rows;
}

}  // namespace bihive::thesis
