#include "thesis/tree_reasons.h"

#include <fmt/format.h>

#include <utility>

#include "bihive/bih/reference_builder.h"
#include "support/failure.h"
#include "thesis/coinciding.h"

namespace bihive::cli::thesis {
namespace {

struct TreeFacts {
  Spread spheres, depth;  // of the leaves
  double overlaps = 0, gaps = 0, splits = 0;
};

TreeFacts facts_of(const Tree& tree) {
  TreeFacts facts;
  std::vector<double> spheres, depths;
  const auto leaf = [&](std::int64_t count, std::int64_t depth) {
    spheres.push_back(static_cast<double>(count));
    depths.push_back(static_cast<double>(depth));
  };
  std::vector<std::pair<std::int64_t, std::int64_t>> pending{{0, 1}};
  while (!pending.empty()) {
    const auto [position, depth] = pending.back();
    pending.pop_back();
    const Node& node = tree.nodes[static_cast<std::size_t>(position)];
    if (node.is_leaf()) {
      leaf(node.sphere_count, depth);
    } else if (node.kind == NodeKind::split) {
      ++facts.splits;
      if (node.left_clip > node.right_clip) ++facts.overlaps;
      if (node.left_clip < node.right_clip) ++facts.gaps;
      pending.emplace_back(node.right_child(), depth + 1);
      pending.emplace_back(node.left_child(), depth + 1);
    } else {
      // A one-sided node has an empty leaf beside its child.
      if (node.kind != NodeKind::clip) leaf(0, depth + 1);
      pending.emplace_back(node.first, depth + 1);
    }
  }
  facts.spheres = spread_of(spheres);
  facts.depth = spread_of(depths);
  return facts;
}

Json measure_tree_reasons(const StepContext& context, const ReasonTrees& trees, std::int64_t number,
                          std::int64_t spheres, std::int64_t max_prims) {
  const Scenario scenario = scenario_of(number);
  const std::int64_t seeds = scenario == Scenario::grid ? 1 : trees.seeds;
  std::vector<double> mean, sd, relative, overlap, gap, depth, coinciding;
  for (std::int64_t seed = 1; seed <= seeds && !context.cancel.cancelled(); ++seed) {
    const ScenarioParameters parameters{spheres, static_cast<float>(trees.radius), static_cast<std::uint64_t>(seed)};
    const SphereSet set = value_or_fail(scenario_spheres(scenario, parameters));
    const TreeFacts facts = facts_of(build_reference_tree(set, build_parameters(max_prims, 0)));
    mean.push_back(facts.spheres.mean);
    sd.push_back(facts.spheres.sd);
    relative.push_back(facts.spheres.sd / facts.spheres.mean);
    overlap.push_back(facts.splits > 0 ? facts.overlaps / facts.splits : 0);
    gap.push_back(facts.splits > 0 ? facts.gaps / facts.splits : 0);
    depth.push_back(facts.depth.sd);
    coinciding.push_back(static_cast<double>(coinciding_spheres(set)));
  }
  const auto middle = [](const std::vector<double>& values) { return spread_of(values).mean; };
  return {{"scenario", number},
          {"spheres", spheres},
          {"max_prims", max_prims},
          {"seeds", seeds},
          {"spheres_per_leaf", {{"mean", middle(mean)}, {"sd", middle(sd)}}},
          {"relative_sd", middle(relative)},
          {"overlap_share", middle(overlap)},
          {"gap_share", middle(gap)},
          {"depth_sd", middle(depth)},
          {"coinciding", middle(coinciding)}};
}

}  // namespace

Json measure_reasons(const StepContext& context, const ReasonTrees& trees) {
  Json rows = Json::array();
  for (const std::int64_t scenario : trees.scenarios)
    for (const std::int64_t spheres : trees.spheres)
      for (const std::int64_t max_prims : trees.max_prims) {
        rows.push_back(measure_tree_reasons(context, trees, scenario, spheres, max_prims));
        if (context.cancel.cancelled()) return {};
      }
  return rows;
}

Table reasons_table(const Json& rows, const std::string& title) {
  Table table{title,
              {"Scenario", "Spheres", "MAX_PRIMS", "Spheres a leaf", "their deviation", "deviation / mean",
               "Deviation of leaf depth", "Children overlap", "Children leave a gap", "Spheres at another's place"},
              {},
              "Means over the seeds 1, 2, ..., whatever --seed says; deviations are over the leaves of a tree, shares "
              "are of its split nodes. Spheres at another's place: the grid begins anew where their number is no cube "
              "number; no tree can part them."};
  for (const Json& row : rows)
    table.rows.push_back({{row["scenario"].dump()},
                          {row["spheres"].dump()},
                          {row["max_prims"].dump()},
                          {fmt::format("{:.2f}", row["spheres_per_leaf"]["mean"].get<double>())},
                          {fmt::format("{:.2f}", row["spheres_per_leaf"]["sd"].get<double>())},
                          {fmt::format("{:.2f}", row["relative_sd"].get<double>())},
                          {fmt::format("{:.2f}", row["depth_sd"].get<double>())},
                          {fmt::format("{:.1f} %", 100 * row["overlap_share"].get<double>())},
                          {fmt::format("{:.1f} %", 100 * row["gap_share"].get<double>())},
                          {fmt::format("{:.0f}", row["coinciding"].get<double>())}});
  return table;
}

}  // namespace bihive::cli::thesis
