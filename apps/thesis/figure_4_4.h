// The inputs of Figure 4.4 other than the counted work of rays (bihive/thesis/cost_model.h): frame times of the
// programs that use the text's tree (the thesis program, the reference engine, the shader), and the text's claims.
#pragma once

#include "bihive/thesis/frame_rates.h"
#include "experiment.h"

namespace bihive::thesis {

/// The plan of the values and settings; a fraction of the picture's width and height, another one in a quick run.
FrameRatePlan plan_of(const Experiment& experiment, int divisor = 1, int quick_divisor = 1);

/// A program whose frames are measured.
struct TimedProgram {
  const char *key, *name;
  /// {"width_px", "height_px", "frame_ms": {"brute": [ms, ...], "max_prims8": [...]}}, and what else it says; null if
  /// cancelled; {"missing": why} if this machine cannot.
  Json (*measure)(const Experiment& experiment, std::int64_t scenario, std::int64_t spheres);
  double weight;  ///< of each of its steps
};
const std::vector<TimedProgram>& timed_programs();

/// Whether this description of a GPU is that of software emulation.
bool is_software(const std::string& gpu);

/// {"spheres64": {"scenario1": ms, "scenario2": ms, "scenario3": ms, "one_place": ms}}: the thesis program's shortest
/// time for a frame by brute force, in the scenarios and with all spheres at one position, in turns.
Json measure_brute_force(const Experiment& experiment);

/// The frames of a step's result.
ConfigurationTimes times_of(const Json& result);

/// The quantities that the claims of Figure 4.4 compare, at given costs of the steps of a ray: who wins where, the
/// shapes of the curves over MAX_PRIMS, the extremes, the gains. Their names are those of the claims' "of" in
/// thesis/figure-4.4/values.json, after "at.text.".
Json quantities_at(const FigureWork& work, const WinPattern& pattern, const StepCosts& costs, const Values& values);

}  // namespace bihive::thesis
