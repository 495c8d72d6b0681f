#include "bihive/thesis/cost_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <string>

#include "bihive/math/least_squares.h"
#include "bihive/math/quartiles.h"

namespace bihive {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Two sums of costs that differ by rounding alone are equal.
constexpr double kRounding = 1e-12;

bool is_fastest(const WorkByTree& trees, std::int64_t max_prims, const WinPattern& pattern, const StepCosts& costs) {
  const auto mine = trees.find(max_prims);
  if (mine == trees.end()) return false;  // not counted
  const StepCosts of_tree{costs.inner, costs.leaf, 0};
  return std::all_of(pattern.among.begin(), pattern.among.end(), [&](std::int64_t other) {
    const auto found = trees.find(other);
    return found == trees.end() || of_tree.of(mine->second) <= of_tree.of(found->second) * (1 + kRounding);
  });
}

// All costs of an inner node at which two trees of a configuration are equal; first 0.
std::set<double> changes_of(const FigureWork& work, const WinPattern& pattern, double leaf) {
  std::set<double> found{0};
  for (const auto& [configuration, trees] : work)
    for (const std::int64_t a : pattern.among)
      for (const std::int64_t b : pattern.among) {
        if (trees.count(a) == 0 || trees.count(b) == 0) continue;
        const RayWork &one = trees.at(a), &other = trees.at(b);
        const double nodes = other.inner + leaf * other.leaves - (one.inner + leaf * one.leaves);
        const double cost = (one.tests - other.tests) / nodes;
        if (nodes != 0 && cost > 0 && std::isfinite(cost)) found.insert(cost);
      }
  return found;
}

// Appends a range; merges it with the last one if they touch.
void append(std::vector<CostRange>& ranges, const CostRange& next) {
  if (!ranges.empty() && ranges.back().high == next.low)
    ranges.back().high = next.high;
  else
    ranges.push_back(next);
}

// Whether the standard error of a ratio leaves anything to say.
bool is_determined(double ratio, double error) {
  return error <= std::max(1.0, ratio);
}

}  // namespace

std::string tree_name(std::int64_t max_prims) {
  return "BIH " + std::to_string(max_prims);
}

double frames_per_second(const std::vector<double>& frame_ms) {
  return 1000 / median(frame_ms);
}

std::int64_t ConfigurationTimes::fastest() const {
  std::int64_t best = 0;
  for (const auto& [prims, ms] : trees)
    if (best == 0 || median(ms) < median(trees.at(best))) best = prims;
  return best;
}

double ConfigurationTimes::gain_percent() const {
  return 100 * (frames_per_second(trees.at(fastest())) / frames_per_second(brute) - 1);
}

Result<WinPattern> stated_pattern(const StatedValues& values) {
  WinPattern pattern;
  for (const auto& [name, number] : {std::pair{"winner.max_prims", &pattern.max_prims},
                                     {"winner.wins", &pattern.wins},
                                     {"only_rises.scenario", &pattern.exception.first},
                                     {"only_rises.spheres", &pattern.exception.second}}) {
    const Result<std::int64_t> value = values.integer(name);
    if (!value) return value.error();
    *number = *value;
  }
  Result<std::vector<std::int64_t>> among = values.integers("max_prims_list");
  if (!among) return among.error();
  pattern.exception_max_prims = among->back();
  pattern.among = std::move(*among);
  return pattern;
}

std::int64_t wins_of(const FigureWork& work, const WinPattern& pattern, const StepCosts& costs) {
  return std::count_if(work.begin(), work.end(),
                       [&](const auto& each) { return is_fastest(each.second, pattern.max_prims, pattern, costs); });
}

bool pattern_holds(const FigureWork& work, const WinPattern& pattern, const StepCosts& costs) {
  const auto exception = work.find(pattern.exception);
  return wins_of(work, pattern, costs) == pattern.wins && exception != work.end() &&
         is_fastest(exception->second, pattern.exception_max_prims, pattern, costs);
}

WinsByCost wins_by_cost(const FigureWork& work, const WinPattern& pattern, double leaf) {
  WinsByCost result;
  const std::set<double> changes = changes_of(work, pattern, leaf);
  for (auto change = changes.begin(); change != changes.end(); ++change) {
    const bool last = std::next(change) == changes.end();
    const CostRange between{*change, last ? kInfinity : *std::next(change)};
    const StepCosts inside{last ? 2 * between.low + 1 : between.low + (between.high - between.low) / 2, leaf, 0};
    const std::int64_t wins = wins_of(work, pattern, inside);
    result.most = std::max(result.most, wins);
    if (wins == pattern.wins) append(result.stated, between);
    if (pattern_holds(work, pattern, inside)) append(result.pattern, between);
  }
  return result;
}

std::vector<std::pair<const char*, double>> FittedCosts::named() const {
  return {{"fixed_ns", fixed_ns},
          {"inner_ns", inner_ns},
          {"leaf_ns", leaf_ns},
          {"test_ns", test_ns},
          {"inner_per_test", costs().inner},
          {"inner_per_test_error", inner_error},
          {"leaf_per_inner", costs().leaf},
          {"leaf_per_inner_error", leaf_error}};
}

bool FittedCosts::determined() const {
  return inner_ns > 0 && is_determined(costs().inner, inner_error) && is_determined(costs().leaf, leaf_error);
}

CostWords cost_words(double inner, double inner_error, double leaf, double leaf_error) {
  const auto words = [](double ratio, double error) -> std::string {
    if (ratio == 0) return "0 (at its bound)";
    if (!is_determined(ratio, error)) return "not determined by these frames";
    return fmt::format("{:.2f} ± {:.2f}", ratio, error);
  };
  return {words(inner, inner_error), inner == 0 ? "not determined by these frames" : words(leaf, leaf_error)};
}

FittedCosts fit_costs(const FigureWork& work, const EngineTimes& times, double ns_per_ms) {
  // A row for each frame: the work of a ray over its time, so that the sum of costs should be 1.
  std::vector<std::array<double, 4>> rows;
  const auto add = [&](const RayWork& one, const std::vector<double>& rounds) {
    const double ns = median(rounds) * ns_per_ms;
    if (ns > 0) rows.push_back({1 / ns, one.inner / ns, one.leaves / ns, one.tests / ns});
  };
  for (const auto& [configuration, measured] : times) {
    const auto counted = work.find(configuration);
    if (counted == work.end()) continue;
    add({0, 0, static_cast<double>(configuration.second)}, measured.brute);
    for (const auto& [max_prims, rounds] : measured.trees)
      if (counted->second.count(max_prims) > 0) add(counted->second.at(max_prims), rounds);
  }
  if (rows.size() < 8) return {};
  const LeastSquares<4> best = nonnegative_least_squares(rows);
  const auto [fixed, inner, leaf, test] = best.unknowns;
  if (!(test > 0)) return {};

  // Errors of the two ratios, to first order.
  const double variance = best.residual / static_cast<double>(rows.size() - 4);
  const auto ratio_error = [&](std::size_t above, std::size_t below) {
    const double a = best.unknowns[above], b = best.unknowns[below];
    if (!(b > 0)) return 0.0;
    const double relative = best.covariance[above][above] + a * a / (b * b) * best.covariance[below][below] -
                            2 * a / b * best.covariance[above][below];
    return std::sqrt(std::max(0.0, relative * variance)) / b;
  };
  const double rms = std::sqrt(best.residual / static_cast<double>(rows.size()));
  return {fixed, inner, leaf, test, ratio_error(1, 3), ratio_error(2, 1), rms, rows.size()};
}

}  // namespace bihive
