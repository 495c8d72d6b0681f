// Table 4.2: the trees of three scenarios with small and with large leaves, for one seed and for many.
#include <fmt/format.h>

#include <algorithm>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "statistics.h"

namespace bihive::thesis {
namespace {

// The seeds 1, 2, ... for mean and standard deviation.
constexpr std::int64_t kSeeds = 400, kQuickSeeds = 40;
// The number of means. The mean of the thesis's rounds is taken this often; the median of the means tolerates other
// work on the machine.
constexpr int kBuildMeans = 101, kQuickBuildMeans = 21;

// Scenario and MAX_PRIMS of a column of the table.
struct Column {
  std::int64_t scenario, max_prims;
  std::string name(const char* format) const { return fmt::format(fmt::runtime(format), scenario, max_prims); }
  std::string step() const { return name("scenario{}-max_prims{}"); }
  std::string value() const { return name("scenario{}.max_prims{}"); }
  std::string words() const { return name("Scenario {}, MAX_PRIMS {}"); }
};
std::vector<Column> columns_of(const Values& values) {
  std::vector<Column> columns;
  for (const std::int64_t scenario : values.integers("scenarios"))
    for (const std::int64_t max_prims : values.integers("max_prims_list")) columns.push_back({scenario, max_prims});
  return columns;
}

SphereSet spheres_of(const Values& values, std::int64_t scenario, std::uint64_t seed) {
  return values.scene(scenario, values.integer("spheres"), seed).spheres;
}

// The table's rows, by the names of their values; shares are percent of all leaves.
Json rows_of(const TreeStatistics& tree) {
  Json rows{{"inner_nodes", tree.inner_nodes}, {"leaves", tree.leaves}};
  for (const auto& [name, of] : {std::pair{"spheres_per_leaf_", tree.spheres_per_leaf}, {"depth_", tree.depth}}) {
    rows[std::string(name) + "min"] = of.min;
    rows[std::string(name) + "avg"] = of.avg;
    rows[std::string(name) + "max"] = of.max;
  }
  constexpr const char* kShares[] = {"0", "1", "2", "3", "4", "more"};
  for (std::size_t n = 0; n < tree.leaves_with.size(); ++n)
    rows[std::string("share_with_") + kShares[n]] =
        100 * static_cast<double>(tree.leaves_with[n]) / static_cast<double>(tree.leaves);
  rows["optimized_nodes"] = tree.optimized_nodes;
  return rows;
}

// {"rows": {row: {"mean", "sd", "this"}}, "seeds", "nodes": of each seed}
Json count_trees(const Experiment& experiment, const Column& column) {
  const Values& values = experiment.values;
  const BuildParameters build{column.max_prims, values.limit("max_depth")};
  const auto statistics = [&](std::uint64_t seed) {
    return rows_of(tree_statistics(build_reference_tree(spheres_of(values, column.scenario, seed), build)));
  };
  const std::vector<Json> trees =
      over_seeds(experiment, column.scenario, experiment.settings.quick ? kQuickSeeds : kSeeds, statistics);
  Json result{{"seeds", trees.size()}};
  const Json this_seed = statistics(experiment.settings.seed);
  for (const auto& [row, ours] : this_seed.items()) {
    std::vector<double> sample;
    for (const Json& tree : trees) sample.push_back(tree[row]);
    result["rows"][row] = mean_and_sd_json(sample);
    result["rows"][row]["this"] = ours.get<double>();
  }
  for (const Json& tree : trees)
    result["nodes"].push_back(tree["inner_nodes"].get<std::int64_t>() + tree["leaves"].get<std::int64_t>());
  return result;
}

// All columns in turn: {column: [mean milliseconds of a build]}.
Json time_builds(const Experiment& experiment) {
  const Values& values = experiment.values;
  const std::int64_t rounds = values.integer("rounds");
  if (rounds < 1) fail_value("rounds", "expected at least 1");
  Contestants contestants;
  for (const Column& column : columns_of(values))
    contestants.emplace_back(column.words(), [&values, rounds, column,
                                              spheres = spheres_of(values, column.scenario, experiment.settings.seed)] {
      for (std::int64_t round = 0; round < rounds; ++round)
        build_reference_tree(spheres, {column.max_prims, values.limit("max_depth")});
    });
  Json means = times_in_turns(experiment, experiment.settings.quick ? kQuickBuildMeans : kBuildMeans, contestants);
  for (Json& column : means)
    for (Json& ms : column) ms = ms.get<double>() / static_cast<double>(rounds);
  return means;
}

// One level less after the other, down to the root alone.
Json remove_levels(const Experiment& experiment) {
  const Values& values = experiment.values;
  const SphereSet spheres = spheres_of(values, values.integer("balanced.scenario"), experiment.settings.seed);
  BuildParameters build{values.integers("max_prims_list").front(), kUnlimited};
  Json levels = Json::array();
  build.max_depth = tree_statistics(build_reference_tree(spheres, build)).depth.max;
  for (; build.max_depth >= 1; --build.max_depth) {
    const TreeStatistics s = tree_statistics(build_reference_tree(spheres, build));
    levels.push_back({{"max_depth", build.max_depth},
                      {"min", s.spheres_per_leaf.min},
                      {"max", s.spheres_per_leaf.max},
                      {"even", s.spheres_per_leaf.min == s.spheres_per_leaf.max && s.depth.min == s.depth.max}});
  }
  return levels;
}

// How many percent lower each of the later numbers is.
std::vector<double> percent_saved(const std::vector<double>& before, const std::vector<double>& after) {
  std::vector<double> percent = ratios_of(after, before);
  for (double& each : percent) each = 100 * (1 - each);
  return percent;
}

class TableData {
 public:
  explicit TableData(const Experiment& experiment)
      : experiment_(experiment),
        values_(experiment.values),
        columns_(columns_of(values_)),
        scenarios_(values_.integers("scenarios")),
        max_prims_(values_.integers("max_prims_list")) {}

  Json all() {
    add_columns();
    if (std::all_of(columns_.begin(), columns_.end(), [this](const Column& each) { return result(each) != nullptr; })) {
      add_reductions();
      add_sizes();
      add_contradictions();
    }
    if (const Json* const means = experiment_.result("build_times")) add_builds(*means);
    if (const Json* const levels = experiment_.result("levels")) add_levels(*levels);
    if (const Json* const reasons = experiment_.result("reasons")) {
      data_["reasons"] = *reasons;
      for (const Json& row : *reasons)
        if (row["max_prims"] == max_prims_.front())
          for (const char* const what : {"overlap_percent", "void_percent"})
            data_[what][row["scenario"].dump()] = row[what];
    }
    return std::move(data_);
  }

 private:
  const Json* result(const Column& column) const { return experiment_.result(column.step()); }
  double mean(const Column& column, const char* row) const { return result(column)->at("rows")[row]["mean"]; }

  // The means by column; and for the report row by row, the printed numbers with ours below.
  void add_columns() {
    for (const Column& column : columns_)
      if (const Json* const counted = result(column)) {
        const Json& rows = counted->at("rows");
        data_[fmt::format("scenario{}", column.scenario)][fmt::format("max_prims{}", column.max_prims)] = rows;
        data_["seeds"] = std::max(data_.value("seeds", std::int64_t{0}), counted->at("seeds").get<std::int64_t>());
        for (const auto& [key, ours] : rows.items()) {
          const std::string value = column.value() + "." + key;
          if (!values_.has(value)) continue;
          const std::string printed = values_.printed(value);
          const int decimals = printed.find('.') != std::string::npos ? 2 : 1;
          table_[key].push_back({{"column", column.words()},
                                 {"printed", printed},
                                 {"mean", fmt::format("{:.{}f}", ours["mean"].get<double>(), decimals)},
                                 {"sd", fmt::format("{:.2g}", ours["sd"].get<double>())}});
        }
      }
    const Json labels = values_.document().value("rows", Json::object());
    for (const auto& [key, cells] : table_.items())
      data_["table"].push_back({{"label", labels.value(key, key)}, {"cells", cells}});
  }

  void add_reductions() {
    for (const std::int64_t scenario : scenarios_) {
      const auto nodes = [&](std::int64_t max_prims) { return result({scenario, max_prims})->at("nodes"); };
      const Json saved = mean_and_sd_json(percent_saved(nodes(max_prims_.front()), nodes(max_prims_.back())));
      data_["reduction_percent"][fmt::format("scenario{}", scenario)] = saved;
      data_["reduction_order"][std::to_string(scenario)] = saved["mean"];
    }
  }

  // The MAX_PRIMS whose tree is ahead in each scenario; 0 if none is.
  template <class Of>
  std::int64_t ahead_everywhere(const Of& of) const {
    for (const std::int64_t prims : max_prims_)
      if (std::all_of(columns_.begin(), columns_.end(), [&](const Column& other) {
            return other.max_prims == prims || of(Column{other.scenario, prims}) > of(other);
          }))
        return prims;
    return 0;
  }

  void add_sizes() {
    const std::int64_t none = values_.integer("none_optimized.scenario");
    double most = 0, optimized = 0;
    for (const Column& column : columns_) {
      const double here = mean(column, "optimized_nodes");
      data_["most_optimized"][column.words()] = here;
      if (column.scenario == none) optimized += here;
      if (column.max_prims == max_prims_.front()) most = std::max(most, mean(column, "spheres_per_leaf_max"));
    }
    data_["leaf_each"] = most;
    data_["none_optimized"] = optimized;
    data_["largest_trees"] =
        ahead_everywhere([this](const Column& of) { return mean(of, "inner_nodes") + mean(of, "leaves"); });
    data_["shallower"] = ahead_everywhere([this](const Column& of) { return -mean(of, "depth_avg"); });
  }

  // A tree has an empty leaf exactly when its smallest leaf has 0 spheres; the text's columns say both.
  void add_contradictions() {
    data_["contradictions"] = std::count_if(columns_.begin(), columns_.end(), [this](const Column& column) {
      return (values_.number(column.value() + ".spheres_per_leaf_min") == 0) !=
             (values_.number(column.value() + ".share_with_0") > 0);
    });
  }

  void add_builds(const Json& means) {
    const auto of = [&](const Column& column) { return means.at(column.words()).get<std::vector<double>>(); };
    for (const Column& column : columns_) {
      const Json ours = data_["build"]["ms"][column.words()] = quartiles_json(of(column));
      const double stated = values_.number("build_ms." + column.value());
      Json row{{"scenario", column.scenario}, {"max_prims", column.max_prims}, {"stated", stated}};
      row.update(ours);
      row["ratio"] = ours["median"].get<double>() / stated;
      data_["build"]["rows"].push_back(std::move(row));
    }
    // Round by round: the share of the first configuration's time that the last saves, and the speed-up.
    double least = 1e9;
    for (const std::int64_t scenario : scenarios_) {
      const std::vector<double> first = of({scenario, max_prims_.front()}), last = of({scenario, max_prims_.back()});
      data_["build"]["gain_percent"][std::to_string(scenario)] = quartiles_json(percent_saved(first, last));
      const Json speed_up = quartiles_json(ratios_of(first, last));
      if (speed_up["median"] > least) continue;
      least = speed_up["median"];
      data_["build"]["least_speed_up"] = speed_up;
    }
  }

  void add_levels(const Json& levels) {
    data_["levels"] = levels;
    std::int64_t uneven = 0;
    double factor = 0;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      uneven += levels[i]["even"] == false;
      if (i == 0) continue;
      const double here = levels[i]["max"].get<double>() / levels[i - 1]["max"].get<double>();
      factor = i == 1 || factor == here ? here : -1;
    }
    data_["level_removed"] = {{"factor", factor}};
    data_["uneven_levels"] = uneven;
  }

  const Experiment& experiment_;
  const Values& values_;
  const std::vector<Column> columns_;
  const std::vector<std::int64_t> scenarios_, max_prims_;
  Json data_ = Json::object(), table_ = Json::object();
};

}  // namespace

void table_4_2(Experiment& experiment) {
  for (const Column& column : columns_of(experiment.values)) {
    const bool grid = scenario_of(column.scenario) == Scenario::grid;
    experiment.add(column.step(), grid ? 0.1 : 0.3, grid ? 0.1 : 2, count_trees, column);
  }
  experiment.add("build_times", 0.5, 2.5, time_builds);
  experiment.add("levels", 0.1, 0.1, remove_levels);
  experiment.add("reasons", 0.5, 0.5, [](const Experiment& of) {
    return measure_reasons(of, {of.values.integer("spheres")}, of.values.integers("max_prims_list"),
                           of.settings.quick ? 3 : 20);
  });
  experiment.make_data = [](const Experiment& counted) { return TableData(counted).all(); };
}

}  // namespace bihive::thesis
