// Repeated measurements: their spreads, over seeds and over rounds; of trees, what explains their differences.
#pragma once

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "bihive/base/parallel.h"
#include "bihive/bih/tree.h"
#include "bihive/math/quartiles.h"
#include "experiment.h"

namespace bihive::thesis {

inline Json mean_and_sd_json(const std::vector<double>& values) {
  const MeanAndSd all = mean_and_sd(values);
  return {{"mean", all.mean}, {"sd", all.sd}};
}

/// Element by element, as many as both have.
inline std::vector<double> ratios_of(const std::vector<double>& above, const std::vector<double>& below) {
  std::vector<double> ratios(std::min(above.size(), below.size()));
  std::transform(above.begin(), above.begin() + std::ssize(ratios), below.begin(), ratios.begin(), std::divides<>());
  return ratios;
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

/// The properties of trees by which the text explains its results: spheres per leaf and their variation, the frequency
/// of overlaps and gaps between children, and the empty space cut off. [{"scenario", "spheres", "max_prims", "seeds",
/// "spheres_per_leaf", "spheres_per_leaf_sd", "depth_sd", "overlap_percent", "gap_percent", "void_percent",
/// "void_percent_by_level", "coinciding"}]: means over the seeds 1, 2, ... of all trees of these scenarios, numbers of
/// spheres and MAX_PRIMS. Deviations are over the leaves of a tree; overlaps and gaps are percent of the split nodes.
/// Void is the exact volume, in percent of the root's box, that no node of a level covers (and no leaf above it): by
/// level from the root on, and on the tenth. Empty if cancelled.
Json measure_reasons(const Experiment& experiment, const std::vector<std::int64_t>& spheres,
                     const std::vector<std::int64_t>& max_prims, std::int64_t seeds);

/// Percent of the split nodes whose children overlap.
double overlap_percent(const Tree& tree);

}  // namespace bihive::thesis
