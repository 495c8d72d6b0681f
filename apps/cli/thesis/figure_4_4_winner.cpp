// Figure 4.4's first question: at which costs does the text's MAX_PRIMS win as often as the text says? A diagram over
// two ratios of costs, the measured engines as points in it, and all claims at one point.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bihive/base/parallel.h"
#include "bihive/base/write_file.h"
#include "bihive/thesis/frame_rates_report.h"
#include "support/failure.h"
#include "thesis/figure_4_4.h"
#include "thesis/figure_4_4_cost_diagram.h"

namespace bihive::cli::thesis {
namespace {

// Axes of the diagram: an inner node in sphere tests, a leaf in inner nodes.
constexpr double kLeastInner = 0.25, kMostInner = 16, kMostLeaf = 1;
constexpr int kColumns = 120, kRows = 51;
// Rows of the table: a leaf in inner nodes.
constexpr double kLeafCosts[] = {0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 1};
// Costs of an inner node at which the claims are tried, across the range in which the pattern holds.
constexpr int kTries = 41;

std::string range_text(const CostRange& range) {
  return std::isinf(range.high) ? fmt::format("{:.2f} or more", range.low)
                                : fmt::format("{:.2f} to {:.2f}", range.low, range.high);
}
std::string ranges_text(const std::vector<CostRange>& ranges, const char* none) {
  std::vector<std::string> texts;
  texts.reserve(ranges.size());
  for (const CostRange& range : ranges) texts.push_back(range_text(range));
  return texts.empty() ? none : fmt::format("{}", fmt::join(texts, ", "));
}

class WinnerPart {
 public:
  WinnerPart(const SectionContext& context, Section& section)
      : context_(context),
        values_(context.values),
        section_(section),
        max_prims_(values_.integers("max_prims_list")),
        work_(counted_work(context)) {
    pattern_ = {values_.integer("winner.max_prims"),
                values_.integer("winner.wins"),
                {values_.integer("only_rises.scenario"), values_.integer("only_rises.spheres")},
                max_prims_.back()};
  }

  void add() {
    if (work_.size() != values_.integers("scenarios").size() * values_.integers("spheres_list").size()) return;
    part_.title = "Where the text's winner wins";
    collect_seeds();
    fit_engines();
    add_words();
    add_diagram();
    add_statements();
    add_leaf_costs();
    add_fits();
    add_claims();
    section_.parts.push_back(std::move(part_));
  }

 private:
  std::string winner_name() const { return tree_name(pattern_.max_prims); }
  std::string stated_wins() const {
    return fmt::format("{} of {}", pattern_.wins, values_.integer("winner.configurations"));
  }

  // One figure for each seed that was counted. A scenario without random numbers is the same with every seed.
  void collect_seeds() {
    for (const std::int64_t scenario : values_.integers("scenarios")) {
      const auto found = context_.results.find(seeds_step(scenario));
      if (found == context_.results.end()) {
        seeds_.clear();
        return;
      }
      seeds_.resize(found->second.size());
      for (std::size_t seed = 0; seed < seeds_.size(); ++seed)
        for (const std::int64_t spheres : values_.integers("spheres_list"))
          seeds_[seed][{scenario, spheres}] = work_from(found->second[seed][fmt::format("spheres{}", spheres)]);
    }
  }

  // Engines whose steps are those that were counted: they use the tree reconstructed from Table 4.2.
  void fit_engines() {
    const auto add = [&](const std::string& name, const EngineTimes& times, double pixels, int threads) {
      const FittedCosts fitted = fit_costs(work_, times, max_prims_, 1e6 / pixels * threads);
      if (fitted.frames > 0) fits_.push_back({name, fitted});
    };
    const auto pixels_of = [&](const std::string& step) {
      const auto found = context_.results.find(step);
      if (found == context_.results.end() || !found->second.contains("width_px")) return 1.0;
      return found->second["width_px"].get<double>() * found->second["height_px"].get<double>();
    };
    const std::int64_t scenario = values_.integers("scenarios").front();
    const std::int64_t spheres = values_.integers("spheres_list").front();
    const int threads = context_.settings.threads > 0 ? context_.settings.threads : hardware_threads();
    add("thesis program", times_of_steps(context_, program_step), pixels_of(program_step(scenario, spheres)), 1);
    for (const ComparedEngine& engine : compared_engines())
      if (engine.engine.tree == Engine::reference)
        add(engine.gpu ? "shader" : engine.name, engine_times(context_, engine),
            pixels_of(configuration_step(engine, scenario, spheres)), engine.gpu ? 1 : threads);
  }

  void add_words() {
    part_.paragraphs = {
        fmt::format(
            "A ray enters inner nodes, enters leaves, and tests the spheres in them. How often it does each is "
            "counted without a clock. What each costs depends on the machine and on the program, and nobody "
            "knows it of the text's phone. Which MAX_PRIMS is the fastest follows from two ratios: what an inner "
            "node costs in sphere tests, and what a leaf costs, apart from its spheres, in inner nodes. The "
            "diagram shows for each pair of ratios how many of the {} configurations {} wins.",
            work_.size(), winner_name()),
        "The tree was reconstructed from the counts of Table 4.2, not from Figure 4.4. So where the diagram agrees "
        "with "
        "the text, this is evidence for both, but no proof: costs at which the text's claim holds are possible, and "
        "the "
        "phone's own are unknown."};
  }

  void add_diagram() {
    CostDiagram diagram;
    diagram.title = fmt::format("Configurations won by {}", winner_name());
    diagram.wins_label = "won:";
    diagram.pattern_label = fmt::format("{} wins {}, {} Scenario {} with {} spheres (seed {})", winner_name(),
                                        pattern_.wins, tree_name(pattern_.exception_max_prims),
                                        pattern_.exception.first, pattern_.exception.second, context_.settings.seed);
    diagram.share_label = fmt::format("the same with at least half of {} seeds", seeds_.size());
    diagram.most_wins = static_cast<int>(work_.size());
    for (int i = 0; i < kColumns; ++i)
      diagram.inner.push_back(kLeastInner * std::pow(kMostInner / kLeastInner, i / (kColumns - 1.0)));
    for (int i = 0; i < kRows; ++i) diagram.leaf.push_back(kMostLeaf * i / (kRows - 1));
    for (const double leaf : diagram.leaf)
      for (const double inner : diagram.inner) {
        diagram.wins.push_back(static_cast<int>(wins_of(work_, pattern_.max_prims, max_prims_, inner, leaf)));
        diagram.pattern.push_back(holds(work_, inner, leaf));
        if (seeds_.empty()) continue;
        const auto with = std::count_if(seeds_.begin(), seeds_.end(),
                                        [&](const FigureWork& seed) { return holds(seed, inner, leaf); });
        diagram.share.push_back(static_cast<double>(with) / static_cast<double>(seeds_.size()));
      }
    for (const auto& [name, fitted] : fits_)
      diagram.points.push_back(
          {name, fitted.costs().inner, fitted.costs().leaf, fitted.inner_error, fitted.leaf_error});

    const auto write = [&](const char* file, const std::string& text) {
      if (const Status status = write_file(context_.folder + "/" + file, text); !status) fail(status.error());
    };
    write("costs.svg", cost_diagram_svg(diagram));
    write("costs.csv", cost_diagram_csv(diagram));
    Json data = {{"inner_node_per_sphere_test", diagram.inner},
                 {"leaf_per_inner_node", diagram.leaf},
                 {"wins", diagram.wins},
                 {"pattern", diagram.pattern},
                 {"share_of_seeds", diagram.share}};
    write("costs.json", data.dump() + "\n");
    part_.illustrations.push_back(
        {"figure-4.4/costs.svg",
         fmt::format("How many of the {} configurations {} wins, over what an inner node and a leaf cost. Points: "
                     "measured engines, by costs fitted to their own times, with standard errors. The same as numbers: "
                     "costs.csv, costs.json.",
                     work_.size(), winner_name())});
  }

  bool holds(const FigureWork& work, double inner, double leaf) const {
    if (wins_of(work, pattern_.max_prims, max_prims_, inner, leaf) != pattern_.wins) return false;
    const auto found = work.find(pattern_.exception);
    return found != work.end() &&
           fastest_range(found->second, pattern_.exception_max_prims, max_prims_, leaf).holds(inner);
  }

  // The largest cost of a leaf at which the pattern holds at some cost of an inner node; less than 0: at none.
  double largest_leaf_cost() const {
    double largest = -1;
    constexpr int kSteps = 200;
    for (int i = 0; i <= kSteps; ++i)
      if (const double leaf = kMostLeaf * i / kSteps; !wins_by_cost(work_, pattern_, max_prims_, leaf).pattern.empty())
        largest = leaf;
    return largest;
  }

  void add_statements() {
    Statements statements(
        "Is there a cost at which the text's winner wins?",
        "Counted without a clock, so without noise. That a frame's time is made of these costs is our "
        "inference, not the text's. As inferred if there are costs at which it is so.");
    const WinsByCost without_leaf = wins_by_cost(work_, pattern_, max_prims_, 0);
    const bool same_number = static_cast<std::int64_t>(work_.size()) == values_.integer("winner.configurations");
    const bool wins = !without_leaf.stated.empty() && same_number;
    statements.add(
        "counts.winner", fmt::format("{} is the best in {}, at some costs", winner_name(), stated_wins()),
        {"in " + stated_wins(), ValueKind::inferred},
        wins ? fmt::format(
                   "yes: where a leaf costs nothing apart from its spheres, with an inner node at {} sphere tests",
                   ranges_text(without_leaf.stated, ""))
             : fmt::format("no: at most in {} of {}, with an inner node at {} sphere tests", without_leaf.most,
                           work_.size(), ranges_text(without_leaf.most_at, "")),
        verdict_if(wins));
    // The configuration that the text excepts. Without costs at which the winner wins there is nothing to compare.
    if (work_.count(pattern_.exception) > 0) {
      const double largest = wins ? largest_leaf_cost() : -1;
      statements.add(
          "counts.only_rises",
          fmt::format("The same, and {} is the best for Scenario {} with {} spheres",
                      tree_name(pattern_.exception_max_prims), pattern_.exception.first, pattern_.exception.second),
          {"at the same costs", ValueKind::inferred},
          !wins         ? "not judged, as there are no such costs"
          : largest < 0 ? "at no costs"
                        : fmt::format("yes: with an inner node at {} sphere tests where a leaf costs nothing "
                                      "apart from its spheres, and up to a leaf of {:.2f} inner nodes",
                                      ranges_text(without_leaf.pattern, "none"), largest),
          wins ? verdict_if(largest >= 0) : Verdict::none);
    }
    finish(statements);
  }

  void finish(Statements& statements) {
    section_.data["statements_counts"] = statements.data();
    statements.move_into(section_);
    part_.tables.push_back(std::move(section_.tables.back()));
    section_.tables.pop_back();
  }

  void add_leaf_costs() {
    Table table{"The same over the cost of a leaf",
                {"A leaf costs, in inner nodes", winner_name() + " wins at most",
                 fmt::format("An inner node, in sphere tests, at which it wins {}", stated_wins()),
                 "At which the whole pattern holds"},
                {},
                ""};
    if (!seeds_.empty()) table.columns.push_back(fmt::format("Seeds with the pattern, of {}", seeds_.size()));
    Json rows = Json::array();
    for (const double leaf : kLeafCosts) {
      const WinsByCost found = wins_by_cost(work_, pattern_, max_prims_, leaf);
      const auto seeds = std::count_if(seeds_.begin(), seeds_.end(), [&](const FigureWork& seed) {
        return !wins_by_cost(seed, pattern_, max_prims_, leaf).pattern.empty();
      });
      std::vector<Cell> row{{fmt::format("{:g}", leaf)},
                            {fmt::format("{} of {}", found.most, work_.size())},
                            {ranges_text(found.stated, "none")},
                            {ranges_text(found.pattern, "none")}};
      if (!seeds_.empty()) row.push_back({std::to_string(seeds)});
      table.rows.push_back(std::move(row));
      Json ranges = Json::array();
      for (const CostRange& range : found.pattern)
        ranges.push_back({range.low, std::isinf(range.high) ? Json() : Json(range.high)});
      rows.push_back({{"leaf", leaf}, {"most_wins", found.most}, {"pattern", std::move(ranges)}, {"seeds", seeds}});
    }
    table.note = fmt::format(
        "The bounds are exact for the counts of seed {}. The whole pattern: {} wins {}, and {} wins Scenario {} with "
        "{} "
        "spheres.",
        context_.settings.seed, winner_name(), stated_wins(), tree_name(pattern_.exception_max_prims),
        pattern_.exception.first, pattern_.exception.second);
    section_.data["leaf_costs"] = std::move(rows);
    part_.tables.push_back(std::move(table));
  }

  void add_fits() {
    if (fits_.empty()) return;
    Table table{"What the steps cost here",
                {"Engine", "Ray, fixed (ns)", "Inner node (ns)", "Leaf (ns)", "Sphere test (ns)",
                 "Inner node / sphere test", "Leaf / inner node", "Error of a frame", winner_name() + " wins"},
                {},
                ""};
    Json rows = Json::array();
    for (const auto& [name, fitted] : fits_) {
      const StepCosts costs = fitted.costs();
      const std::int64_t wins = wins_of(work_, pattern_.max_prims, max_prims_, costs.inner, costs.leaf);
      table.rows.push_back({{name},
                            {fmt::format("{:.1f}", fitted.fixed_ns)},
                            {fmt::format("{:.2f}", fitted.inner_ns)},
                            {fmt::format("{:.2f}", fitted.leaf_ns)},
                            {fmt::format("{:.2f}", fitted.test_ns)},
                            {fmt::format("{:.2f} ± {:.2f}", costs.inner, fitted.inner_error)},
                            {fmt::format("{:.2f} ± {:.2f}", costs.leaf, fitted.leaf_error)},
                            {fmt::format("{:.0f} %", 100 * fitted.rms)},
                            {fmt::format("{} of {}", wins, work_.size())}});
      rows.push_back({{"engine", name},
                      {"fixed_ns", fitted.fixed_ns},
                      {"inner_ns", fitted.inner_ns},
                      {"leaf_ns", fitted.leaf_ns},
                      {"test_ns", fitted.test_ns},
                      {"inner_per_test", costs.inner},
                      {"inner_per_test_error", fitted.inner_error},
                      {"leaf_per_inner", costs.leaf},
                      {"leaf_per_inner_error", fitted.leaf_error},
                      {"rms", fitted.rms},
                      {"frames", fitted.frames},
                      {"wins", wins}});
    }
    table.note =
        "Least squares of the relative error over brute force and the thesis's values of MAX_PRIMS in all "
        "configurations; no cost is below 0. Per ray and thread. The reference engine decides every sphere test in "
        "binary64, so its tests are dear and its ratio is low. The thesis program is a plain loop in binary32 on one "
        "thread, as a program of that time might be";
    if (const std::int64_t differ = pixels_that_differ(); differ >= 0)
      table.note += fmt::format(
          "; at most {} of its pixels in a picture show another sphere than the reference engine's", differ);
    table.note += ".";
    section_.data["fitted_costs"] = std::move(rows);
    part_.tables.push_back(std::move(table));
  }

  std::int64_t pixels_that_differ() const {
    std::int64_t most = -1;
    for (const auto& [name, result] : context_.results)
      if (result.is_object() && result.contains("pixels_that_differ"))
        most = std::max(most, result["pixels_that_differ"].get<std::int64_t>());
    return most;
  }

  // The number of claims that agree with the text.
  std::size_t agreeing(const StepCosts& costs) const {
    const std::vector<Judgement> rows = judge_frame_rates(predicted_times(work_, costs), values_);
    return static_cast<std::size_t>(
        std::count_if(rows.begin(), rows.end(), [](const Judgement& row) { return row.verdict == Verdict::agrees; }));
  }

  // The asked costs; else the costs within the pattern that suit most of the text's claims, the lowest of equal ones.
  std::optional<StepCosts> chosen_costs() const {
    const std::vector<double>& asked = context_.settings.costs;
    if (asked.size() == 3) return StepCosts{asked[0], asked[1], asked[2]};
    std::optional<StepCosts> best;
    std::size_t most = 0;
    for (const CostRange& range : wins_by_cost(work_, pattern_, max_prims_, 0).pattern)
      for (int i = 0; i < kTries && std::isfinite(range.high); ++i) {
        const StepCosts costs{range.low + (range.high - range.low) * (i + 0.5) / kTries, 0, 1};
        const std::size_t agree = agreeing(costs);
        if (best && agree <= most) continue;
        best = costs;
        most = agree;
      }
    return best;
  }

  void add_claims() {
    const std::optional<StepCosts> costs = chosen_costs();
    if (!costs) return;
    const bool asked = !context_.settings.costs.empty();
    Table table{
        fmt::format("All claims at one point: an inner node {:.2f} sphere tests, a leaf {:.2f} inner nodes, a ray "
                    "{:.2f} sphere tests",
                    costs->inner, costs->leaf, costs->fixed),
        {"Claim", "Text", "From the counts"},
        {},
        ""};
    std::size_t agree = 0, all = 0;
    Json rows = Json::array();
    for (const Judgement& row : judge_frame_rates(predicted_times(work_, *costs), values_)) {
      table.rows.push_back({{row.statement}, {row.expected.text}, {row.ours, row.verdict, ValueKind::inferred}});
      rows.push_back({{"name", row.name}, {"ours", row.ours}, {"verdict", name_of(row.verdict)}});
      if (row.verdict == Verdict::agrees) ++agree;
      ++all;
    }
    table.note = fmt::format(
        "{} of {} agree. {} Predicted frame rates have a unit of their own; gains and order are what they say. Other "
        "costs: --costs INNER,LEAF,FIXED.",
        agree, all,
        asked ? "The costs are those of the command line."
              : "The costs are fitted to the text: of those at which the pattern holds, with a leaf at 0 and a fixed "
                "part "
                "of one sphere test, they suit most claims. No machine was measured at them.");
    section_.data["claims_at_costs"] = {
        {"costs", {costs->inner, costs->leaf, costs->fixed}}, {"asked", asked}, {"agree", agree}, {"claims", rows}};
    part_.tables.push_back(std::move(table));
  }

  const SectionContext& context_;
  const Values& values_;
  Section& section_;
  Section part_;
  std::vector<std::int64_t> max_prims_;
  FigureWork work_;
  std::vector<FigureWork> seeds_;
  WinPattern pattern_;
  std::vector<std::pair<std::string, FittedCosts>> fits_;
};

}  // namespace

void add_winner(const SectionContext& context, Section& section) {
  WinnerPart(context, section).add();
}

}  // namespace bihive::cli::thesis
