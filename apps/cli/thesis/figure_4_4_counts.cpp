// Figure 4.4 without a clock: what each ray does, counted; and which MAX_PRIMS wins at which ratio of costs. It answers
// the text's central finding for every machine at once.
//
// A frame's time, less what no tree takes away, is nodes x cost of a node + tests x cost of a test. Only the ratio of
// the two costs decides which tree is fastest.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "bihive/base/write_file.h"
#include "bihive/image/svg_chart.h"
#include "bihive/thesis/frame_rates_report.h"
#include "support/failure.h"
#include "thesis/figure_4_4.h"
#include "thesis/tree_reasons.h"

namespace bihive::cli::thesis {
namespace {

// Ratios of the chart: a node costs this many sphere tests.
constexpr double kRatios[] = {1.0 / 16, 0.125, 0.25, 0.5, 1, 2, 4, 8, 16, 32, 64};

struct Work {
  double nodes = 0, tests = 0;  // of a ray, in the mean
  double cost(double ratio) const { return tests + ratio * nodes; }
};
using WorkByTree = std::map<std::int64_t, Work>;  // by MAX_PRIMS
using Key = std::pair<std::int64_t, std::int64_t>;

// The ratios at which a tree is the best of some trees: from low to high, none if low > high.
struct Range {
  double low = 0, high = std::numeric_limits<double>::infinity();
  bool empty() const { return low > high; }
};

Range best_range(const WorkByTree& trees, std::int64_t prims, const std::vector<std::int64_t>& among) {
  Range range;
  if (trees.count(prims) == 0) return {0, -1};  // it was not measured
  const Work& mine = trees.at(prims);
  for (const std::int64_t other : among) {
    if (other == prims || trees.count(other) == 0) continue;
    // mine.tests + r mine.nodes <= other.tests + r other.nodes
    const double nodes = trees.at(other).nodes - mine.nodes;
    const double tests = mine.tests - trees.at(other).tests;
    if (nodes > 0)
      range.low = std::max(range.low, tests / nodes);
    else if (nodes < 0)
      range.high = std::min(range.high, tests / nodes);
    else if (tests > 0)
      range.high = -1;
  }
  return range;
}

std::string ratio_text(double ratio) {
  return std::isinf(ratio) ? "∞" : fmt::format("{:.3f}", ratio);
}
std::string range_text(const Range& range) {
  return range.empty() ? "at no ratio" : fmt::format("{} to {}", ratio_text(range.low), ratio_text(range.high));
}
std::string ranges_text(const std::vector<Range>& ranges) {
  std::vector<std::string> texts;
  texts.reserve(ranges.size());
  for (const Range& range : ranges) texts.push_back(range_text(range));
  return texts.empty() ? "at no ratio" : fmt::format("{}", fmt::join(texts, " and from "));
}

class CountsPart {
 public:
  CountsPart(const SectionContext& context, Section& section)
      : context_(context), values_(context.values), section_(section), max_prims_(values_.integers("max_prims_list")) {
    for (const std::int64_t scenario : values_.integers("scenarios")) {
      const auto found = context.results.find(counts_step(scenario));
      if (found == context.results.end()) continue;
      for (const std::int64_t spheres : values_.integers("spheres_list"))
        for (const auto& [prims, tree] : found->second[fmt::format("spheres{}", spheres)]["trees"].items())
          work_[{scenario, spheres}][std::stoll(prims)] = {tree["nodes"].get<double>() + tree["leaves"].get<double>(),
                                                           tree["tests"].get<double>()};
    }
  }

  void add() {
    part_.title = "Without a clock: what each ray does";
    if (!work_.empty()) {
      part_.paragraphs = {
          fmt::format(
              "Nodes that a ray enters and spheres that it is tested against do not depend on a machine. Counted by an "
              "observer in the tree reconstructed from Table 4.2 over all primary rays of the picture, in the scenes "
              "of "
              "seed {}, they say for each ratio of two costs, that of a node and that of a sphere test, which "
              "MAX_PRIMS "
              "is the best in these scenes, for any machine and without noise. What a phone's memory does to either "
              "cost is in the ratio; what it does to one tree and not to another is not.",
              context_.settings.seed),
          "A small ratio means cheap nodes and favours deep trees; a large one favours large leaves."};
      add_work();
      if (complete()) {
        add_wins();
        add_ranges();
      }
    }
    add_balance();
    if (!part_.tables.empty()) section_.parts.push_back(std::move(part_));
  }

 private:
  bool complete() const {
    return work_.size() == values_.integers("scenarios").size() * values_.integers("spheres_list").size();
  }

  void add_work() {
    std::set<std::int64_t> beyond;
    for (const auto& [key, trees] : work_)
      for (const auto& [prims, work] : trees)
        if (prims != key.second && prims > max_prims_.back()) beyond.insert(prims);
    std::vector<std::int64_t> all = max_prims_;
    all.insert(all.end(), beyond.begin(), beyond.end());
    Table table{"A ray's work: nodes entered + spheres tested, in the mean", {"Scenario", "Spheres", "BF"}, {}, ""};
    for (const std::int64_t prims : all) table.columns.push_back(tree_name(prims));
    table.columns.emplace_back("One leaf");
    Json rows = Json::array();
    for (const auto& one : work_) {  // clang 14 does not capture bindings
      const auto& key = one.first;
      const auto& trees = one.second;
      std::vector<Cell> row{
          {fmt::format("Scenario {}", key.first)}, {std::to_string(key.second)}, {fmt::format("0 + {}", key.second)}};
      const auto cell = [&](std::int64_t prims) -> Cell {
        const auto found = trees.find(prims);
        if (found == trees.end()) return {""};
        rows.push_back({{"scenario", key.first},
                        {"spheres", key.second},
                        {"max_prims", prims},
                        {"nodes", found->second.nodes},
                        {"tests", found->second.tests}});
        return {fmt::format("{:.2f} + {:.2f}", found->second.nodes, found->second.tests)};
      };
      for (const std::int64_t prims : all) row.push_back(prims < key.second ? cell(prims) : Cell{""});
      row.push_back(cell(key.second));
      table.rows.push_back(std::move(row));
    }
    table.note =
        "Nodes: inner nodes and leaves. Over all rays of the picture; a ray that misses the box around everything "
        "enters none. One leaf: MAX_PRIMS = number of spheres.";
    part_.tables.push_back(std::move(table));
    section_.data["counts"] = std::move(rows);
  }

  // How often each tree is the best at a ratio. Where two are equal, both count.
  std::map<std::int64_t, int> wins_at(double ratio, bool beyond) const {
    std::map<std::int64_t, int> wins;
    for (const auto& [key, trees] : work_) {
      double least = std::numeric_limits<double>::infinity();
      const auto counts = [&](std::int64_t prims) {
        return beyond || std::find(max_prims_.begin(), max_prims_.end(), prims) != max_prims_.end();
      };
      for (const auto& [prims, work] : trees)
        if (counts(prims)) least = std::min(least, work.cost(ratio));
      for (const auto& [prims, work] : trees)
        if (counts(prims) && work.cost(ratio) <= least * (1 + 1e-12)) ++wins[prims];
    }
    return wins;
  }

  // All ratios at which two trees change places, from low to high; first 0.
  std::vector<double> changes(bool beyond) const {
    std::set<double> found{0};
    for (const auto& [key, trees] : work_)
      for (const auto& [a, one] : trees)
        for (const auto& [b, other] : trees) {
          if (!beyond && (a > max_prims_.back() || b > max_prims_.back())) continue;
          if (one.nodes == other.nodes) continue;
          const double ratio = (one.tests - other.tests) / (other.nodes - one.nodes);
          if (ratio > 0 && std::isfinite(ratio)) found.insert(ratio);
        }
    return {found.begin(), found.end()};
  }

  // How often a tree wins between two changes that follow each other, and from the last one on: the same everywhere
  // between them. At a change itself two trees are equal, so both may win there.
  struct Between {
    Range range;
    int wins;
  };
  std::vector<Between> wins_between_changes(std::int64_t prims, bool beyond) const {
    std::vector<Between> all;
    const std::vector<double> at = changes(beyond);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const bool last = i + 1 == at.size();
      const double inside = last ? 2 * at[i] + 1 : at[i] + (at[i + 1] - at[i]) / 2;
      all.push_back(
          {{at[i], last ? std::numeric_limits<double>::infinity() : at[i + 1]}, wins_at(inside, beyond)[prims]});
    }
    return all;
  }

  // The ratios at which a tree wins exactly so many times, from low to high, without gaps inside of one.
  std::vector<Range> ratios_with(std::int64_t prims, std::int64_t wins, bool beyond) const {
    std::vector<Range> ranges;
    for (const Between& between : wins_between_changes(prims, beyond)) {
      if (between.wins != wins) continue;
      if (!ranges.empty() && ranges.back().high == between.range.low)
        ranges.back().high = between.range.high;
      else
        ranges.push_back(between.range);
    }
    return ranges;
  }

  void add_wins() {
    // The chart: configurations won, over the ratio.
    ChartData chart{"Which MAX_PRIMS wins, over the ratio of costs",
                    "cost of a node / cost of a sphere test",
                    "configurations of 9 won",
                    {},
                    {},
                    false};
    chart.y_label = fmt::format("configurations of {} won", work_.size());
    for (const double ratio : kRatios)
      chart.categories.push_back(ratio < 1 ? fmt::format("1/{:.0f}", 1 / ratio) : fmt::format("{:.0f}", ratio));
    for (const std::int64_t prims : max_prims_) {
      Series series{tree_name(prims), {}};
      for (const double ratio : kRatios) series.values.emplace_back(static_cast<double>(wins_at(ratio, false)[prims]));
      chart.series.push_back(std::move(series));
    }
    const std::string file = "wins_by_ratio.svg";
    if (const Status status = write_file(context_.folder + "/" + file, line_chart(chart)); !status)
      fail(status.error());
    part_.illustrations.push_back({"figure-4.4/" + file,
                                   "Among the thesis's values of MAX_PRIMS, counted without a clock: in how many "
                                   "configurations each is the best, over what a node costs in sphere tests."});

    const std::int64_t winner = values_.integer("winner.max_prims"), stated = values_.integer("winner.wins");
    Statements statements("The text's winner at every ratio of costs",
                          "From the counts above alone, which have no noise. That a frame's time is made of these two "
                          "costs is our inference, "
                          "not the text's. As inferred if there is a ratio at which it is so.");
    const std::vector<Range> seven = ratios_with(winner, stated, false);
    int most = 0;
    for (const Between& between : wins_between_changes(winner, false)) most = std::max(most, between.wins);
    const bool same_number = static_cast<std::int64_t>(work_.size()) == values_.integer("winner.configurations");
    statements.add("counts.winner",
                   fmt::format("{} is the best in {} of {}, at some ratio", tree_name(winner), stated,
                               values_.integer("winner.configurations")),
                   {fmt::format("in {} of {}", stated, values_.integer("winner.configurations")), ValueKind::inferred},
                   seven.empty() ? fmt::format("at no ratio; at most in {} of {}, from {}", most, work_.size(),
                                               ranges_text(ratios_with(winner, most, false)))
                                 : "yes, from " + ranges_text(seven),
                   verdict_if(!seven.empty() && same_number));

    // Which configuration would the text have others win? Its only_rises one, at the same ratio. Without such a ratio
    // there is nothing to compare.
    const Key exception{values_.integer("only_rises.scenario"), values_.integer("only_rises.spheres")};
    const std::int64_t largest = max_prims_.back();
    if (const auto found = work_.find(exception); found != work_.end()) {
      const Range of_exception = best_range(found->second, largest, max_prims_);
      const bool both = std::any_of(seven.begin(), seven.end(), [&](const Range& range) {
        return !of_exception.empty() && of_exception.low <= range.high && range.low <= of_exception.high;
      });
      const std::string ours = of_exception.empty() ? "best at no ratio" : "best from " + range_text(of_exception);
      statements.add("counts.only_rises",
                     fmt::format("There, {} is the best for Scenario {} with {} spheres", tree_name(largest),
                                 exception.first, exception.second),
                     {tree_name(largest), ValueKind::inferred},
                     seven.empty() ? ours + "; not judged, as there is no such ratio" : ours,
                     seven.empty() ? Verdict::none : verdict_if(both));
    }
    section_.data["statements_counts"] = statements.data();
    statements.move_into(section_);
    part_.tables.push_back(std::move(section_.tables.back()));
    section_.tables.pop_back();
  }

  void add_ranges() {
    const std::int64_t winner = values_.integer("winner.max_prims");
    Table table{"The ratios at which each tree is the best, by configuration", {"Scenario", "Spheres"}, {}, ""};
    for (const std::int64_t prims : max_prims_) table.columns.push_back(tree_name(prims));
    table.columns.push_back(tree_name(winner) + ", with larger leaves allowed");
    for (const auto& [key, trees] : work_) {
      std::vector<Cell> row{{fmt::format("Scenario {}", key.first)}, {std::to_string(key.second)}};
      for (const std::int64_t prims : max_prims_) row.push_back({range_text(best_range(trees, prims, max_prims_))});
      std::vector<std::int64_t> all;
      for (const auto& [prims, work] : trees) all.push_back(prims);
      row.push_back({range_text(best_range(trees, winner, all))});
      table.rows.push_back(std::move(row));
    }
    table.note =
        "A node costs so many sphere tests: from, to. Among the thesis's values; the last column lets every "
        "measured MAX_PRIMS take part, up to one leaf.";
    part_.tables.push_back(std::move(table));
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
  std::map<Key, WorkByTree> work_;
};

}  // namespace

void add_counts(const SectionContext& context, Section& section) {
  CountsPart(context, section).add();
}

}  // namespace bihive::cli::thesis
