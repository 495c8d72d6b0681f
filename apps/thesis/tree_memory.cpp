// Figure 4.5: the memory of the tree, predicted, counted by the text's rule, and as this program allocates it.
#include <fmt/format.h>

#include <algorithm>

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

double counted_bytes(const Values& values, const Tree& tree) {
  const TreeStatistics s = tree_statistics(tree);
  return values.number("node_bytes") * static_cast<double>(s.inner_nodes + s.leaves) +
         values.number("index_bytes") * static_cast<double>(s.spheres) + values.number("aabb_bytes");
}

Json measure_tree(const Experiment& experiment, std::int64_t scenario, std::int64_t count, std::int64_t max_prims) {
  const Values& values = experiment.values;
  const BuildParameters build{max_prims, values.limit("max_depth")};
  const MemoryPrediction predicted = predict_tree_memory(count, build);
  const auto tree_of = [&](std::uint64_t seed) {
    return build_reference_tree(values.scene(scenario, count, seed).spheres, build);
  };
  const Tree tree = tree_of(experiment.settings.seed);
  const std::vector<double> bytes =
      over_seeds(experiment, scenario, experiment.settings.quick ? kQuickSeeds : kSeeds,
                 [&](std::uint64_t seed) { return counted_bytes(values, tree_of(seed)); });
  const auto range = [](const MemoryPrediction::Range& of) { return Json{of.low, of.high}; };
  return {{"scenario", scenario},
          {"spheres", count},
          {"max_prims", max_prims},
          {"predicted_compact_bytes", range(predicted.compact_bytes)},
          {"predicted_allocated_bytes", range(predicted.allocated_bytes)},
          {"compact_bytes", counted_bytes(values, tree)},
          {"allocated_bytes", tree.allocated_bytes()},
          {"depth_avg", tree_statistics(tree).depth.avg},
          {"seeds", bytes.size()},
          {"mean", mean_and_sd(bytes).mean},
          {"sd", mean_and_sd(bytes).sd}};
}

Json measure_scenario(const Experiment& experiment, std::int64_t scenario) {
  Json trees = Json::array();
  for (const std::int64_t count : experiment.values.integers("spheres_list"))
    for (const std::int64_t max_prims : experiment.values.integers("max_prims_list")) {
      if (experiment.cancel.cancelled()) return {};
      trees.push_back(measure_tree(experiment, scenario, count, max_prims));
    }
  return trees;
}

// Trees of this section's radius and of section E's, in all scenarios: nodes, overlaps, and whether they are right.
Json compare_radii(const Experiment& experiment) {
  const Values& values = experiment.values;
  Json rows = Json::array();
  for (const std::int64_t scenario : values.integers("scenarios"))
    for (const char* const radius : {"radius", "other_radius"}) {
      const ScenarioParameters parameters{values.integers("spheres_list").back(),
                                          static_cast<float>(values.number(radius)), experiment.settings.seed};
      const SphereSet spheres = value_or_fail(scenario_spheres(scenario_of(scenario), parameters));
      const Tree tree = build_reference_tree(spheres, {values.integers("max_prims_list").front(), kUnlimited});
      const TreeStatistics statistics = tree_statistics(tree);
      rows.push_back({{"scenario", scenario},
                      {"radius", values.number(radius)},
                      {"inner_nodes", statistics.inner_nodes},
                      {"leaves", statistics.leaves},
                      {"bytes", counted_bytes(values, tree)},
                      {"overlap_percent", overlap_percent(tree)},
                      {"right", static_cast<bool>(validate_tree(tree, spheres))}});
      if (experiment.cancel.cancelled()) return {};
    }
  return rows;
}

// As in the thesis: one series for each MAX_PRIMS over the numbers of spheres.
void draw_chart(const Experiment& experiment, const std::string& name, const Json& trees) {
  const std::int64_t scenario = trees[0]["scenario"];
  ChartData chart{fmt::format("Scenario {}: memory by the text's rule", scenario), "spheres", "kB", {}, {}, false};
  for (const std::int64_t count : experiment.values.integers("spheres_list"))
    chart.categories.push_back(std::to_string(count));
  for (const std::int64_t max_prims : experiment.values.integers("max_prims_list")) {
    Series& series = chart.series.emplace_back(Series{fmt::format("MAX_PRIMS {}", max_prims), {}});
    for (const Json& tree : trees)
      if (tree["max_prims"] == max_prims) series.values.push_back(tree["compact_bytes"].get<double>() / 1000);
  }
  value_or_fail(write_file(experiment.folder + "/" + name + ".svg", bar_chart(chart)));
}

// How often memory or depth grows, or stays equal, from one MAX_PRIMS to the next; predictions that do not hold.
void add_trees(const Experiment& experiment, const std::string& name, const Json& trees, Json& data) {
  draw_chart(experiment, name, trees);
  std::int64_t rises = data.value("rises_with_max_prims", 0), not_shallower = data.value("not_shallower", 0),
               missed = data.value("missed_predictions", 0);
  for (std::size_t i = 0; i < trees.size(); ++i) {
    const Json& tree = trees[i];
    data["trees"].push_back(tree);
    for (const std::string bytes : {"compact_bytes", "allocated_bytes"}) {
      const Json& range = tree["predicted_" + bytes];
      missed += tree[bytes] < range[0] || tree[bytes] > range[1];
    }
    if (i == 0 || trees[i - 1]["spheres"] != tree["spheres"]) continue;
    rises += tree["mean"] >= trees[i - 1]["mean"];
    not_shallower += tree["depth_avg"] >= trees[i - 1]["depth_avg"];
  }
  data["not_shallower"] = not_shallower;
  data["rises_with_max_prims"] = rises;
  data["missed_predictions"] = missed;
}

void add_radii(const Json& radii, Json& data) {
  std::int64_t wrong = 0;
  double most = 0;
  for (std::size_t i = 0; i < radii.size(); ++i) {
    wrong += radii[i]["right"] == false;
    if (i % 2 == 0) continue;
    const double small = radii[i - 1]["overlap_percent"], large = radii[i]["overlap_percent"];
    most = std::max(most, large - small);
  }
  data["radii"] = radii;
  data["overlap_growth_percent"] = most;
  data["wrong_trees"] = wrong;
}

}  // namespace

void figure_4_5(Experiment& experiment) {
  for (const std::int64_t scenario : experiment.values.integers("scenarios"))
    experiment.add(fmt::format("scenario{}", scenario), 0.5, 2, measure_scenario, scenario);
  experiment.add("radius", 0.3, 0.3, compare_radii);
  experiment.make_data = [](const Experiment& measured) {
    Json data = Json::object();
    for (const auto& [name, result] : measured.finished())
      name == "radius" ? add_radii(*result, data) : add_trees(measured, name, *result, data);
    return data;
  };
}

}  // namespace bihive::thesis
