#include "bihive/thesis/cost_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>

#include "bihive/math/quartiles.h"

namespace bihive {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Two sums of costs that differ by rounding alone are equal.
constexpr double kRounding = 1e-12;

double nodes_of(const RayWork& work, double leaf) {
  return work.inner + leaf * work.leaves;
}

// All costs of an inner node at which two trees of a configuration are equal, from low to high; first 0.
std::vector<double> changes_of(const FigureWork& work, const std::vector<std::int64_t>& among, double leaf) {
  std::set<double> found{0};
  for (const auto& [configuration, trees] : work)
    for (const std::int64_t a : among)
      for (const std::int64_t b : among) {
        if (trees.count(a) == 0 || trees.count(b) == 0) continue;
        const double nodes = nodes_of(trees.at(b), leaf) - nodes_of(trees.at(a), leaf);
        const double cost = (trees.at(a).tests - trees.at(b).tests) / nodes;
        if (nodes != 0 && cost > 0 && std::isfinite(cost)) found.insert(cost);
      }
  return {found.begin(), found.end()};
}

// Appends, and joins what touches the last one.
void append(std::vector<CostRange>& ranges, const CostRange& next) {
  if (!ranges.empty() && ranges.back().high == next.low)
    ranges.back().high = next.high;
  else
    ranges.push_back(next);
}

// Four unknowns: fixed part, inner node, leaf, sphere test.
constexpr std::size_t kUnknowns = 4;
using Row = std::array<double, kUnknowns>;
using Matrix = std::array<Row, kUnknowns>;

// The inverse of the rows and columns that are in use; the others stay 0. Nothing if it is singular.
std::optional<Matrix> inverse(Matrix a, const std::array<bool, kUnknowns>& used) {
  Matrix result{};
  for (std::size_t i = 0; i < kUnknowns; ++i) {
    result[i][i] = used[i] ? 1 : 0;
    for (std::size_t j = 0; j < kUnknowns; ++j)
      if (!used[i] || !used[j]) a[i][j] = i == j ? 1 : 0;
  }
  // Gauss and Jordan; the matrix is symmetric and positive, so the diagonal serves as pivot.
  for (std::size_t pivot = 0; pivot < kUnknowns; ++pivot) {
    if (!(std::abs(a[pivot][pivot]) > 1e-14)) return std::nullopt;
    const double scale = 1 / a[pivot][pivot];
    for (std::size_t j = 0; j < kUnknowns; ++j) a[pivot][j] *= scale, result[pivot][j] *= scale;
    for (std::size_t i = 0; i < kUnknowns; ++i) {
      if (i == pivot) continue;
      const double factor = a[i][pivot];
      for (std::size_t j = 0; j < kUnknowns; ++j) {
        a[i][j] -= factor * a[pivot][j];
        result[i][j] -= factor * result[pivot][j];
      }
    }
  }
  return result;
}

struct Solution {
  Row cost{};
  Matrix covariance{};  // without the variance of a frame
  double residual = kInfinity;
};

}  // namespace

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

CostRange fastest_range(const WorkByTree& trees, std::int64_t max_prims, const std::vector<std::int64_t>& among,
                        double leaf) {
  CostRange range;
  if (trees.count(max_prims) == 0) return {0, -1};  // it was not counted
  const RayWork& mine = trees.at(max_prims);
  for (const std::int64_t other : among) {
    if (other == max_prims || trees.count(other) == 0) continue;
    // mine.tests + cost * my nodes <= other.tests + cost * the other's nodes
    const double nodes = nodes_of(trees.at(other), leaf) - nodes_of(mine, leaf);
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

std::int64_t wins_of(const FigureWork& work, std::int64_t max_prims, const std::vector<std::int64_t>& among,
                     double inner, double leaf) {
  const StepCosts costs{inner, leaf, 0};
  std::int64_t wins = 0;
  for (const auto& [configuration, trees] : work) {
    double least = kInfinity;
    for (const std::int64_t other : among)
      if (const auto found = trees.find(other); found != trees.end()) least = std::min(least, costs.of(found->second));
    const auto mine = trees.find(max_prims);
    if (mine != trees.end() && costs.of(mine->second) <= least * (1 + kRounding)) ++wins;
  }
  return wins;
}

WinsByCost wins_by_cost(const FigureWork& work, const WinPattern& pattern, const std::vector<std::int64_t>& among,
                        double leaf) {
  CostRange of_exception{0, -1};
  if (const auto found = work.find(pattern.exception); found != work.end())
    of_exception = fastest_range(found->second, pattern.exception_max_prims, among, leaf);

  WinsByCost result;
  const std::vector<double> changes = changes_of(work, among, leaf);
  for (std::size_t i = 0; i < changes.size(); ++i) {
    const bool last = i + 1 == changes.size();
    const CostRange between{changes[i], last ? kInfinity : changes[i + 1]};
    const double inside = last ? 2 * changes[i] + 1 : changes[i] + (changes[i + 1] - changes[i]) / 2;
    const std::int64_t wins = wins_of(work, pattern.max_prims, among, inside, leaf);
    result.most = std::max(result.most, wins);
    if (wins != pattern.wins) continue;
    append(result.stated, between);
    if (of_exception.holds(inside)) append(result.pattern, between);
  }
  return result;
}

FittedCosts fit_costs(const FigureWork& work, const EngineTimes& times, const std::vector<std::int64_t>& among,
                      double ns_per_ms) {
  // A row for each frame: the work of a ray over its time, so that the sum of costs should be 1.
  std::vector<Row> rows;
  const auto add = [&](const RayWork& one, const std::vector<double>& rounds) {
    const double ns = median(rounds) * ns_per_ms;
    if (ns > 0) rows.push_back({1 / ns, one.inner / ns, one.leaves / ns, one.tests / ns});
  };
  for (const auto& [configuration, measured] : times) {
    const auto counted = work.find(configuration);
    if (counted == work.end()) continue;
    add({0, 0, static_cast<double>(configuration.second)}, measured.brute);
    for (const auto& [max_prims, rounds] : measured.trees)
      if (std::find(among.begin(), among.end(), max_prims) != among.end() && counted->second.count(max_prims) > 0)
        add(counted->second.at(max_prims), rounds);
  }
  FittedCosts fitted;
  if (rows.size() < 2 * kUnknowns) return fitted;

  // The best solution without a negative cost: each set of costs that are not 0 is tried.
  Solution best;
  for (unsigned set = 1; set < (1U << kUnknowns); ++set) {
    std::array<bool, kUnknowns> used{};
    for (std::size_t i = 0; i < kUnknowns; ++i) used[i] = ((set >> i) & 1U) != 0;
    Matrix normal{};
    Row right{};
    for (const Row& row : rows)
      for (std::size_t i = 0; i < kUnknowns; ++i) {
        right[i] += row[i];
        for (std::size_t j = 0; j < kUnknowns; ++j) normal[i][j] += row[i] * row[j];
      }
    const std::optional<Matrix> inverted = inverse(normal, used);
    if (!inverted) continue;
    Solution one;
    one.covariance = *inverted;
    for (std::size_t i = 0; i < kUnknowns; ++i)
      for (std::size_t j = 0; j < kUnknowns; ++j)
        if (used[i] && used[j]) one.cost[i] += (*inverted)[i][j] * right[j];
    if (std::any_of(one.cost.begin(), one.cost.end(), [](double cost) { return cost < 0; })) continue;
    one.residual = 0;
    for (const Row& row : rows) {
      double sum = -1;
      for (std::size_t i = 0; i < kUnknowns; ++i) sum += row[i] * one.cost[i];
      one.residual += sum * sum;
    }
    if (one.residual < best.residual) best = one;
  }
  const auto [fixed, inner, leaf, test] = best.cost;
  if (!(test > 0)) return fitted;

  // Errors of the two ratios, to first order.
  const double variance = best.residual / static_cast<double>(rows.size() - kUnknowns);
  const auto ratio_error = [&](std::size_t above, std::size_t below) {
    const double a = best.cost[above], b = best.cost[below];
    if (!(b > 0)) return 0.0;
    const double relative = best.covariance[above][above] + a * a / (b * b) * best.covariance[below][below] -
                            2 * a / b * best.covariance[above][below];
    return std::sqrt(std::max(0.0, relative * variance)) / b;
  };
  fitted = {fixed, inner, leaf, test, ratio_error(1, 3), ratio_error(2, 1), 0, rows.size()};
  fitted.rms = std::sqrt(best.residual / static_cast<double>(rows.size()));
  return fitted;
}

}  // namespace bihive
