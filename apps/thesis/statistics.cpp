#include "statistics.h"

#include <algorithm>
#include <set>

#include "bihive/bih/child_boxes.h"
#include "bihive/bih/reference_builder.h"
#include "machine_load.h"
#include "pictures.h"

namespace bihive::thesis {
namespace {

// The levels down to which uncovered space is measured.
constexpr std::size_t kVoidLevels = 10;

// The volume of the union of boxes, exactly: slab by slab along this axis, and each slab so along the next one.
double volume_of_union(const std::vector<Aabb>& boxes, int axis = 0) {
  if (axis == 3) return 1;
  std::set<double> planes;
  for (const Aabb& box : boxes) planes.insert({box.lo[axis], box.hi[axis]});
  double volume = 0;
  std::vector<Aabb> slab;
  for (auto low = planes.begin(); low != planes.end() && std::next(low) != planes.end(); ++low) {
    const double high = *std::next(low);
    slab.clear();
    for (const Aabb& box : boxes)
      if (box.lo[axis] <= *low && box.hi[axis] >= high) slab.push_back(box);
    if (!slab.empty()) volume += (high - *low) * volume_of_union(slab, axis + 1);
  }
  return volume;
}

template <class Holds>
double percent_of_splits(const Tree& tree, const Holds& holds) {
  double splits = 0, held = 0;
  for (const Node& node : tree.nodes) {
    splits += node.kind == NodeKind::split;
    held += node.kind == NodeKind::split && holds(node);
  }
  return splits > 0 ? 100 * held / splits : 0;
}

double volume_of(const Aabb& box) {
  const Vec3d sides = to_double(box.hi) - to_double(box.lo);
  return sides.x * sides.y * sides.z;
}

struct Pending {
  std::int64_t node;
  std::size_t depth;
  Aabb box;  // bounds of the node, in stored units
};

Json reasons_of(const Tree& tree) {
  std::vector<double> spheres, depths;  // one per leaf
  const auto leaf = [&](std::int64_t count, std::size_t depth) {
    spheres.push_back(static_cast<double>(count));
    depths.push_back(static_cast<double>(depth));
  };
  std::vector<std::vector<Aabb>> levels(kVoidLevels);
  std::vector<Pending> pending{{0, 1, tree.aabb}};
  while (!pending.empty()) {
    const auto [position, depth, box] = pending.back();
    pending.pop_back();
    const Node& node = tree.nodes[static_cast<std::size_t>(position)];
    // A leaf covers its box on all levels below too.
    for (std::size_t level = depth; level <= (node.is_leaf() ? kVoidLevels : std::min(depth, kVoidLevels)); ++level)
      levels[level - 1].push_back(box);
    if (node.is_leaf()) {
      leaf(node.sphere_count, depth);
      continue;
    }
    const ChildBoxes children = child_boxes(node, box);
    if (node.kind == NodeKind::split) pending.push_back({node.right_child(), depth + 1, children.second});
    pending.push_back({node.left_child(), depth + 1, children.first});
    // A one-sided node has an empty leaf beside its child.
    if (node.kind == NodeKind::one_left || node.kind == NodeKind::one_right) leaf(0, depth + 1);
  }
  Json reasons{{"spheres_per_leaf", mean_and_sd(spheres).mean},
               {"spheres_per_leaf_sd", mean_and_sd(spheres).sd},
               {"depth_sd", mean_and_sd(depths).sd},
               {"overlap_percent", overlap_percent(tree)},
               {"gap_percent", percent_of_splits(tree, [](const Node& n) { return n.left_clip < n.right_clip; })},
               {"void_percent", 0}};
  for (const std::vector<Aabb>& level : levels)
    reasons["void_percent_by_level"].push_back(100 * (1 - volume_of_union(level) / volume_of(tree.aabb)));
  reasons["void_percent"] = reasons["void_percent_by_level"].back();
  return reasons;
}

// Number by number.
Json means_of(const std::vector<Json>& all) {
  Json means = all.front().flatten();
  for (const auto& [path, value] : means.items()) {
    std::vector<double> sample;
    for (const Json& one : all) sample.push_back(one.at(Json::json_pointer(path)).get<double>());
    value = mean_and_sd(sample).mean;
  }
  return means.unflatten();
}

}  // namespace

Json times_in_turns(const Experiment& experiment, int rounds, const Contestants& contestants) {
  Json times = Json::object();
  for (const auto& [name, run] : contestants) times[name] = Json::array();
  for (int round = 0; round <= rounds; ++round)
    for (std::size_t turn = 0; turn < contestants.size(); ++turn) {
      if (experiment.cancel.cancelled()) return {};
      const auto& [name, run] = contestants[round % 2 == 0 ? turn : contestants.size() - 1 - turn];
      // Other work on the machine hardly affects the time of a thread.
      const double before = seconds_by(CLOCK_THREAD_CPUTIME_ID);
      run();
      if (round > 0) times[name].push_back(1000 * (seconds_by(CLOCK_THREAD_CPUTIME_ID) - before));
    }
  return times;
}

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
