// The times of Figure 4.4's frames by the programs that use the text's tree: the thesis program, the reference engine,
// and the shader.
#pragma once

#include "bihive/thesis/cost_model.h"
#include "experiment.h"

namespace bihive::thesis {

/// A program whose frames are measured.
struct TimedProgram {
  const char *key, *name;
  /// {"width_px", "height_px", "frame_ms": {"brute": [ms, ...], "max_prims8": [...]}}, and what else it says; null if
  /// cancelled; {"missing": why} if this machine cannot.
  Json (*measure)(const Experiment& experiment, std::int64_t scenario, std::int64_t spheres);
  double weight;  ///< of its steps: seconds of a full run, of all configurations
};
const std::vector<TimedProgram>& timed_programs();

/// Whether this description of a GPU is that of software emulation.
bool is_software(const std::string& gpu);

/// {"spheres64": {"scenario1": ms, "scenario2": ms, "scenario3": ms, "one_place": ms}}: the thesis program's shortest
/// time for a frame by brute force, in the scenarios and with all spheres at one position, in turns.
Json measure_brute_force(const Experiment& experiment);

/// The frames of a step's result.
ConfigurationTimes times_of(const Json& result);

}  // namespace bihive::thesis
