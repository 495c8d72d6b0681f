// The costs of a structure's steps on this machine, fitted to the times of groups of queries.
#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "bihive/compare/structure.h"

namespace bihive::workbench {

/// Queries of one kind that take a similar number of steps: means per query.
struct TimedWork {
  double inner = 0, leaves = 0, test_steps = 0;
  double ns = 0;  ///< > 0
};

/// time = fixed + inner nodes * inner + leaves * leaf + test steps * test: nanoseconds on one thread, by least
/// squares of the relative error, none of them negative. Box tests have no cost of their own: in a tree they are in a
/// fixed proportion to inner nodes.
struct CostFit {
  double fixed_ns = 0, inner_ns = 0, leaf_ns = 0, test_ns = 0;
  double rms = 0;  ///< relative error of a group's time
  /// The share of the variance of times that the counts explain (the coefficient of determination); negative where a
  /// constant time would fit better. NaN where all times are equal.
  double explained = std::numeric_limits<double>::quiet_NaN();
  std::int64_t groups = 0;  ///< 0: fewer than eight, and no fit

  bool found() const { return groups > 0; }
  double ns_of(const TimedWork& work) const {
    return fixed_ns + work.inner * inner_ns + work.leaves * leaf_ns + work.test_steps * test_ns;
  }
};

CostFit fit_costs(const std::vector<TimedWork>& groups);

/// The mean steps of the queries that `chosen` lists; ns is left at 0.
TimedWork mean_work(const std::vector<Work>& works, const std::vector<std::int64_t>& chosen);

/// The queries in `count` groups of one size, from those with the least steps (Work::cost()) on; in a group they keep
/// their order. Without groups of 16 queries: none.
std::vector<std::vector<std::int64_t>> groups_by_work(const std::vector<Work>& works, std::int64_t count);

/// Pearson's r of pairs; NaN with fewer than three, or without a spread.
double correlation_of(const std::vector<std::pair<double, double>>& pairs);

}  // namespace bihive::workbench
