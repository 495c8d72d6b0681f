// Table 4.2 in the report: the table itself, the reductions and the build times.
#include <algorithm>
#include <cmath>

#include "bihive/math/quartiles.h"
#include "support/messages.h"
#include "thesis/table_4_2.h"
#include "thesis/tree_reasons.h"

namespace bihive::cli::thesis {
namespace {

const char* const kInsideRule =
    "Agrees: the thesis's value lies within three standard deviations of our mean over the seeds, widened by half a "
    "unit of its last printed digit; where there is no deviation, it is equal as far as it is printed.";

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
  explicit TableSection(const SectionContext& context)
      : context_(context), values_(context.values), columns_(context) {}

  Section section() {
    if (!columns_.all().empty()) {
      describe();
      for (const std::int64_t scenario : columns_.scenarios) add_scenario(scenario);
      add_reductions();
    }
    if (columns_.has_build_times()) add_build_times();
    add_statements();
    return std::move(section_);
  }

 private:
  void describe() {
    std::int64_t seeds = 0;
    for (const TreeColumn& column : columns_.all())
      seeds = std::max(seeds, (*column.result)["seeds"].get<std::int64_t>());
    section_.paragraphs.push_back(fmt::format(
        "{} spheres of radius {} in each scenario. \"This seed\" is seed {}; mean and standard deviation are over {} "
        "seeds. Scenario 1 has no chance in it: one tree, which must be the thesis's.",
        grouped(values_.integer("spheres")), values_.printed("radius"), context_.settings.seed, seeds));
    section_.paragraphs.emplace_back(
        "What agreement means here: the text does not say how its tree is built, nor how large the small cubes of "
        "Scenarios 2 "
        "and 3 are. We reconstructed both from this table. That one builder and one size give all its rows says that "
        "the "
        "table is of one piece and that this is very probably its builder; it is no confirmation by somebody who did "
        "not "
        "know the table.");
    section_.data["seed"] = context_.settings.seed;
    section_.data["seeds"] = seeds;
    section_.data["values"] = Json::array();
  }

  // All rows of one scenario, four columns for each MAX_PRIMS.
  void add_scenario(std::int64_t scenario) {
    Table table{fmt::format("Scenario {}", scenario), {"Row"}, {}, kInsideRule};
    std::vector<const TreeColumn*> shown;
    for (const std::int64_t max_prims : columns_.max_prims)
      if (const TreeColumn* found = columns_.find(scenario, max_prims)) shown.push_back(found);
    if (shown.empty()) return;
    for (const TreeColumn* column : shown)
      for (const char* const what : {"thesis", "this seed", "mean ± sd", "inside 3 sd"})
        table.columns.push_back(fmt::format("MAX_PRIMS {}: {}", column->max_prims, what));
    for (const TreeRow& row : kTreeRows) {
      table.rows.push_back({{row.label}});
      for (const TreeColumn* column : shown) add_value(*column, row, table.rows.back());
    }
    section_.tables.push_back(std::move(table));
  }

  // A column says twice whether there is an empty leaf: by the smallest leaf, and by the share of leaves with N = 0.
  bool contradicts_itself(const TreeColumn& column, const TreeRow& row) const {
    const std::string_view key = row.key;
    if (key != "spheres_per_leaf_min" && key != "share_with_0") return false;
    const std::string name = tree_value(column.scenario, column.max_prims);
    return (values_.number(name + ".spheres_per_leaf_min") == 0) != (values_.number(name + ".share_with_0") > 0);
  }

  void add_value(const TreeColumn& column, const TreeRow& row, std::vector<Cell>& cells) {
    const std::string name = tree_value(column.scenario, column.max_prims) + "." + row.key;
    const double stated = values_.number(name), ours = column.row(row.key);
    const std::string printed = values_.printed(name);
    const Spread spread = column.spread(row.key);
    const bool contradicts = contradicts_itself(column, row);
    const Verdict verdict =
        contradicts ? Verdict::text_inconsistent : verdict_if(inside_three_sd(stated, printed, spread));
    // A deviation far below the printed digits is left out.
    const bool random = spread.sd > print_rounding(printed);
    const std::string how = contradicts ? "two rows of the table exclude each other"
                            : random    ? fmt::format("{:+.1f} sd", (stated - spread.mean) / spread.sd)
                                        : (verdict == Verdict::agrees ? "equal" : "not equal");
    cells.push_back({printed});
    cells.push_back({number_text(ours, row.decimals) + (row.share ? " %" : "")});
    cells.push_back({spread_text(spread, row)});
    cells.push_back(section_.judge({name, fmt::format("{}: {}", column.name(), row.label), printed,
                                    spread_text(spread, row), verdict, values_.kind(name), false},
                                   how));
    section_.data["values"].push_back({{"name", name},
                                       {"scenario", column.scenario},
                                       {"max_prims", column.max_prims},
                                       {"row", row.key},
                                       {"thesis", stated},
                                       {"ours", ours},
                                       {"mean", spread.mean},
                                       {"sd", spread.sd},
                                       {"kind", name_of(values_.kind(name))},
                                       {"verdict", name_of(verdict)}});
  }

  // The shrinkage of the nodes from the first MAX_PRIMS to the last, seed by seed.
  void add_reductions() {
    Table table{"Total number of nodes, from the first configuration to the second",
                {"Scenario", "thesis", "this seed", "mean ± sd", "inside 3 sd"},
                {},
                kInsideRule};
    section_.data["reductions"] = Json::array();
    for (const std::int64_t scenario : columns_.scenarios) {
      const std::optional<TreeColumns::Reduction> reduction = columns_.reduction(scenario);
      if (!reduction) continue;
      const auto& [ours, spread] = *reduction;
      const std::string name = fmt::format("reduction_percent.scenario{}", scenario);
      const Verdict verdict = verdict_if(inside_three_sd(values_.number(name), values_.printed(name), spread));
      table.rows.push_back(
          {{fmt::format("{}", scenario)},
           {values_.printed(name)},
           {fmt::format("{:.2f} %", ours)},
           {spread_text(spread, {"", "", 2, true})},
           section_.judge({name, fmt::format("Scenario {}: total nodes reduced by", scenario), values_.printed(name),
                           spread_text(spread, {"", "", 2, true}), verdict, values_.kind(name), false},
                          verdict == Verdict::agrees ? "yes" : "no")});
      section_.data["reductions"].push_back({{"name", name},
                                             {"scenario", scenario},
                                             {"thesis", values_.number(name)},
                                             {"ours", ours},
                                             {"mean", spread.mean},
                                             {"sd", spread.sd},
                                             {"kind", name_of(values_.kind(name))},
                                             {"verdict", name_of(verdict)}});
    }
    if (!table.rows.empty()) section_.tables.push_back(std::move(table));
  }

  void add_build_times() {
    Table table{
        fmt::format("Build time, mean of {} builds, in milliseconds", values_.printed("rounds")),
        {"Scenario", "MAX_PRIMS", "thesis", "ours", "quartiles", "ours / thesis"},
        {},
        "Such a mean was taken many times, all columns in turn: ours is the median of the means. No verdict, for the "
        "machines are the thesis's phone and this one. The statements below compare the order."};
    section_.data["build_ms"] = Json::array();
    for (const std::int64_t scenario : columns_.scenarios)
      for (const std::int64_t max_prims : columns_.max_prims) {
        const std::string name = fmt::format("build_ms.{}", tree_value(scenario, max_prims));
        const std::vector<double>& means = columns_.build_means(scenario, max_prims);
        const Quartiles ours = quartiles_of(means);
        const double ratio = ours.median / values_.number(name);
        table.rows.push_back({{fmt::format("{}", scenario)},
                              {fmt::format("{}", max_prims)},
                              {values_.printed(name)},
                              {fmt::format("{:.3f}", ours.median)},
                              {fmt::format("{:.3f} to {:.3f}", ours.lower, ours.upper)},
                              {fmt::format("{:.3f}", ratio)}});
        section_.data["build_ms"].push_back({{"name", name},
                                             {"scenario", scenario},
                                             {"max_prims", max_prims},
                                             {"thesis", values_.number(name)},
                                             {"ours", ours.median},
                                             {"means", means},
                                             {"ratio", ratio}});
      }
    section_.tables.push_back(std::move(table));
  }

  // Shown by table_4_2_statements.cpp; the levels behind one of the statements go with the data.
  void add_statements() {
    Statements statements = table_4_2_statements(context_, columns_);
    section_.data["statements"] = statements.data();
    if (!statements.empty()) statements.move_into(section_);
    if (const auto reasons = context_.results.find(kReasonsStep); reasons != context_.results.end()) {
      section_.data["reasons"] = reasons->second;
      section_.tables.push_back(reasons_table(reasons->second, "The text's reasons, counted: leaves, overlaps, gaps"));
    }
    const auto found = context_.results.find(kLevelsStep);
    if (found != context_.results.end()) section_.data["levels"] = found->second["levels"];
  }

  const SectionContext& context_;
  const Values& values_;
  TreeColumns columns_;
  Section section_;
};

}  // namespace

TreeColumns::TreeColumns(const SectionContext& context)
    : scenarios(context.values.integers("scenarios")), max_prims(context.values.integers("max_prims_list")) {
  for (const std::int64_t scenario : scenarios)
    for (const std::int64_t prims : max_prims)
      if (const auto found = context.results.find(tree_step(scenario, prims)); found != context.results.end())
        columns_.push_back({scenario, prims, &found->second});
  const auto times = context.results.find(kBuildTimesStep);
  if (times == context.results.end()) return;
  for (const auto& [name, means] : times->second.items()) build_means_[name] = means.get<std::vector<double>>();
}

const std::vector<double>& TreeColumns::build_means(std::int64_t scenario, std::int64_t prims) const {
  static const std::vector<double> kNone;
  const auto found = build_means_.find(tree_step(scenario, prims));
  return found == build_means_.end() ? kNone : found->second;
}

const TreeColumn* TreeColumns::find(std::int64_t scenario, std::int64_t prims) const {
  for (const TreeColumn& column : columns_)
    if (column.scenario == scenario && column.max_prims == prims) return &column;
  return nullptr;
}

std::optional<TreeColumns::Reduction> TreeColumns::reduction(std::int64_t scenario) const {
  const TreeColumn *first = find(scenario, max_prims.front()), *last = find(scenario, max_prims.back());
  if (!first || !last) return std::nullopt;
  const auto shrunk = [](double before, double after) { return 100 * (1 - after / before); };
  const auto before = (*first->result)["nodes_of_seeds"].get<std::vector<double>>();
  const auto after = (*last->result)["nodes_of_seeds"].get<std::vector<double>>();
  std::vector<double> sample;
  for (std::size_t i = 0; i < std::min(before.size(), after.size()); ++i) sample.push_back(shrunk(before[i], after[i]));
  return Reduction{shrunk((*first->result)["nodes"].get<double>(), (*last->result)["nodes"].get<double>()),
                   spread_of(sample)};
}

Section table_4_2_section(const SectionContext& context) {
  return TableSection(context).section();
}

}  // namespace bihive::cli::thesis
