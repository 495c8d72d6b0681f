// Figure 4.5: the memory of the tree, predicted, counted by the text's rule, and as this program allocates it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bihive/base/parallel.h"
#include "bihive/base/write_file.h"
#include "bihive/bih/memory.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/bih/validate.h"
#include "bihive/image/svg_chart.h"
#include "statistics.h"

namespace bihive::thesis {
namespace {

// The seeds 1, 2, ... for mean and standard deviation.
constexpr std::int64_t kSeeds = 100, kQuickSeeds = 20;
constexpr const char* kRadiusStep = "radius";

std::string step_name(std::int64_t scenario) {
  return fmt::format("scenario{}", scenario);
}

double counted_bytes(const Values& values, const Tree& tree, std::int64_t spheres) {
  const TreeStatistics s = tree_statistics(tree);
  return values.number("node_bytes") * static_cast<double>(s.inner_nodes + s.leaves) +
         values.number("index_bytes") * static_cast<double>(spheres) + values.number("aabb_bytes");
}

Json measure_tree(const StepContext& context, std::int64_t scenario, std::int64_t count, std::int64_t max_prims) {
  // Predict before anything is built.
  const Values& values = context.values;
  const BuildParameters build{max_prims, values.limit("max_depth")};
  const MemoryPrediction predicted = predict_tree_memory(count, build);
  const Tree tree = build_reference_tree(values.scene(scenario, count, context.settings.seed).spheres, build);

  // Many seeds. The grid of Scenario 1 has none.
  const std::int64_t wanted = context.settings.quick ? kQuickSeeds : kSeeds;
  std::vector<double> bytes(static_cast<std::size_t>(scenario_of(scenario) == Scenario::grid ? 1 : wanted));
  parallel_for(context.settings.threads, static_cast<std::int64_t>(bytes.size()), [&](std::int64_t i) {
    if (context.cancel.cancelled()) return;
    const SphereSet set = values.scene(scenario, count, static_cast<std::uint64_t>(i + 1)).spheres;
    bytes[static_cast<std::size_t>(i)] = counted_bytes(values, build_reference_tree(set, build), count);
  });
  const Spread spread = spread_of(bytes);
  const auto range = [](const MemoryPrediction::Range& of) { return Json{of.low, of.high}; };
  return {{"scenario", scenario},
          {"spheres", count},
          {"max_prims", max_prims},
          {"predicted_compact_bytes", range(predicted.compact_bytes)},
          {"predicted_allocated_bytes", range(predicted.allocated_bytes)},
          {"compact_bytes", counted_bytes(values, tree, count)},
          {"allocated_bytes", tree.allocated_bytes()},
          {"depth_avg", tree_statistics(tree).depth.avg},
          {"seeds", bytes.size()},
          {"mean", spread.mean},
          {"sd", spread.sd}};
}

Json measure_scenario(const StepContext& context, std::int64_t scenario) {
  Json trees = Json::array();
  for (const std::int64_t count : context.values.integers("spheres_list"))
    for (const std::int64_t max_prims : context.values.integers("max_prims_list")) {
      if (context.cancel.cancelled()) return {};
      trees.push_back(measure_tree(context, scenario, count, max_prims));
    }
  return trees;
}

// Trees of this section's radius and of section E's, in all scenarios: nodes, overlaps, and whether they are right.
Json compare_radii(const StepContext& context) {
  const Values& values = context.values;
  Json rows = Json::array();
  for (const std::int64_t scenario : values.integers("scenarios"))
    for (const char* const radius : {"radius", "other_radius"}) {
      const ScenarioParameters parameters{values.integers("spheres_list").back(),
                                          static_cast<float>(values.number(radius)), context.settings.seed};
      const SphereSet spheres = cli::value_or_fail(scenario_spheres(scenario_of(scenario), parameters));
      const Tree tree = build_reference_tree(spheres, {values.integers("max_prims_list").front(), kUnlimited});
      const TreeStatistics statistics = tree_statistics(tree);
      std::int64_t splits = 0, overlaps = 0;
      for (const Node& node : tree.nodes) {
        if (node.is_leaf() || node.kind != NodeKind::split) continue;
        ++splits;
        overlaps += node.left_clip > node.right_clip ? 1 : 0;
      }
      rows.push_back({{"scenario", scenario},
                      {"radius", values.number(radius)},
                      {"inner_nodes", statistics.inner_nodes},
                      {"leaves", statistics.leaves},
                      {"bytes", counted_bytes(values, tree, parameters.count)},
                      {"overlap_percent", 100.0 * static_cast<double>(overlaps) / std::max<double>(1, splits)},
                      {"right", static_cast<bool>(validate_tree(tree, spheres))}});
      if (context.cancel.cancelled()) return {};
    }
  return rows;
}

std::vector<Step> steps_of(const Settings& settings, const Values& values) {
  std::vector<Step> steps;
  for (const std::int64_t scenario : values.integers("scenarios"))
    steps.push_back({step_name(scenario), settings.quick ? 0.5 : 2,
                     [scenario](StepContext& context) { return measure_scenario(context, scenario); }});
  steps.push_back({kRadiusStep, 0.3, compare_radii});
  return steps;
}

// As in the thesis: one series for each MAX_PRIMS over the numbers of spheres.
void draw_chart(const DataContext& context, std::int64_t scenario, const Json& trees) {
  ChartData data{fmt::format("Scenario {}: memory by the text's rule", scenario), "spheres", "kB", {}, {}, false};
  for (const std::int64_t count : context.values.integers("spheres_list"))
    data.categories.push_back(std::to_string(count));
  for (const std::int64_t max_prims : context.values.integers("max_prims_list")) {
    Series series{fmt::format("MAX_PRIMS {}", max_prims), {}};
    for (const Json& tree : trees)
      if (tree["max_prims"] == max_prims) series.values.push_back(tree["compact_bytes"].get<double>() / 1000);
    data.series.push_back(std::move(series));
  }
  const std::string file = fmt::format("{}/scenario{}.svg", context.folder, scenario);
  if (const Status status = write_file(file, bar_chart(data)); !status) cli::fail(status.error());
}

Json data_of(const DataContext& context) {
  // How often memory or depth grows, or stays equal, from one MAX_PRIMS to the next.
  Json data = Json::object();
  std::int64_t rises = 0, not_shallower = 0, missed = 0;
  for (const std::int64_t scenario : context.values.integers("scenarios")) {
    const Json* const trees = context.result(step_name(scenario));
    if (trees == nullptr) continue;
    draw_chart(context, scenario, *trees);
    const Json* before = nullptr;
    for (const Json& tree : *trees) {
      if (before != nullptr && (*before)["spheres"] == tree["spheres"]) {
        rises += tree["mean"] >= (*before)["mean"] ? 1 : 0;
        not_shallower += tree["depth_avg"] >= (*before)["depth_avg"] ? 1 : 0;
      }
      before = &tree;
      for (const char* const bytes : {"compact_bytes", "allocated_bytes"}) {
        const Json& range = tree[std::string("predicted_") + bytes];
        missed += tree[bytes] >= range[0] && tree[bytes] <= range[1] ? 0 : 1;
      }
      data["trees"].push_back(tree);
    }
  }
  if (data.contains("trees")) {
    data["not_shallower"] = not_shallower;
    data["rises_with_max_prims"] = rises;
    data["missed_predictions"] = missed;
  }
  if (const Json* const radii = context.result(kRadiusStep)) {
    std::int64_t wrong = 0;
    double most = 0;
    for (std::size_t i = 0; i + 1 < radii->size(); i += 2) {
      const auto share = [&](std::size_t at) { return (*radii)[at]["overlap_percent"].get<double>(); };
      most = std::max(most, share(i + 1) - share(i));
    }
    for (const Json& row : *radii) wrong += row["right"].get<bool>() ? 0 : 1;
    data["radii"] = *radii;
    data["overlap_growth_percent"] = most;
    data["wrong_trees"] = wrong;
  }
  return data;
}

}  // namespace

ExperimentCode figure_4_5() {
  return {steps_of, data_of};
}

}  // namespace bihive::thesis
