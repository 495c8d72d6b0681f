// The text's statements about Table 4.2, each compared with our trees and build times.
#include <algorithm>
#include <functional>

#include "bihive/math/quartiles.h"
#include "thesis/table_4_2.h"

namespace bihive::cli::thesis {
namespace {

class TableStatements {
 public:
  TableStatements(const SectionContext& context, const TreeColumns& columns)
      : context_(context), values_(context.values), columns_(columns) {}

  Statements all() {
    if (columns_.complete()) {
      add_order();
      add_optimized();
      add_tree_sizes();
      add_leaf_each();
      add_contradictions();
    }
    if (columns_.complete() && columns_.has_build_times()) {
      add_shallower();
      add_build_order();
      add_build_gain();
    }
    add_balance();
    add_overlap();
    return std::move(statements_);
  }

 private:
  void add_order() {
    std::vector<std::pair<double, std::int64_t>> reductions;
    for (const std::int64_t scenario : columns_.scenarios)
      reductions.push_back({columns_.reduction(scenario)->spread.mean, scenario});
    std::sort(reductions.rbegin(), reductions.rend());
    std::vector<std::int64_t> order;
    order.reserve(reductions.size());
    for (const auto& [reduction, scenario] : reductions) order.push_back(scenario);
    const bool all = reductions.back().first > 0;
    statements_.add("reduction_order", "The nodes are reduced in all scenarios; biggest reduction first",
                    {values_, "reduction_order"}, fmt::format("{}", fmt::join(order, ", ")),
                    verdict_if(all && order == values_.integers("reduction_order")));
  }

  // The column where something is largest (or smallest).
  const TreeColumn& extreme(const std::function<double(const TreeColumn&)>& of, bool largest) const {
    const TreeColumn* best = &columns_.all().front();
    for (const TreeColumn& column : columns_.all())
      if (largest ? of(column) > of(*best) : of(column) < of(*best)) best = &column;
    return *best;
  }

  void add_extreme(const std::string& name, const std::string& statement, const TreeColumn& ours,
                   const std::string& what) {
    const std::int64_t scenario = values_.integer(name + ".scenario"), prims = values_.integer(name + ".max_prims");
    statements_.add(name, statement, fmt::format("Scenario {}, MAX_PRIMS {}", scenario, prims),
                    ours.name() + " (" + what + ")", verdict_if(ours.scenario == scenario && ours.max_prims == prims));
  }

  void add_optimized() {
    const auto optimized = [](const TreeColumn& column) { return column.spread("optimized_nodes").mean; };
    const TreeColumn& most = extreme(optimized, true);
    add_extreme("most_optimized", "The most optimized nodes", most, fmt::format("{:.0f}", optimized(most)));
    const std::int64_t none = values_.integer("none_optimized.scenario");
    double found = 0;
    for (const TreeColumn& column : columns_.all())
      if (column.scenario == none) found += optimized(column);
    statements_.add("none_optimized", fmt::format("Scenario {} has no optimized node in both configurations", none),
                    "0", fmt::format("{:.0f}", found), verdict_if(found == 0));
  }

  double build_ms(const TreeColumn& column) const {
    return quartiles_of(columns_.build_means(column.scenario, column.max_prims)).median;
  }

  // In each scenario: is the tree of this configuration better than that of each other configuration?
  bool everywhere(std::int64_t max_prims, const std::function<bool(const TreeColumn&, const TreeColumn&)>& better) {
    return std::all_of(columns_.all().begin(), columns_.all().end(), [&](const TreeColumn& other) {
      const TreeColumn* one = columns_.find(other.scenario, max_prims);
      return one && (other.max_prims == max_prims || better(*one, other));
    });
  }

  void add_everywhere(const std::string& name, const std::string& statement, bool found, std::int64_t max_prims) {
    statements_.add(name, statement, fmt::format("MAX_PRIMS {}", max_prims),
                    found ? "so in each scenario" : "not in each scenario", verdict_if(found));
  }

  void add_tree_sizes() {
    const std::int64_t large = values_.integer("largest_trees.max_prims");
    const auto nodes = [](const TreeColumn& column) {
      return column.spread("inner_nodes").mean + column.spread("leaves").mean;
    };
    const bool found = everywhere(large, [&nodes](const TreeColumn& a, const TreeColumn& b) {
      return nodes(a) > nodes(b) && a.spread("depth_avg").mean > b.spread("depth_avg").mean;
    });
    add_everywhere("largest_trees", "The first test makes the most complex and memory intensive trees", found, large);
  }

  void add_shallower() {
    const std::int64_t small = values_.integer("shallower.max_prims");
    const bool shallower = everywhere(small, [](const TreeColumn& a, const TreeColumn& b) {
      return a.spread("depth_avg").mean < b.spread("depth_avg").mean;
    });
    const bool faster = everywhere(small, [this](const TreeColumn& a, const TreeColumn& b) {
      return build_quartiles(a).upper < build_quartiles(b).lower;
    });
    const bool perhaps = everywhere(small, [this](const TreeColumn& a, const TreeColumn& b) {
      return build_quartiles(a).lower <= build_quartiles(b).upper;
    });
    statements_.add("shallower", "A higher MAX_PRIMS makes the tree shallower and thereby decreases the build time",
                    fmt::format("MAX_PRIMS {}", small),
                    fmt::format("{}; {}", shallower ? "shallower in each scenario" : "not shallower in each scenario",
                                faster ? "faster in each" : "not clearly faster in each"),
                    shallower && faster    ? Verdict::agrees
                    : shallower && perhaps ? Verdict::undecided
                                           : Verdict::differs,
                    "", /*timed=*/true);
  }

  void add_leaf_each() {
    // A leaf for each sphere; but coincident spheres share a leaf, as the table also shows.
    const std::int64_t single = values_.integer("leaf_each.max_prims");
    std::vector<std::string> most;
    bool each = true;
    for (const TreeColumn& column : columns_.all())
      if (column.max_prims == single) {
        most.push_back(fmt::format("{:.0f}", column.spread("spheres_per_leaf_max").mean));
        each = each && column.spread("spheres_per_leaf_max").mean == values_.number("leaf_each.spheres_per_leaf");
      }
    // The table itself has leaves with more, or it has not.
    std::vector<std::string> against;
    for (const TreeColumn& column : columns_.all()) {
      const std::string row = tree_value(column.scenario, column.max_prims) + ".spheres_per_leaf_max";
      if (column.max_prims == single && values_.number(row) != values_.number("leaf_each.spheres_per_leaf"))
        against.push_back(fmt::format("Scenario {}: {}", column.scenario, values_.printed(row)));
    }
    statements_.add("leaf_each", "The first test's trees have a leaf for each sphere; most spheres in a leaf",
                    {values_, "leaf_each.spheres_per_leaf"},
                    fmt::format("{} in the scenarios: coincident spheres cannot be parted", fmt::join(most, ", ")),
                    against.empty() ? verdict_if(each) : Verdict::text_inconsistent,
                    against.empty() ? "" : fmt::format("its table has {}", fmt::join(against, ", ")));
  }

  void add_build_order() {
    add_extreme_build("shortest_build", "The shortest build time", /*longest=*/false);
    add_extreme_build("longest_build", "The longest build time", /*longest=*/true);
  }

  Quartiles build_quartiles(const TreeColumn& column) const {
    return quartiles_of(columns_.build_means(column.scenario, column.max_prims));
  }

  // Agrees if the stated column's quartiles lie beyond those of all others; differs if those of another lie beyond its
  // own.
  void add_extreme_build(const std::string& name, const std::string& statement, bool longest) {
    const std::int64_t scenario = values_.integer(name + ".scenario"), prims = values_.integer(name + ".max_prims");
    const TreeColumn* const stated = columns_.find(scenario, prims);
    const TreeColumn& ours = extreme([this](const TreeColumn& column) { return build_ms(column); }, longest);
    const auto beyond = [longest](const Quartiles& a, const Quartiles& b) {
      return longest ? a.lower > b.upper : a.upper < b.lower;
    };
    bool before_all = stated != nullptr, behind_one = stated == nullptr;
    for (const TreeColumn& column : columns_.all()) {
      if (stated == nullptr || &column == stated) continue;
      before_all = before_all && beyond(build_quartiles(*stated), build_quartiles(column));
      behind_one = behind_one || beyond(build_quartiles(column), build_quartiles(*stated));
    }
    const Verdict verdict = before_all ? Verdict::agrees : behind_one ? Verdict::differs : Verdict::undecided;
    statements_.add(name, statement, fmt::format("Scenario {}, MAX_PRIMS {}", scenario, prims),
                    fmt::format("{}: {} ms", ours.name(), quartiles_text(build_quartiles(ours), 3)), verdict,
                    verdict == Verdict::undecided ? "quartiles overlap" : "", /*timed=*/true);
  }

  // The part of the first configuration's build time that the second saves, from times taken together.
  Quartiles build_gain(std::int64_t scenario) const {
    const std::vector<double>& first = columns_.build_means(scenario, columns_.max_prims.front());
    const std::vector<double>& last = columns_.build_means(scenario, columns_.max_prims.back());
    std::vector<double> gains;
    for (std::size_t i = 0; i < std::min(first.size(), last.size()); ++i) gains.push_back(1 - last[i] / first[i]);
    return quartiles_of(gains);
  }

  // Undecided if the quartiles of the thesis's scenario and those of another overlap.
  void add_build_gain() {
    const std::int64_t claimed = values_.integer("best_build_gain.scenario");
    std::vector<std::string> ours, stated;
    bool above_all = columns_.find(claimed, columns_.max_prims.front()) != nullptr, below_one = !above_all;
    for (const std::int64_t scenario : columns_.scenarios) {
      const auto of_thesis = [&](std::int64_t max_prims) {
        return values_.number("build_ms." + tree_value(scenario, max_prims));
      };
      const double thesis = 1 - of_thesis(columns_.max_prims.back()) / of_thesis(columns_.max_prims.front());
      const Quartiles gain = build_gain(scenario);
      stated.push_back(fmt::format("{:.1f}", 100 * thesis));
      ours.push_back(fmt::format("{:.1f} ({:.1f} to {:.1f})", 100 * gain.median, 100 * gain.lower, 100 * gain.upper));
      if (scenario == claimed || below_one) continue;
      above_all = above_all && build_gain(claimed).lower > gain.upper;
      below_one = build_gain(claimed).upper < gain.lower;
    }
    const Verdict verdict = above_all ? Verdict::agrees : below_one ? Verdict::differs : Verdict::undecided;
    statements_.add("best_build_gain", "The best relative improvement of the build time, in percent",
                    fmt::format("Scenario {}; the table has {}", claimed, fmt::join(stated, ", ")),
                    fmt::format("{}", fmt::join(ours, ", ")), verdict,
                    verdict == Verdict::undecided ? "quartiles overlap" : "", /*timed=*/true);
  }

  // A tree has an empty leaf exactly when its smallest leaf has 0 spheres.
  void add_contradictions() {
    std::vector<std::string> found;
    std::int64_t ours = 0;
    for (const TreeColumn& column : columns_.all()) {
      const std::string name = tree_value(column.scenario, column.max_prims);
      const std::string min = name + ".spheres_per_leaf_min", share = name + ".share_with_0";
      if ((values_.number(min) == 0) != (values_.number(share) > 0))
        found.push_back(
            fmt::format("{}: minimum {}, N = 0 in {}", column.name(), values_.printed(min), values_.printed(share)));
      ours += (*column.result)["empty_leaves_disagree"].get<std::int64_t>();
    }
    statements_.add("contradictions", "The smallest leaf has 0 spheres exactly where leaves with N = 0 are counted",
                    found.empty() ? "so in each column" : fmt::format("{}", fmt::join(found, "; ")),
                    ours == 0 ? "so in each tree of each seed" : fmt::format("not in {} trees", ours),
                    found.empty() ? verdict_if(ours == 0) : Verdict::text_inconsistent);
  }

  void add_balance() {
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
    statements_.add("level_removed", "Spheres per leaf double with each level that is removed" + where,
                    {values_, "level_removed.factor"}, fmt::format("{}", fmt::join(sizes, ", ")),
                    verdict_if(multiplied));
    for (const TreeColumn& column : columns_.all())
      if (column.scenario == scenario)
        equal = equal && column.spread("spheres_per_leaf_min").mean == column.spread("spheres_per_leaf_max").mean &&
                column.spread("depth_min").mean == column.spread("depth_max").mean;
    statements_.add("balanced", "The tree is perfectly balanced and all leaves hold equally many" + where, "all equal",
                    equal ? "all equal, at each depth limit" : "not all equal", verdict_if(equal));
  }

  // "given the high quantity of primitives in such a small volume, the possibility of node overlap is higher".
  void add_overlap() {
    const auto found = context_.results.find(kReasonsStep);
    if (found == context_.results.end()) return;
    const std::int64_t claimed = values_.integer("most_overlap.scenario");
    double here = 0, elsewhere = 0;
    std::vector<std::string> ours;
    for (const Json& row : found->second) {
      if (row["max_prims"].get<std::int64_t>() != columns_.max_prims.front()) continue;
      const double share = row["overlap_share"].get<double>();
      (row["scenario"].get<std::int64_t>() == claimed ? here : elsewhere) =
          row["scenario"].get<std::int64_t>() == claimed ? share : std::max(elsewhere, share);
      ours.push_back(fmt::format("Scenario {}: {:.1f} %", row["scenario"].get<std::int64_t>(), 100 * share));
    }
    statements_.add("most_overlap", "Nodes overlap more in this scenario than in the others: split nodes that do",
                    {fmt::format("Scenario {}", claimed), values_.kind("most_overlap.scenario")},
                    fmt::format("{}", fmt::join(ours, ", ")), verdict_if(here > elsewhere));
  }

  const SectionContext& context_;
  const Values& values_;
  const TreeColumns& columns_;
  Statements statements_{
      "What the text says about the table",
      "Statements about numbers of nodes are compared with our means over the seeds, those about time "
      "with the build times of this run."};
};

}  // namespace

Statements table_4_2_statements(const SectionContext& context, const TreeColumns& columns) {
  return TableStatements(context, columns).all();
}

}  // namespace bihive::cli::thesis
