// Figure 4.4 without a clock: the work of a ray in each tree, counted, and how balanced the trees are.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "bihive/thesis/frame_rates_report.h"
#include "thesis/figure_4_4.h"
#include "thesis/tree_reasons.h"

namespace bihive::cli::thesis {
namespace {

class CountsPart {
 public:
  CountsPart(const SectionContext& context, Section& section)
      : context_(context),
        values_(context.values),
        section_(section),
        max_prims_(values_.integers("max_prims_list")),
        work_(counted_work(context)) {}

  void add() {
    part_.title = "Without a clock: the work of each ray";
    if (!work_.empty()) add_work();
    add_balance();
    if (!part_.tables.empty()) section_.parts.push_back(std::move(part_));
  }

 private:
  void add_work() {
    std::set<std::int64_t> beyond;
    for (const auto& [key, trees] : work_)
      for (const auto& [prims, work] : trees)
        if (prims != key.second && prims > max_prims_.back()) beyond.insert(prims);
    std::vector<std::int64_t> all = max_prims_;
    all.insert(all.end(), beyond.begin(), beyond.end());
    Table table{"A ray's work, on average: inner nodes + leaves + sphere tests", {"Scenario", "Spheres", "BF"}, {}, ""};
    for (const std::int64_t prims : all) table.columns.push_back(tree_name(prims));
    table.columns.emplace_back("One leaf");
    Json rows = Json::array();
    for (const auto& one : work_) {  // clang 14 does not capture bindings
      const auto& key = one.first;
      const auto& trees = one.second;
      std::vector<Cell> row{{fmt::format("Scenario {}", key.first)},
                            {std::to_string(key.second)},
                            {fmt::format("0 + 0 + {}", key.second)}};
      const auto cell = [&](std::int64_t prims) -> Cell {
        const auto found = trees.find(prims);
        if (found == trees.end()) return {""};
        rows.push_back({{"scenario", key.first},
                        {"spheres", key.second},
                        {"max_prims", prims},
                        {"inner", found->second.inner},
                        {"leaves", found->second.leaves},
                        {"tests", found->second.tests}});
        return {
            fmt::format("{:.2f} + {:.2f} + {:.2f}", found->second.inner, found->second.leaves, found->second.tests)};
      };
      for (const std::int64_t prims : all) row.push_back(prims < key.second ? cell(prims) : Cell{""});
      row.push_back(cell(key.second));
      table.rows.push_back(std::move(row));
    }
    table.note = fmt::format(
        "Counted by an observer in the tree reconstructed from Table 4.2, over all primary rays of the picture, in the "
        "scenes of seed {}. A ray that misses the box around everything enters nothing. One leaf: MAX_PRIMS = number "
        "of "
        "spheres.",
        context_.settings.seed);
    part_.tables.push_back(std::move(table));
    section_.data["counts"] = std::move(rows);
  }

  // The text's reasons for Scenario 3: unbalanced trees, a high deviation of the spheres per leaf.
  void add_balance() {
    const auto found = context_.results.find(kBalanceStep);
    if (found == context_.results.end()) return;
    const std::int64_t claimed = values_.integer("highest_deviation.scenario");
    Statements statements(
        fmt::format(
            "The text's reasons for Scenario {}: unbalanced trees, and a high deviation of the spheres per leaf",
            claimed),
        fmt::format(
            "With MAX_PRIMS {}, over the leaves of a tree; means over seeds. The text says \"not well balanced\" "
            "and \"quite high\" and gives no number: we take both as the highest of the scenarios, and balance "
            "as the deviation of the leaves' depth.",
            values_.integer("winner.max_prims")));
    for (const std::int64_t spheres : values_.integers("spheres_list")) {
      add_highest(
          found->second, spheres, "deviation", "spheres per leaf",
          [](const Json& row) { return row["spheres_per_leaf"]["sd"].get<double>(); }, statements);
      add_highest(
          found->second, spheres, "imbalance", "depth of the leaves",
          [](const Json& row) { return row["depth_sd"].get<double>(); }, statements);
    }
    section_.data["balance"] = found->second;
    if (!statements.empty()) {
      section_.data["statements_balance"] = statements.data();
      statements.move_into(section_);
      part_.tables.push_back(std::move(section_.tables.back()));
      section_.tables.pop_back();
    }
    part_.tables.push_back(reasons_table(found->second, "How balanced the trees are"));
  }

  // Is a deviation, as `of(row)` gives it, the highest in the scenario of which the text says so?
  template <class Of>
  void add_highest(const Json& rows, std::int64_t spheres, const std::string& name, const std::string& what,
                   const Of& of, Statements& statements) const {
    const std::int64_t claimed = values_.integer("highest_deviation.scenario");
    double here = -1, elsewhere = -1;
    std::vector<std::string> ours;
    for (const Json& row : rows) {
      if (row["spheres"] != spheres || row["max_prims"] != values_.integer("winner.max_prims")) continue;
      const double deviation = of(row);
      ours.push_back(fmt::format("Scenario {}: {:.2f}", row["scenario"].get<std::int64_t>(), deviation));
      if (row["scenario"] == claimed)
        here = deviation;
      else
        elsewhere = std::max(elsewhere, deviation);
    }
    if (here < 0 || elsewhere < 0) return;
    statements.add(fmt::format("{}.spheres{}", name, spheres),
                   fmt::format("{} spheres: the deviation of the {}", spheres, what),
                   {fmt::format("highest in Scenario {}", claimed), values_.kind("highest_deviation.scenario")},
                   fmt::format("{}", fmt::join(ours, ", ")), verdict_if(here > elsewhere));
  }

  const SectionContext& context_;
  const Values& values_;
  Section& section_;
  Section part_;
  std::vector<std::int64_t> max_prims_;
  FigureWork work_;
};

}  // namespace

FigureWork counted_work(const SectionContext& context) {
  FigureWork work;
  for (const std::int64_t scenario : context.values.integers("scenarios"))
    if (const auto found = context.results.find(counts_step(scenario)); found != context.results.end())
      for (const std::int64_t spheres : context.values.integers("spheres_list"))
        work[{scenario, spheres}] = work_from(found->second[fmt::format("spheres{}", spheres)]["trees"]);
  return work;
}

WorkByTree work_from(const Json& trees) {
  WorkByTree work;
  for (const auto& [prims, tree] : trees.items())
    work[std::stoll(prims)] = {tree["nodes"].get<double>(), tree["leaves"].get<double>(), tree["tests"].get<double>()};
  return work;
}

void add_counts(const SectionContext& context, Section& section) {
  CountsPart(context, section).add();
}

}  // namespace bihive::cli::thesis
