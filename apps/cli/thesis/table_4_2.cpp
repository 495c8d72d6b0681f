// Table 4.2: the trees of three scenarios with small and with large leaves, for one seed and for many.
#include "thesis/table_4_2.h"

#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/scene/generators.h"
#include "support/failure.h"
#include "thesis/tree_reasons.h"

namespace bihive::cli::thesis {
namespace {

// The seeds 1, 2, ... for mean and standard deviation.
constexpr std::int64_t kSeeds = 400;
constexpr std::int64_t kQuickSeeds = 40;
// The number of means. The mean of the thesis's rounds is taken this often; the median of the means tolerates other
// work on the machine.
constexpr int kBuildMeans = 101;
constexpr int kQuickBuildMeans = 21;

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

  // Combine the results.
  Json rows, mean, sd, nodes_of_seeds = Json::array();
  std::int64_t disagree = 0;
  const Rows our_rows = rows_of(ours);
  for (std::size_t row = 0; row < kTreeRows.size(); ++row) {
    std::vector<double> sample;
    sample.reserve(trees.size());
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
          {"nodes_of_seeds", nodes_of_seeds}};
}

// All columns in turn, many times, so that a machine that slows down meanwhile favours none.
Json build_times_result(StepContext& context) {
  const Values& values = context.values;
  const std::int64_t rounds = values.integer("rounds");
  if (rounds < 1) fail({"/values/rounds: expected at least 1", "values.json", 0, 0, ""});
  struct Build {
    std::string name;
    SphereSet spheres;
    BuildParameters parameters;
  };
  std::vector<Build> builds;
  for (const std::int64_t scenario : values.integers("scenarios"))
    for (const std::int64_t max_prims : values.integers("max_prims_list")) {
      const Subject subject = subject_of(values, scenario, max_prims, context.settings.seed);
      builds.push_back({tree_step(scenario, max_prims),
                        value_or_fail(scenario_spheres(subject.scenario, subject.parameters)), subject.build});
    }

  // The first turn warms everything up and does not count.
  Json means = Json::object();
  const int turns = context.settings.quick ? kQuickBuildMeans : kBuildMeans;
  for (int turn = -1; turn < turns && !context.cancel.cancelled(); ++turn)
    for (const Build& build : builds) {
      std::vector<double> each;
      for (std::int64_t round = 0; round < rounds; ++round) {
        const Timer timer;
        const Tree tree = build_reference_tree(build.spheres, build.parameters);
        each.push_back(timer.elapsed_ms());
      }
      if (turn >= 0) means[build.name].push_back(spread_of(each).mean);
    }
  return means;
}

// One level less after the other, down to the root alone.
Json levels_result(StepContext& context) {
  const std::int64_t max_prims = context.values.integers("max_prims_list").front();
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

Json reasons_result(StepContext& context) {
  const Values& values = context.values;
  ReasonTrees trees;
  trees.scenarios = values.integers("scenarios");
  trees.spheres = {values.integer("spheres")};
  trees.max_prims = values.integers("max_prims_list");
  trees.radius = values.number("radius");
  trees.seeds = context.settings.quick ? 3 : 20;
  return measure_reasons(context, trees);
}

std::vector<Step> table_4_2_steps(const Settings& settings, const Values& values) {
  // Measured seconds: a tree of Scenario 1 once, the others for each seed.
  const double seconds = settings.quick ? 0.3 : 2;
  std::vector<Step> steps;
  for (const std::int64_t scenario : values.integers("scenarios"))
    for (const std::int64_t max_prims : values.integers("max_prims_list"))
      steps.push_back({tree_step(scenario, max_prims), scenario_of(scenario) == Scenario::grid ? 0.1 : seconds,
                       [=](StepContext& context) { return tree_result(context, scenario, max_prims); }});
  steps.push_back({kBuildTimesStep, settings.quick ? 0.5 : 2.5, build_times_result});
  steps.push_back({kLevelsStep, 0.1, levels_result});
  steps.push_back({kReasonsStep, 0.5, reasons_result});
  return steps;
}

}  // namespace

Experiment table_4_2() {
  return {"table-4.2", "Table 4.2: statistics of the trees", table_4_2_steps, table_4_2_section};
}

}  // namespace bihive::cli::thesis
