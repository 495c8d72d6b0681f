#include "tree_reasons.h"

#include <algorithm>
#include <array>
#include <set>

#include "bihive/bih/reference_builder.h"
#include "pictures.h"
#include "statistics.h"

namespace bihive::thesis {
namespace {

// The part of space that a node is responsible for, in stored units.
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

// The volume of the union of boxes, exactly: slab by slab along x, strip by strip along y, intervals along z.
double volume_of_union(const std::vector<Region>& boxes) {
  const auto planes = [](const std::vector<const Region*>& of, std::size_t axis) {
    std::set<double> all;
    for (const Region* box : of) all.insert({box->lo[axis], box->hi[axis]});
    return std::vector<double>(all.begin(), all.end());
  };
  const auto across = [](const std::vector<const Region*>& of, std::size_t axis, double low, double high) {
    std::vector<const Region*> found;
    for (const Region* box : of)
      if (box->lo[axis] <= low && box->hi[axis] >= high) found.push_back(box);
    return found;
  };
  std::vector<const Region*> all;
  all.reserve(boxes.size());
  for (const Region& box : boxes) all.push_back(&box);
  double volume = 0;
  const std::vector<double> x = planes(all, 0);
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    const std::vector<const Region*> slab = across(all, 0, x[i], x[i + 1]);
    const std::vector<double> y = planes(slab, 1);
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      std::vector<const Region*> strip = across(slab, 1, y[j], y[j + 1]);
      std::sort(strip.begin(), strip.end(), [](const Region* a, const Region* b) { return a->lo[2] < b->lo[2]; });
      double covered = 0, end = -1e300;
      for (const Region* box : strip) {
        covered += std::max(0.0, box->hi[2] - std::max(end, box->lo[2]));
        end = std::max(end, box->hi[2]);
      }
      volume += (x[i + 1] - x[i]) * (y[j + 1] - y[j]) * covered;
    }
  }
  return volume;
}

// Space that no node of these levels covers is looked at down to here.
constexpr std::size_t kVoidLevels = 10;

struct TreeFacts {
  std::vector<double> spheres, depths;  // of the leaves
  double overlaps = 0, gaps = 0, splits = 0;
  std::vector<double> void_percent;  // by level, of the root's box: what no node of the level covers, and no leaf above
};

struct Pending {
  std::int64_t node;
  std::size_t depth;
  Region region;
};

TreeFacts facts_of(const Tree& tree) {
  TreeFacts facts;
  const auto leaf = [&](std::int64_t count, std::size_t depth) {
    facts.spheres.push_back(static_cast<double>(count));
    facts.depths.push_back(static_cast<double>(depth));
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
    const double low = region.lo[axis], high = region.hi[axis];
    if (node.kind == NodeKind::split) {
      ++facts.splits;
      if (node.left_clip > node.right_clip) ++facts.overlaps;
      if (node.left_clip < node.right_clip) ++facts.gaps;
      pending.push_back({node.right_child(), depth + 1, region.between(axis, node.right_clip, high)});
      pending.push_back({node.left_child(), depth + 1, region.between(axis, low, node.left_clip)});
    } else {
      // A one-sided node has an empty leaf beside its child.
      if (node.kind != NodeKind::clip) leaf(0, depth + 1);
      const Region child = node.kind == NodeKind::clip       ? region.between(axis, node.left_clip, node.right_clip)
                           : node.kind == NodeKind::one_left ? region.between(axis, low, node.left_clip)
                                                             : region.between(axis, node.right_clip, high);
      pending.push_back({node.first, depth + 1, child});
    }
  }
  for (const std::vector<Region>& level : levels)
    facts.void_percent.push_back(100 * (1 - volume_of_union(level) / root.volume()));
  return facts;
}

Json measure_tree(const StepContext& context, std::int64_t scenario, std::int64_t spheres, std::int64_t max_prims,
                  std::int64_t seeds) {
  std::vector<double> mean, sd, overlap, gap, depth, coinciding;
  std::vector<std::vector<double>> by_level;
  for (std::int64_t seed = 1; seed <= seeds && !context.cancel.cancelled(); ++seed) {
    const SphereSet set = context.values.scene(scenario, spheres, static_cast<std::uint64_t>(seed)).spheres;
    const TreeFacts facts = facts_of(build_reference_tree(set, {max_prims, kUnlimited}));
    mean.push_back(spread_of(facts.spheres).mean);
    sd.push_back(spread_of(facts.spheres).sd);
    depth.push_back(spread_of(facts.depths).sd);
    overlap.push_back(facts.splits > 0 ? 100 * facts.overlaps / facts.splits : 0);
    gap.push_back(facts.splits > 0 ? 100 * facts.gaps / facts.splits : 0);
    coinciding.push_back(static_cast<double>(coinciding_spheres(set)));
    by_level.resize(facts.void_percent.size());
    for (std::size_t level = 0; level < by_level.size(); ++level) by_level[level].push_back(facts.void_percent[level]);
  }
  const auto middle = [](const std::vector<double>& values) { return spread_of(values).mean; };
  Json levels = Json::array();
  for (const std::vector<double>& level : by_level) levels.push_back(middle(level));
  return {{"scenario", scenario},
          {"spheres", spheres},
          {"max_prims", max_prims},
          {"seeds", seeds},
          {"spheres_per_leaf", middle(mean)},
          {"spheres_per_leaf_sd", middle(sd)},
          {"depth_sd", middle(depth)},
          {"overlap_percent", middle(overlap)},
          {"gap_percent", middle(gap)},
          {"void_percent", middle(by_level.back())},
          {"void_percent_by_level", std::move(levels)},
          {"coinciding", middle(coinciding)}};
}

}  // namespace

Json measure_reasons(const StepContext& context, const ReasonTrees& trees) {
  Json rows = Json::array();
  for (const std::int64_t scenario : trees.scenarios)
    for (const std::int64_t spheres : trees.spheres)
      for (const std::int64_t max_prims : trees.max_prims) {
        rows.push_back(measure_tree(context, scenario, spheres, max_prims,
                                    scenario_of(scenario) == Scenario::grid ? 1 : trees.seeds));
        if (context.cancel.cancelled()) return {};
      }
  return rows;
}

}  // namespace bihive::thesis
