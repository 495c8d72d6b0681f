// A model of a frame's time: the counted work of its rays, times the cost of each kind of step.
//
// A leaf is charged separately from its spheres. Which tree is the fastest depends on two ratios alone: the cost of an
// inner node in sphere tests, and the cost of a leaf in inner nodes.
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bihive/thesis/stated_values.h"

namespace bihive {

/// Means per primary ray of the picture.
struct RayWork {
  double inner = 0;   ///< inner nodes entered
  double leaves = 0;  ///< leaves entered
  double tests = 0;   ///< spheres tested

  RayWork& operator+=(const RayWork& other) {
    inner += other.inner;
    leaves += other.leaves;
    tests += other.tests;
    return *this;
  }
};

/// Costs of the steps of a ray.
struct StepCosts {
  double inner = 1;  ///< an inner node, in sphere tests; >= 0
  double leaf = 0;   ///< a leaf without its spheres, in inner nodes; >= 0
  double fixed = 1;  ///< everything that no tree saves, in sphere tests per ray; >= 0

  /// Cost of one ray, in sphere tests.
  double of(const RayWork& work) const { return fixed + inner * (work.inner + leaf * work.leaves) + work.tests; }
};

using Configuration = std::pair<std::int64_t, std::int64_t>;  ///< scenario, number of spheres
using WorkByTree = std::map<std::int64_t, RayWork>;           ///< by MAX_PRIMS
using FigureWork = std::map<Configuration, WorkByTree>;

/// Milliseconds of a frame, one per round.
struct ConfigurationTimes {
  std::vector<double> brute;
  std::map<std::int64_t, std::vector<double>> trees;  ///< by MAX_PRIMS

  /// MAX_PRIMS of the tree that is the fastest by the median of its rounds; 0 without trees.
  std::int64_t fastest() const;
  /// The gain of that tree over brute force, in percent.
  double gain_percent() const;
};
using EngineTimes = std::map<Configuration, ConfigurationTimes>;

/// The name of a tree in charts and tables: "BIH 8".
std::string tree_name(std::int64_t max_prims);

/// Frames per second by the median of the rounds.
double frames_per_second(const std::vector<double>& frame_ms);

/// The text's pattern: one MAX_PRIMS wins an exact number of configurations, and another wins a certain configuration.
struct WinPattern {
  std::int64_t max_prims = 0, wins = 0;
  Configuration exception;
  std::int64_t exception_max_prims = 0;
  std::vector<std::int64_t> among;  ///< the MAX_PRIMS that compete
};
/// Values winner.* and only_rises.*, the last of max_prims_list. Error: one is missing.
Result<WinPattern> stated_pattern(const StatedValues& values);

/// The number of configurations that the pattern's tree wins, ties included. The fixed part does not matter.
std::int64_t wins_of(const FigureWork& work, const WinPattern& pattern, const StepCosts& costs);

/// Whether the whole pattern holds.
bool pattern_holds(const FigureWork& work, const WinPattern& pattern, const StepCosts& costs);

/// Ascending bounds.
struct CostRange {
  double low = 0, high = std::numeric_limits<double>::infinity();
};

/// The results of the pattern's tree at a leaf's cost, over all costs of an inner node. The bounds are exact: between
/// two costs at which two trees are equal nothing changes.
struct WinsByCost {
  std::int64_t most = 0;           ///< configurations won at most
  std::vector<CostRange> stated;   ///< where it wins as many as the pattern says
  std::vector<CostRange> pattern;  ///< where the whole pattern holds
};
WinsByCost wins_by_cost(const FigureWork& work, const WinPattern& pattern, double leaf);

/// The two ratios of a fit with their standard errors, "3.34 ± 0.12". Or "0 (at its bound)" where only a negative cost
/// would fit better; "not determined by these frames" where there is no cost to compare a leaf with, or where an error
/// exceeds both 1 and the ratio.
struct CostWords {
  std::string inner, leaf;
};
CostWords cost_words(double inner, double inner_error, double leaf, double leaf_error);

/// Costs fitted to measured frames by least squares of the relative error, none of them negative.
struct FittedCosts {
  double fixed_ns = 0, inner_ns = 0, leaf_ns = 0, test_ns = 0;  ///< per ray and thread
  double inner_error = 0, leaf_error = 0;                       ///< standard errors of costs().inner and costs().leaf
  double rms = 0;                                               ///< relative error of a frame's time
  std::size_t frames = 0;

  StepCosts costs() const { return {inner_ns / test_ns, inner_ns > 0 ? leaf_ns / inner_ns : 0, fixed_ns / test_ns}; }
  bool determined() const;  ///< both ratios are, in words()
  CostWords words() const { return cost_words(costs().inner, inner_error, costs().leaf, leaf_error); }
  /// As JSON names them: "fixed_ns", "inner_ns", "leaf_ns", "test_ns", "inner_per_test", "leaf_per_inner", and the last
  /// two with "_error" (standard errors).
  std::vector<std::pair<const char*, double>> named() const;
};
/// `ns_per_ms`: nanoseconds per ray and thread in a millisecond of a frame's time. No fit (`frames` is 0) with fewer
/// than eight frames, or if a sphere test costs nothing.
FittedCosts fit_costs(const FigureWork& work, const EngineTimes& times, double ns_per_ms);

}  // namespace bihive
