// Table 4.2: the trees of three scenarios with small and with large leaves, for one seed and for many.
#include "table_4_2.h"

#include <cmath>

#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/scene/generators.h"
#include "compare.h"
#include "failure.h"

namespace bihive::cli::thesis {
namespace {

// The seeds 1, 2, ... behind mean and standard deviation.
constexpr std::int64_t kSeeds = 400;
constexpr std::int64_t kQuickSeeds = 40;

using Rows = std::array<double, kTreeRows.size()>;

Rows rows_of(const TreeStatistics& s) {
  const auto number = [](std::int64_t value) { return static_cast<double>(value); };
  Rows rows{number(s.inner_nodes),
            number(s.leaves),
            number(s.spheres_per_leaf.min),
            s.spheres_per_leaf.avg,
            number(s.spheres_per_leaf.max),
            number(s.depth.min),
            s.depth.avg,
            number(s.depth.max)};
  for (std::size_t i = 0; i < s.leaves_with.size(); ++i)
    rows[8 + i] = 100 * number(s.leaves_with[i]) / number(s.leaves);
  rows[14] = number(s.optimized_nodes);
  return rows;
}

struct Subject {
  Scenario scenario;
  ScenarioParameters parameters;
  BuildParameters build;
};

Subject subject_of(const Values& values, std::int64_t scenario, std::int64_t max_prims, std::uint64_t seed) {
  return {scenario_of(scenario),
          {values.integer("spheres"), static_cast<float>(values.number("radius")), seed},
          build_parameters(max_prims, values.integer("max_depth"))};
}

TreeStatistics statistics_of(const Subject& subject, const SphereSet& spheres) {
  return tree_statistics(build_reference_tree(spheres, subject.build));
}

Json tree_result(StepContext& context, std::int64_t scenario, std::int64_t max_prims) {
  const Subject subject = subject_of(context.values, scenario, max_prims, context.settings.seed);
  const SphereSet spheres = value_or_fail(scenario_spheres(subject.scenario, subject.parameters));
  const TreeStatistics ours = statistics_of(subject, spheres);

  // Time the build while nothing else runs. The tree above has warmed everything up.
  Json build_ms = Json::array();
  for (std::int64_t round = 0; round < context.values.integer("rounds"); ++round) {
    const Timer timer;
    const Tree tree = build_reference_tree(spheres, subject.build);
    build_ms.push_back(timer.elapsed_ms());
  }

  // Many seeds. The grid of Scenario 1 has none.
  const std::int64_t wanted = context.settings.quick ? kQuickSeeds : kSeeds;
  const std::int64_t seeds = subject.scenario == Scenario::grid ? 1 : wanted;
  std::vector<TreeStatistics> trees(static_cast<std::size_t>(seeds));
  parallel_for(context.settings.threads, seeds, [&](std::int64_t i) {
    if (context.cancel.cancelled()) return;
    ScenarioParameters parameters = subject.parameters;
    parameters.seed = static_cast<std::uint64_t>(i + 1);
    trees[static_cast<std::size_t>(i)] = statistics_of(subject, *scenario_spheres(subject.scenario, parameters));
  });
  if (context.cancel.cancelled()) return {};

  // Put it together.
  Json rows, mean, sd, nodes_of_seeds = Json::array();
  std::int64_t disagree = 0;
  const Rows our_rows = rows_of(ours);
  for (std::size_t row = 0; row < kTreeRows.size(); ++row) {
    std::vector<double> sample;
    for (const TreeStatistics& tree : trees) sample.push_back(rows_of(tree)[row]);
    const Spread spread = spread_of(sample);
    rows[kTreeRows[row].key] = our_rows[row];
    mean[kTreeRows[row].key] = spread.mean;
    sd[kTreeRows[row].key] = spread.sd;
  }
  for (const TreeStatistics& tree : trees) {
    nodes_of_seeds.push_back(tree.inner_nodes + tree.leaves);
    disagree += (tree.spheres_per_leaf.min == 0) != (tree.leaves_with[0] > 0);
  }
  return {{"rows", rows},
          {"mean", mean},
          {"sd", sd},
          {"seeds", seeds},
          {"empty_leaves_disagree", disagree},
          {"nodes", ours.inner_nodes + ours.leaves},
          {"nodes_of_seeds", nodes_of_seeds},
          {"build_ms", build_ms}};
}

// One level less after another, down to the root alone.
Json levels_result(StepContext& context) {
  const std::int64_t max_prims = static_cast<std::int64_t>(context.values.numbers("max_prims_list").front());
  Subject subject =
      subject_of(context.values, context.values.integer("balanced.scenario"), max_prims, context.settings.seed);
  const SphereSet spheres = value_or_fail(scenario_spheres(subject.scenario, subject.parameters));
  Json levels = Json::array();
  for (std::int64_t depth = statistics_of(subject, spheres).depth.max; depth >= 1; --depth) {
    subject.build.max_depth = depth;
    const TreeStatistics s = statistics_of(subject, spheres);
    levels.push_back({{"max_depth", depth}, {"min", s.spheres_per_leaf.min}, {"max", s.spheres_per_leaf.max}});
  }
  return {{"levels", levels}};
}

std::vector<Step> table_4_2_steps(const Settings& settings, const Values& values) {
  // Seconds, as measured: a tree of Scenario 1 once, of the others for each seed.
  const double seconds = settings.quick ? 0.3 : 2;
  std::vector<Step> steps;
  for (const double scenario_number : values.numbers("scenarios"))
    for (const double max_prims_number : values.numbers("max_prims_list")) {
      const auto scenario = static_cast<std::int64_t>(scenario_number);
      const auto max_prims = static_cast<std::int64_t>(max_prims_number);
      steps.push_back({tree_step(scenario, max_prims), scenario_of(scenario) == Scenario::grid ? 0.1 : seconds,
                       [=](StepContext& context) { return tree_result(context, scenario, max_prims); }});
    }
  steps.push_back({kLevelsStep, 0.1, levels_result});
  return steps;
}

}  // namespace

Experiment table_4_2() {
  return {"table-4.2", "Table 4.2: statistics of the trees", table_4_2_steps, table_4_2_section};
}

}  // namespace bihive::cli::thesis
