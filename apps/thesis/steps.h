// The steps of a run. Their results are kept as files, so that an interrupted run can go on:
// <out>/steps/<experiment>/<step>.json.
#pragma once

#include <list>
#include <string>

#include "experiment.h"

namespace bihive::thesis {

/// Fails if it cannot be made.
void make_folder(const std::string& folder);

/// Loads the results that the same build of the program saved with the same settings and stated values, if all their
/// pictures still exist.
void load_results(Experiment& experiment, const std::string& out);

/// Runs the requested steps that are not done yet. Returns early after a signal. Fails if a result cannot be written.
void run_steps(std::list<Experiment>& experiments, const std::string& out);

}  // namespace bihive::thesis
