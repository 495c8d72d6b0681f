// Table 4.2: the trees of three scenarios with small and with large leaves, for one seed and for many.
#include <fmt/format.h>

#include <algorithm>

#include "bihive/base/parallel.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "processor_time.h"
#include "statistics.h"
#include "tree_reasons.h"

namespace bihive::thesis {
namespace {

// The seeds 1, 2, ... for mean and standard deviation.
constexpr std::int64_t kSeeds = 400, kQuickSeeds = 40;
// The number of means. The mean of the thesis's rounds is taken this often; the median of the means tolerates other
// work on the machine.
constexpr int kBuildMeans = 101, kQuickBuildMeans = 21;
constexpr const char *kBuildTimesStep = "build_times", *kLevelsStep = "levels", *kReasonsStep = "reasons";

// The table's rows: the name of the value, the words, and the number; shares are percent of all leaves.
struct Row {
  const char *key, *label;
  double (*of)(const TreeStatistics& tree);
};
double share(const TreeStatistics& tree, std::size_t spheres) {
  return 100 * static_cast<double>(tree.leaves_with[spheres]) / static_cast<double>(tree.leaves);
}
constexpr Row kRows[] = {
    {"inner_nodes", "Inner nodes", [](const TreeStatistics& tree) { return double(tree.inner_nodes); }},
    {"leaves", "Leaves", [](const TreeStatistics& tree) { return double(tree.leaves); }},
    {"spheres_per_leaf_min", "Spheres per leaf, min",
     [](const TreeStatistics& tree) { return double(tree.spheres_per_leaf.min); }},
    {"spheres_per_leaf_avg", "Spheres per leaf, avg",
     [](const TreeStatistics& tree) { return tree.spheres_per_leaf.avg; }},
    {"spheres_per_leaf_max", "Spheres per leaf, max",
     [](const TreeStatistics& tree) { return double(tree.spheres_per_leaf.max); }},
    {"depth_min", "Depth, min", [](const TreeStatistics& tree) { return double(tree.depth.min); }},
    {"depth_avg", "Depth, avg", [](const TreeStatistics& tree) { return tree.depth.avg; }},
    {"depth_max", "Depth, max", [](const TreeStatistics& tree) { return double(tree.depth.max); }},
    {"share_with_0", "Leaves with N = 0, %", [](const TreeStatistics& tree) { return share(tree, 0); }},
    {"share_with_1", "Leaves with N = 1, %", [](const TreeStatistics& tree) { return share(tree, 1); }},
    {"share_with_2", "Leaves with N = 2, %", [](const TreeStatistics& tree) { return share(tree, 2); }},
    {"share_with_3", "Leaves with N = 3, %", [](const TreeStatistics& tree) { return share(tree, 3); }},
    {"share_with_4", "Leaves with N = 4, %", [](const TreeStatistics& tree) { return share(tree, 4); }},
    {"share_with_more", "Leaves with N > 4, %", [](const TreeStatistics& tree) { return share(tree, 5); }},
    {"optimized_nodes", "Optimized nodes", [](const TreeStatistics& tree) { return double(tree.optimized_nodes); }}};

SphereSet spheres_of(const Values& values, std::int64_t scenario, std::uint64_t seed) {
  return values.scene(scenario, values.integer("spheres"), seed).spheres;
}

std::string column_step(std::int64_t scenario, std::int64_t max_prims) {
  return fmt::format("scenario{}-max_prims{}", scenario, max_prims);
}
std::string key_of(std::int64_t scenario, std::int64_t max_prims) {
  return fmt::format("Scenario {}, MAX_PRIMS {}", scenario, max_prims);
}

// {"this": a number per row, "rows": {row: {"mean", "sd"}}, "nodes": of each seed}
Json count_trees(const StepContext& context, std::int64_t scenario, std::int64_t max_prims) {
  const Values& values = context.values;
  const BuildParameters build{max_prims, values.limit("max_depth")};
  const auto statistics = [&](std::uint64_t seed) {
    return tree_statistics(build_reference_tree(spheres_of(values, scenario, seed), build));
  };
  const TreeStatistics ours = statistics(context.settings.seed);

  // The grid of Scenario 1 has no chance in it.
  const std::int64_t wanted = context.settings.quick ? kQuickSeeds : kSeeds;
  std::vector<TreeStatistics> trees(static_cast<std::size_t>(scenario_of(scenario) == Scenario::grid ? 1 : wanted));
  parallel_for(context.settings.threads, static_cast<std::int64_t>(trees.size()), [&](std::int64_t i) {
    if (!context.cancel.cancelled()) trees[static_cast<std::size_t>(i)] = statistics(static_cast<std::uint64_t>(i + 1));
  });

  Json result{{"seeds", trees.size()}};
  for (const Row& row : kRows) {
    std::vector<double> sample;
    for (const TreeStatistics& tree : trees) sample.push_back(row.of(tree));
    result["rows"][row.key] = spread_of(sample).json();
    result["rows"][row.key]["this"] = row.of(ours);
  }
  for (const TreeStatistics& tree : trees) result["nodes"].push_back(tree.inner_nodes + tree.leaves);
  return result;
}

// All columns in turn, many times, so that a machine that slows down meanwhile favours none.
Json time_builds(const StepContext& context) {
  const Values& values = context.values;
  const std::int64_t rounds = values.integer("rounds");
  if (rounds < 1) cli::fail({"/values/rounds: expected at least 1", "values.json", 0, 0, ""});
  // The first turn warms everything up and does not count.
  Json means = Json::object();
  for (int turn = -1; turn < (context.settings.quick ? kQuickBuildMeans : kBuildMeans); ++turn)
    for (const std::int64_t scenario : values.integers("scenarios"))
      for (const std::int64_t max_prims : values.integers("max_prims_list")) {
        if (context.cancel.cancelled()) return {};
        const SphereSet spheres = spheres_of(values, scenario, context.settings.seed);
        const double before = thread_ms();
        for (std::int64_t round = 0; round < rounds; ++round)
          build_reference_tree(spheres, {max_prims, values.limit("max_depth")});
        if (turn >= 0)
          means[key_of(scenario, max_prims)].push_back((thread_ms() - before) / static_cast<double>(rounds));
      }
  return means;
}

// One level less after the other, down to the root alone.
Json remove_levels(const StepContext& context) {
  const SphereSet spheres =
      spheres_of(context.values, context.values.integer("balanced.scenario"), context.settings.seed);
  BuildParameters build{context.values.integers("max_prims_list").front(), kUnlimited};
  Json levels = Json::array();
  std::int64_t depth = tree_statistics(build_reference_tree(spheres, build)).depth.max;
  for (; depth >= 1; --depth) {
    build.max_depth = depth;
    const TreeStatistics s = tree_statistics(build_reference_tree(spheres, build));
    levels.push_back({{"max_depth", depth},
                      {"min", s.spheres_per_leaf.min},
                      {"max", s.spheres_per_leaf.max},
                      {"even", s.spheres_per_leaf.min == s.spheres_per_leaf.max && s.depth.min == s.depth.max}});
  }
  return levels;
}

std::vector<Step> steps_of(const Settings& settings, const Values& values) {
  std::vector<Step> steps;
  for (const std::int64_t scenario : values.integers("scenarios"))
    for (const std::int64_t max_prims : values.integers("max_prims_list"))
      steps.push_back({column_step(scenario, max_prims),
                       scenario_of(scenario) == Scenario::grid ? 0.1 : (settings.quick ? 0.3 : 2.0),
                       [=](StepContext& context) { return count_trees(context, scenario, max_prims); }});
  steps.push_back({kBuildTimesStep, settings.quick ? 0.5 : 2.5, time_builds});
  steps.push_back({kLevelsStep, 0.1, remove_levels});
  steps.push_back({kReasonsStep, 0.5, [](StepContext& context) {
                     const Values& of = context.values;
                     return measure_reasons(context, {of.integers("scenarios"),
                                                      {of.integer("spheres")},
                                                      of.integers("max_prims_list"),
                                                      context.settings.quick ? 3 : 20});
                   }});
  return steps;
}

class TableData {
 public:
  explicit TableData(const DataContext& context)
      : context_(context),
        values_(context.values),
        scenarios_(values_.integers("scenarios")),
        max_prims_(values_.integers("max_prims_list")) {}

  Json all() {
    bool complete = true;
    for (const std::int64_t scenario : scenarios_)
      for (const std::int64_t prims : max_prims_) complete = add_column(scenario, prims) && complete;
    add_rows();
    if (complete) {
      add_reductions();
      add_sizes();
      add_contradictions();
    }
    if (context_.result(kBuildTimesStep) != nullptr) add_builds();
    if (context_.result(kLevelsStep) != nullptr) add_levels();
    if (const Json* const reasons = context_.result(kReasonsStep)) {
      data_["reasons"] = *reasons;
      for (const Json& row : *reasons)
        if (row["max_prims"] == max_prims_.front())
          for (const char* const what : {"overlap_percent", "void_percent"})
            data_[what][row["scenario"].dump()] = row[what];
    }
    return std::move(data_);
  }

 private:
  const Json& spread(std::int64_t scenario, std::int64_t prims, const char* row) {
    return data_[fmt::format("scenario{}", scenario)][fmt::format("max_prims{}", prims)][row];
  }
  double mean(std::int64_t scenario, std::int64_t prims, const char* row) {
    return spread(scenario, prims, row)["mean"].get<double>();
  }

  bool add_column(std::int64_t scenario, std::int64_t prims) {
    const Json* const result = context_.result(column_step(scenario, prims));
    if (result == nullptr) return false;
    data_[fmt::format("scenario{}", scenario)][fmt::format("max_prims{}", prims)] = result->at("rows");
    data_["seeds"] = std::max(data_.value("seeds", std::int64_t{0}), result->at("seeds").get<std::int64_t>());
    return true;
  }

  // For the report: the printed numbers with ours below.
  void add_rows() {
    for (const auto& [key, label, of] : kRows) {
      Json row{{"label", label}, {"cells", Json::array()}};
      for (const std::int64_t scenario : scenarios_)
        for (const std::int64_t prims : max_prims_) {
          const std::string name = fmt::format("scenario{}.max_prims{}.{}", scenario, prims, key);
          if (context_.result(column_step(scenario, prims)) == nullptr || !values_.has(name)) continue;
          const Json& ours = spread(scenario, prims, key);
          row["cells"].push_back({{"column", fmt::format("Scenario {}, MAX_PRIMS {}", scenario, prims)},
                                  {"printed", values_.printed(name)},
                                  {"mean", fmt::format("{:.{}f}", ours["mean"].get<double>(),
                                                       print_rounding(values_.printed(name)) < 0.5 ? 2 : 1)},
                                  {"sd", fmt::format("{:.2g}", ours["sd"].get<double>())}});
        }
      data_["table"].push_back(std::move(row));
    }
  }

  void add_reductions() {
    for (const std::int64_t scenario : scenarios_) {
      const auto before = context_.result(column_step(scenario, max_prims_.front()))->at("nodes");
      const auto after = context_.result(column_step(scenario, max_prims_.back()))->at("nodes");
      std::vector<double> sample;
      for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i)
        sample.push_back(100 * (1 - after[i].get<double>() / before[i].get<double>()));
      data_["reduction_percent"][fmt::format("scenario{}", scenario)] = spread_of(sample).json();
      data_["reduction_order"][std::to_string(scenario)] = spread_of(sample).mean;
    }
  }

  // The MAX_PRIMS whose tree is ahead in each scenario; 0 if none is.
  template <class Of>
  std::int64_t ahead_everywhere(const Of& of) {
    for (const std::int64_t prims : max_prims_) {
      bool ahead = true;
      for (const std::int64_t scenario : scenarios_)
        for (const std::int64_t other : max_prims_)
          ahead = ahead && (other == prims || of(scenario, prims) > of(scenario, other));
      if (ahead) return prims;
    }
    return 0;
  }

  void add_sizes() {
    double most = 0;
    for (const std::int64_t scenario : scenarios_) {
      for (const std::int64_t prims : max_prims_)
        data_["most_optimized"][key_of(scenario, prims)] = mean(scenario, prims, "optimized_nodes");
      most = std::max(most, mean(scenario, max_prims_.front(), "spheres_per_leaf_max"));
    }
    data_["leaf_each"] = most;
    const std::int64_t none = values_.integer("none_optimized.scenario");
    double optimized = 0;
    for (const std::int64_t prims : max_prims_) optimized += mean(none, prims, "optimized_nodes");
    data_["none_optimized"] = optimized;
    data_["largest_trees"] = ahead_everywhere([this](std::int64_t scenario, std::int64_t prims) {
      return mean(scenario, prims, "inner_nodes") + mean(scenario, prims, "leaves");
    });
    data_["shallower"] = ahead_everywhere(
        [this](std::int64_t scenario, std::int64_t prims) { return -mean(scenario, prims, "depth_avg"); });
  }

  // A tree has an empty leaf exactly when its smallest leaf has 0 spheres; the text's columns say both.
  void add_contradictions() {
    std::int64_t contradictions = 0;
    for (const std::int64_t scenario : scenarios_)
      for (const std::int64_t prims : max_prims_) {
        const std::string name = fmt::format("scenario{}.max_prims{}", scenario, prims);
        const bool smallest_is_0 = values_.number(name + ".spheres_per_leaf_min") == 0;
        contradictions += smallest_is_0 != (values_.number(name + ".share_with_0") > 0) ? 1 : 0;
      }
    data_["contradictions"] = contradictions;
  }

  void add_builds() {
    const Json& means = *context_.result(kBuildTimesStep);
    const auto of = [&](std::int64_t scenario, std::int64_t prims) {
      return means.at(key_of(scenario, prims)).get<std::vector<double>>();
    };
    double least = 1e9;
    for (const std::int64_t scenario : scenarios_) {
      for (const std::int64_t prims : max_prims_) {
        const Json ours = data_["build"]["ms"][key_of(scenario, prims)] = quartiles_json(of(scenario, prims));
        const double stated = values_.number(fmt::format("build_ms.scenario{}.max_prims{}", scenario, prims));
        Json row{{"scenario", scenario}, {"max_prims", prims}, {"stated", stated}};
        row.update(ours);
        row["ratio"] = ours["median"].get<double>() / stated;
        data_["build"]["rows"].push_back(std::move(row));
      }
      // Seed by seed: the part of the first configuration's time that the last saves, and the speed-up.
      const std::vector<double> first = of(scenario, max_prims_.front()), last = of(scenario, max_prims_.back());
      std::vector<double> gains, speed_ups;
      for (std::size_t i = 0; i < std::min(first.size(), last.size()); ++i) {
        gains.push_back(100 * (1 - last[i] / first[i]));
        speed_ups.push_back(first[i] / last[i]);
      }
      data_["build"]["gain_percent"][std::to_string(scenario)] = quartiles_json(gains);
      if (median(speed_ups) > least) continue;
      least = median(speed_ups);
      data_["build"]["least_speed_up"] = quartiles_json(speed_ups);
    }
  }

  void add_levels() {
    const Json& levels = *context_.result(kLevelsStep);
    data_["levels"] = levels;
    std::int64_t uneven = 0;
    double factor = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      uneven += levels[i]["even"].get<bool>() ? 0 : 1;
      if (i == 0) continue;
      const double here = levels[i]["max"].get<double>() / levels[i - 1]["max"].get<double>();
      factor = i == 1 || factor == here ? here : -1;
    }
    data_["level_removed"] = {{"factor", factor}};
    data_["uneven_levels"] = uneven;
  }

  const DataContext& context_;
  const Values& values_;
  const std::vector<std::int64_t> scenarios_, max_prims_;
  Json data_ = Json::object();
};

}  // namespace

ExperimentCode table_4_2() {
  return {steps_of, [](const DataContext& context) { return TableData(context).all(); }};
}

}  // namespace bihive::thesis
