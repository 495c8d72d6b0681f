// Table 4.2 as the report shows it: the table itself, build times, reductions, and the text's statements about them.
#include <algorithm>
#include <cmath>
#include <functional>

#include "../messages.h"
#include "compare.h"
#include "table_4_2.h"

namespace bihive::cli::thesis {
namespace {

const char* const kInsideRule =
    "Agrees: the thesis's value lies within three standard deviations of our mean over the seeds, widened by half a "
    "unit of its last printed digit; where there is no deviation, it is equal as far as it is printed.";

// One of the table's columns with its results.
struct Column {
  std::int64_t scenario, max_prims;
  const Json* result;

  std::string name() const { return fmt::format("Scenario {}, MAX_PRIMS {}", scenario, max_prims); }
  double row(const char* key) const { return (*result)["rows"][key].get<double>(); }
  Spread spread(const char* key) const {
    return {(*result)["mean"][key].get<double>(), (*result)["sd"][key].get<double>()};
  }
  double build_ms() const { return spread_of((*result)["build_ms"].get<std::vector<double>>()).mean; }
};

std::string number_text(double value, int decimals) {
  if (decimals == 0) return grouped(std::llround(value));
  return fmt::format("{:.{}f}", value, decimals);
}

std::string spread_text(const Spread& spread, const TreeRow& row) {
  const char* const percent = row.share ? " %" : "";
  if (spread.sd == 0) return number_text(spread.mean, row.decimals) + percent;
  const int decimals = std::max(row.decimals, 1);
  return fmt::format("{:.{}f} ± {:.{}f}{}", spread.mean, decimals, spread.sd, decimals, percent);
}

class TableSection {
 public:
  explicit TableSection(const SectionContext& context) : context_(context), values_(context.values) {
    for (const double scenario : values_.numbers("scenarios"))
      for (const double max_prims : values_.numbers("max_prims_list")) {
        const auto s = static_cast<std::int64_t>(scenario), m = static_cast<std::int64_t>(max_prims);
        if (const auto found = context.results.find(tree_step(s, m)); found != context.results.end())
          columns_.push_back({s, m, &found->second});
      }
  }

  Section section() {
    if (columns_.empty()) return std::move(section_);
    describe();
    for (const double scenario : values_.numbers("scenarios")) add_scenario(static_cast<std::int64_t>(scenario));
    add_reductions();
    add_build_times();
    add_statements();
    return std::move(section_);
  }

 private:
  const Column* column(std::int64_t scenario, std::int64_t max_prims) const {
    for (const Column& column : columns_)
      if (column.scenario == scenario && column.max_prims == max_prims) return &column;
    return nullptr;
  }
  bool complete() const {
    return columns_.size() == values_.numbers("scenarios").size() * values_.numbers("max_prims_list").size();
  }
  std::int64_t first_prims() const { return static_cast<std::int64_t>(values_.numbers("max_prims_list").front()); }
  std::int64_t last_prims() const { return static_cast<std::int64_t>(values_.numbers("max_prims_list").back()); }

  void describe() {
    std::int64_t seeds = 0;
    for (const Column& column : columns_) seeds = std::max(seeds, (*column.result)["seeds"].get<std::int64_t>());
    section_.paragraphs.push_back(fmt::format(
        "{} spheres of radius {} in each scenario. \"This seed\" is seed {}; mean and standard deviation are over {} "
        "seeds. Scenario 1 has no chance in it: one tree, which must be the thesis's.",
        grouped(values_.integer("spheres")), values_.printed("radius"), context_.settings.seed, seeds));
    section_.data["seed"] = context_.settings.seed;
    section_.data["seeds"] = seeds;
    section_.data["values"] = Json::array();
  }

  // All rows of one scenario, four columns for each MAX_PRIMS.
  void add_scenario(std::int64_t scenario) {
    Table table{fmt::format("Scenario {}", scenario), {"Row"}, {}, kInsideRule};
    std::vector<const Column*> shown;
    for (const double max_prims : values_.numbers("max_prims_list"))
      if (const Column* found = column(scenario, static_cast<std::int64_t>(max_prims))) shown.push_back(found);
    if (shown.empty()) return;
    for (const Column* column : shown)
      for (const char* const what : {"thesis", "this seed", "mean ± sd", "inside 3 sd"})
        table.columns.push_back(fmt::format("MAX_PRIMS {}: {}", column->max_prims, what));
    for (const TreeRow& row : kTreeRows) {
      table.rows.push_back({{row.label}});
      for (const Column* column : shown) add_value(*column, row, table.rows.back());
    }
    section_.tables.push_back(std::move(table));
  }

  void add_value(const Column& column, const TreeRow& row, std::vector<Cell>& cells) {
    const std::string name = tree_value(column.scenario, column.max_prims) + "." + row.key;
    const double stated = values_.number(name), ours = column.row(row.key);
    const std::string printed = values_.printed(name);
    const Spread spread = column.spread(row.key);
    const Verdict verdict = verdict_if(inside_three_sd(stated, printed, spread));
    const std::string how = spread.sd > 0 ? fmt::format(" ({:+.1f} sd)", (stated - spread.mean) / spread.sd) : "";
    cells.push_back({printed});
    cells.push_back({number_text(ours, row.decimals) + (row.share ? " %" : "")});
    cells.push_back({spread_text(spread, row)});
    cells.push_back({(verdict == Verdict::agrees ? "yes" : "no") + how, verdict});
    section_.data["values"].push_back({{"name", name},
                                       {"scenario", column.scenario},
                                       {"max_prims", column.max_prims},
                                       {"row", row.key},
                                       {"thesis", stated},
                                       {"ours", ours},
                                       {"mean", spread.mean},
                                       {"sd", spread.sd},
                                       {"verdict", verdict_name(verdict)}});
  }

  // By how much the nodes shrink from the first MAX_PRIMS to the last, seed by seed.
  void add_reductions() {
    Table table{"Total number of nodes, from the first configuration to the second",
                {"Scenario", "thesis", "this seed", "mean ± sd", "inside 3 sd"},
                {},
                kInsideRule};
    section_.data["reductions"] = Json::array();
    for (const double number : values_.numbers("scenarios")) {
      const auto scenario = static_cast<std::int64_t>(number);
      const Column *first = column(scenario, first_prims()), *last = column(scenario, last_prims());
      if (!first || !last) continue;
      const auto shrunk = [](double before, double after) { return 100 * (1 - after / before); };
      const auto before = (*first->result)["nodes_of_seeds"].get<std::vector<double>>();
      const auto after = (*last->result)["nodes_of_seeds"].get<std::vector<double>>();
      std::vector<double> sample;
      for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i)
        sample.push_back(shrunk(before[i], after[i]));
      const double ours = shrunk((*first->result)["nodes"].get<double>(), (*last->result)["nodes"].get<double>());
      const Spread spread = spread_of(sample);
      const std::string name = fmt::format("reduction_percent.scenario{}", scenario);
      const Verdict verdict = verdict_if(inside_three_sd(values_.number(name), values_.printed(name), spread));
      table.rows.push_back({{fmt::format("{}", scenario)},
                            {values_.printed(name)},
                            {fmt::format("{:.2f} %", ours)},
                            {spread_text(spread, {"", "", 2, true})},
                            {verdict == Verdict::agrees ? "yes" : "no", verdict}});
      section_.data["reductions"].push_back({{"name", name},
                                             {"scenario", scenario},
                                             {"thesis", values_.number(name)},
                                             {"ours", ours},
                                             {"mean", spread.mean},
                                             {"sd", spread.sd},
                                             {"verdict", verdict_name(verdict)}});
      reductions_.push_back({scenario, spread.mean});
    }
    if (!table.rows.empty()) section_.tables.push_back(std::move(table));
  }

  void add_build_times() {
    Table table{fmt::format("Build time, mean of {} builds, in milliseconds", values_.printed("rounds")),
                {"Scenario", "MAX_PRIMS", "thesis", "ours", "fastest to slowest", "ours / thesis"},
                {},
                "No verdict: the machines are 2014's phone and this one. The statements below compare the order."};
    section_.data["build_ms"] = Json::array();
    for (const Column& column : columns_) {
      const std::string name = fmt::format("build_ms.{}", tree_value(column.scenario, column.max_prims));
      const auto rounds = (*column.result)["build_ms"].get<std::vector<double>>();
      const auto [least, most] = std::minmax_element(rounds.begin(), rounds.end());
      const double ours = column.build_ms(), ratio = ours / values_.number(name);
      table.rows.push_back({{fmt::format("{}", column.scenario)},
                            {fmt::format("{}", column.max_prims)},
                            {values_.printed(name)},
                            {fmt::format("{:.3f}", ours)},
                            {fmt::format("{:.3f} to {:.3f}", *least, *most)},
                            {fmt::format("{:.3f}", ratio)}});
      section_.data["build_ms"].push_back({{"name", name},
                                           {"scenario", column.scenario},
                                           {"max_prims", column.max_prims},
                                           {"thesis", values_.number(name)},
                                           {"ours", ours},
                                           {"rounds", rounds},
                                           {"ratio", ratio}});
    }
    section_.tables.push_back(std::move(table));
  }

  // What the text says about the table. A statement needs all that it speaks of.
  void add_statements() {
    Statements statements("What the text says about the table",
                          "Statements about numbers of nodes are compared with our means over the seeds, those about "
                          "time with the mean build times of this run.");
    if (complete()) {
      add_order(statements);
      add_optimized(statements);
      add_tree_sizes(statements);
      add_build_order(statements);
      add_contradictions(statements);
    }
    add_balance(statements);
    section_.data["statements"] = statements.data();
    if (!statements.empty()) section_.tables.push_back(statements.table());
  }

  void add_order(Statements& statements) {
    std::stable_sort(reductions_.begin(), reductions_.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    std::vector<double> order;
    for (const auto& [scenario, reduction] : reductions_) order.push_back(static_cast<double>(scenario));
    bool all = true;
    for (const auto& [scenario, reduction] : reductions_) all = all && reduction > 0;
    statements.add("reduction_order", "The nodes are reduced in all scenarios; biggest reduction first",
                   values_.printed("reduction_order"), fmt::format("{}", fmt::join(order, ", ")),
                   verdict_if(all && order == values_.numbers("reduction_order")));
  }

  // The column where something is largest (or smallest).
  const Column& extreme(const std::function<double(const Column&)>& of, bool largest) const {
    const Column* best = &columns_.front();
    for (const Column& column : columns_)
      if (largest ? of(column) > of(*best) : of(column) < of(*best)) best = &column;
    return *best;
  }

  void add_extreme(Statements& statements, const std::string& name, const std::string& statement, const Column& ours,
                   const std::string& what) {
    const std::int64_t scenario = values_.integer(name + ".scenario"), prims = values_.integer(name + ".max_prims");
    statements.add(name, statement, fmt::format("Scenario {}, MAX_PRIMS {}", scenario, prims),
                   ours.name() + " (" + what + ")", verdict_if(ours.scenario == scenario && ours.max_prims == prims));
  }

  void add_optimized(Statements& statements) {
    const auto optimized = [](const Column& column) { return column.spread("optimized_nodes").mean; };
    const Column& most = extreme(optimized, true);
    add_extreme(statements, "most_optimized", "The most optimized nodes", most, fmt::format("{:.0f}", optimized(most)));
    const std::int64_t none = values_.integer("none_optimized.scenario");
    double found = 0;
    for (const Column& column : columns_)
      if (column.scenario == none) found += optimized(column);
    statements.add("none_optimized", fmt::format("Scenario {} has no optimized node in both configurations", none), "0",
                   fmt::format("{:.0f}", found), verdict_if(found == 0));
  }

  void add_tree_sizes(Statements& statements) {
    // Which configuration makes the larger, and which the shallower trees, in every scenario?
    const auto everywhere = [this](std::int64_t max_prims,
                                   const std::function<bool(const Column&, const Column&)>& better) {
      return std::all_of(columns_.begin(), columns_.end(), [&](const Column& other) {
        const Column* one = column(other.scenario, max_prims);
        return one && (other.max_prims == max_prims || better(*one, other));
      });
    };
    const std::int64_t large = values_.integer("largest_trees.max_prims");
    const bool larger = everywhere(large, [](const Column& a, const Column& b) {
      return a.spread("inner_nodes").mean + a.spread("leaves").mean >
                 b.spread("inner_nodes").mean + b.spread("leaves").mean &&
             a.spread("depth_avg").mean > b.spread("depth_avg").mean;
    });
    statements.add("largest_trees", "The first test makes the most complex and memory intensive trees",
                   fmt::format("MAX_PRIMS {}", large), larger ? "so in each scenario" : "not in each scenario",
                   verdict_if(larger));
    const std::int64_t small = values_.integer("shallower.max_prims");
    const bool shallower = everywhere(small, [](const Column& a, const Column& b) {
      return a.spread("depth_avg").mean < b.spread("depth_avg").mean && a.build_ms() < b.build_ms();
    });
    statements.add("shallower", "A higher MAX_PRIMS makes the tree shallower and thereby decreases the build time",
                   fmt::format("MAX_PRIMS {}", small), shallower ? "so in each scenario" : "not in each scenario",
                   verdict_if(shallower));

    // A leaf for each sphere: coincident ones share a leaf, which the table shows too.
    const std::int64_t single = values_.integer("leaf_each.max_prims");
    std::vector<std::string> most;
    bool each = true;
    for (const Column& column : columns_)
      if (column.max_prims == single) {
        most.push_back(fmt::format("{:.0f}", column.spread("spheres_per_leaf_max").mean));
        each = each && column.spread("spheres_per_leaf_max").mean == values_.number("leaf_each.spheres_per_leaf");
      }
    statements.add("leaf_each", "The first test's trees have a leaf for each sphere; most spheres in a leaf",
                   values_.printed("leaf_each.spheres_per_leaf"),
                   fmt::format("{} in the scenarios: coincident spheres cannot be parted", fmt::join(most, ", ")),
                   verdict_if(each));
  }

  void add_build_order(Statements& statements) {
    const auto ms = [](const Column& column) { return column.build_ms(); };
    const Column &least = extreme(ms, false), &most = extreme(ms, true);
    add_extreme(statements, "shortest_build", "The shortest build time", least, fmt::format("{:.3f} ms", ms(least)));
    add_extreme(statements, "longest_build", "The longest build time", most, fmt::format("{:.3f} ms", ms(most)));

    // Relative gain: the share of the first configuration's time that the second saves.
    std::int64_t best = 0;
    double best_gain = 0;
    std::vector<std::string> gains, stated;
    for (const double number : values_.numbers("scenarios")) {
      const auto scenario = static_cast<std::int64_t>(number);
      const double gain = 1 - ms(*column(scenario, last_prims())) / ms(*column(scenario, first_prims()));
      const auto of_thesis = [&](std::int64_t max_prims) {
        return values_.number("build_ms." + tree_value(scenario, max_prims));
      };
      gains.push_back(fmt::format("{:.0f} %", 100 * gain));
      stated.push_back(fmt::format("{:.0f} %", 100 * (1 - of_thesis(last_prims()) / of_thesis(first_prims()))));
      if (best == 0 || gain > best_gain) {
        best = scenario;
        best_gain = gain;
      }
    }
    const std::int64_t claimed = values_.integer("best_build_gain.scenario");
    statements.add("best_build_gain", "The best relative improvement of the build time",
                   fmt::format("Scenario {} ({} by its table)", claimed, fmt::join(stated, ", ")),
                   fmt::format("Scenario {} ({})", best, fmt::join(gains, ", ")), verdict_if(best == claimed));
  }

  // A tree has an empty leaf exactly when its smallest leaf has 0 spheres.
  void add_contradictions(Statements& statements) {
    std::vector<std::string> found;
    std::int64_t ours = 0;
    for (const Column& column : columns_) {
      const std::string name = tree_value(column.scenario, column.max_prims);
      const std::string min = name + ".spheres_per_leaf_min", share = name + ".share_with_0";
      if ((values_.number(min) == 0) != (values_.number(share) > 0))
        found.push_back(
            fmt::format("{}: minimum {}, N = 0 in {}", column.name(), values_.printed(min), values_.printed(share)));
      ours += (*column.result)["empty_leaves_disagree"].get<std::int64_t>();
    }
    statements.add("contradictions", "The smallest leaf has 0 spheres exactly where leaves with N = 0 are counted",
                   found.empty() ? "so in each column" : fmt::format("{}", fmt::join(found, "; ")),
                   ours == 0 ? "so in each tree of each seed" : fmt::format("not in {} trees", ours),
                   verdict_if(found.empty() && ours == 0));
  }

  void add_balance(Statements& statements) {
    const auto found = context_.results.find(kLevelsStep);
    if (found == context_.results.end()) return;
    const Json& levels = found->second["levels"];
    const std::int64_t scenario = values_.integer("balanced.scenario");
    bool equal = true, multiplied = true;
    std::vector<std::string> sizes;
    for (std::size_t i = 0; i < levels.size(); ++i) {
      equal = equal && levels[i]["min"] == levels[i]["max"];
      multiplied =
          multiplied && (i == 0 || levels[i]["max"].get<double>() ==
                                       levels[i - 1]["max"].get<double>() * values_.number("level_removed.factor"));
      sizes.push_back(levels[i]["max"].dump());
    }
    const std::string where = fmt::format(" (Scenario {})", scenario);
    statements.add("level_removed", "Spheres per leaf double with each level that is removed" + where,
                   "times " + values_.printed("level_removed.factor"), fmt::format("{}", fmt::join(sizes, ", ")),
                   verdict_if(multiplied));
    for (const Column& column : columns_)
      if (column.scenario == scenario)
        equal = equal && column.spread("spheres_per_leaf_min").mean == column.spread("spheres_per_leaf_max").mean &&
                column.spread("depth_min").mean == column.spread("depth_max").mean;
    statements.add("balanced", "The tree is perfectly balanced and all leaves hold equally many" + where, "all equal",
                   equal ? "all equal, at each depth limit" : "not all equal", verdict_if(equal));
    section_.data["levels"] = levels;
  }

  const SectionContext& context_;
  const Values& values_;
  std::vector<Column> columns_;
  std::vector<std::pair<std::int64_t, double>> reductions_;
  Section section_;
};

}  // namespace

Section table_4_2_section(const SectionContext& context) {
  return TableSection(context).section();
}

}  // namespace bihive::cli::thesis
