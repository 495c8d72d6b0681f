#include "bihive/compare/cost_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "bihive/math/least_squares.h"

namespace bihive::workbench {

CostFit fit_costs(const std::vector<TimedWork>& groups) {
  constexpr std::size_t kLeastGroups = 8;  // twice the unknowns
  if (groups.size() < kLeastGroups) return {};
  std::vector<std::array<double, 4>> rows;
  for (const TimedWork& one : groups)
    rows.push_back({1 / one.ns, one.inner / one.ns, one.leaves / one.ns, one.test_steps / one.ns});
  // Bring the columns to one size, because the solver compares pivots with a fixed number.
  std::array<double, 4> size{};
  for (const auto& row : rows)
    for (std::size_t i = 0; i < 4; ++i) size[i] = std::max(size[i], row[i]);
  for (auto& row : rows)
    for (std::size_t i = 0; i < 4; ++i) row[i] = size[i] > 0 ? row[i] / size[i] : 0;
  const LeastSquares<4> best = nonnegative_least_squares(rows);
  if (!std::isfinite(best.residual)) return {};
  const auto cost = [&](std::size_t i) { return size[i] > 0 ? best.unknowns[i] / size[i] : 0; };
  CostFit fit{cost(0), cost(1), cost(2), cost(3)};
  fit.groups = static_cast<std::int64_t>(groups.size());
  fit.rms = std::sqrt(best.residual / static_cast<double>(rows.size()));

  // Compare the squared errors with those of a constant time.
  double mean = 0, errors = 0, spread = 0;
  for (const TimedWork& one : groups) mean += one.ns / static_cast<double>(groups.size());
  for (const TimedWork& one : groups) {
    errors += (fit.ns_of(one) - one.ns) * (fit.ns_of(one) - one.ns);
    spread += (one.ns - mean) * (one.ns - mean);
  }
  if (spread > 0) fit.explained = 1 - errors / spread;
  return fit;
}

TimedWork mean_work(const std::vector<Work>& works, const std::vector<std::int64_t>& chosen) {
  TimedWork mean;
  for (const std::int64_t i : chosen) {
    const Work& work = works[static_cast<std::size_t>(i)];
    mean.inner += static_cast<double>(work.nodes - work.leaves);
    mean.leaves += static_cast<double>(work.leaves);
    mean.test_steps += static_cast<double>(work.test_steps);
  }
  const auto count = static_cast<double>(chosen.size());
  mean.inner /= count, mean.leaves /= count, mean.test_steps /= count;
  return mean;
}

std::vector<std::vector<std::int64_t>> groups_by_work(const std::vector<Work>& works, std::int64_t count) {
  constexpr std::int64_t kLeastQueries = 16;
  if (std::ssize(works) < kLeastQueries * count) return {};
  std::vector<std::int64_t> order(works.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](std::int64_t a, std::int64_t b) {
    return works[static_cast<std::size_t>(a)].cost() < works[static_cast<std::size_t>(b)].cost();
  });
  std::vector<std::vector<std::int64_t>> groups;
  for (std::int64_t g = 0; g < count; ++g) {
    const auto at = [&](std::int64_t k) { return order.begin() + static_cast<std::ptrdiff_t>(k); };
    groups.emplace_back(at(g * std::ssize(works) / count), at((g + 1) * std::ssize(works) / count));
    std::sort(groups.back().begin(), groups.back().end());
  }
  return groups;
}

double correlation_of(const std::vector<std::pair<double, double>>& pairs) {
  if (pairs.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  double x = 0, y = 0;
  for (const auto& [a, b] : pairs) x += a, y += b;
  x /= static_cast<double>(pairs.size()), y /= static_cast<double>(pairs.size());
  double xx = 0, yy = 0, xy = 0;
  for (const auto& [a, b] : pairs) xx += (a - x) * (a - x), yy += (b - y) * (b - y), xy += (a - x) * (b - y);
  return xy / std::sqrt(xx * yy);
}

}  // namespace bihive::workbench
