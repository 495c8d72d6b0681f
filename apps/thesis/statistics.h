// Repeated measurements: their spreads, over seeds and over rounds.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/math/quartiles.h"
#include "experiment.h"

namespace bihive::thesis {

/// Mean and sample standard deviation; the deviation of a single value is 0.
struct Spread {
  double mean = 0, sd = 0;
  Json json() const { return {{"mean", mean}, {"sd", sd}}; }
};
inline Spread spread_of(const std::vector<double>& values) {
  if (values.empty()) return {};
  const double n = static_cast<double>(values.size());
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  for (const double value : values) squares += (value - sum / n) * (value - sum / n);
  return {sum / n, values.size() > 1 ? std::sqrt(squares / (n - 1)) : 0};
}

inline Json quartiles_json(const std::vector<double>& values) {
  const Quartiles all = quartiles_of(values);
  return {{"lower", all.lower}, {"median", all.median}, {"upper", all.upper}};
}

/// The results of `of` for the seeds 1, 2, ..., whatever --seed says. The grid of Scenario 1 is not random, and has one
/// seed. Only the first call may fail.
template <class Of>
auto over_seeds(const Experiment& experiment, std::int64_t scenario, std::int64_t seeds, const Of& of) {
  std::vector<decltype(of(std::uint64_t{1}))> found{of(1)};
  if (scenario_of(scenario) != Scenario::grid) found.resize(static_cast<std::size_t>(seeds), found.front());
  parallel_for(experiment.settings.threads, static_cast<std::int64_t>(found.size()) - 1, [&](std::int64_t i) {
    if (!experiment.cancel.cancelled()) found[static_cast<std::size_t>(i + 1)] = of(static_cast<std::uint64_t>(i + 2));
  });
  return found;
}

/// {name: milliseconds of this thread's processor time, one per round}, in turns, so that a machine that slows down
/// favours none: every other round runs backwards. A first round warms up and does not count. Null if cancelled.
using Contestants = std::vector<std::pair<std::string, std::function<void()>>>;
Json times_in_turns(const Experiment& experiment, int rounds, const Contestants& contestants);

}  // namespace bihive::thesis
