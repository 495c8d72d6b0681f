// An experiment of the thesis: steps that measure or draw, and the numbers that follow from them.
//
// Each step's result is saved as its own JSON file, so that an interrupted run continues where it stopped. Claims
// (claims.h) and the report's templates (report.h) read nothing but an experiment's data.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bihive/base/cancel.h"
#include "bihive/thesis/experiments.h"
#include "values.h"

namespace bihive::thesis {

using Json = nlohmann::ordered_json;

struct Settings {
  bool quick = false;      ///< everything small, within a minute on two cores
  int threads = 0;         ///< 0 = all
  std::uint64_t seed = 1;  ///< of "this seed", and of pictures; means are over the seeds 1, 2, ...
  /// Figure 4.4: the costs at which the text's claims are judged (bihive/thesis/cost_model.h): an inner node in sphere
  /// tests, a leaf in inner nodes, the fixed part of a ray in sphere tests. Empty: those that suit the text best.
  std::vector<double> costs = {};
};

/// The context of a step. Long work watches `cancel`.
struct StepContext {
  const Settings& settings;
  const Values& values;
  std::string folder;  ///< of the experiment, exists: pictures go there
  const CancelToken& cancel;
};

/// `run` returns the step's result; after a cancellation anything. Names are file names ("scenario1-max_prims8").
/// `weight` is the step's time relative to the other steps of the whole run, about in seconds.
struct Step {
  std::string name;
  double weight;
  std::function<Json(StepContext&)> run;
};

/// The results of all finished steps, by name.
using StepResults = std::map<std::string, Json>;

struct DataContext {
  const Settings& settings;
  const Values& values;
  const StepResults& results;
  std::string folder;  ///< of the experiment: charts go there

  /// The step's result, or null if it is not done.
  const Json* result(const std::string& step) const {
    const auto found = results.find(step);
    return found == results.end() ? nullptr : &found->second;
  }
};

/// The code of an experiment.
struct ExperimentCode {
  std::function<std::vector<Step>(const Settings&, const Values&)> steps;
  /// An object. Must work with any subset of the results; leaves out what follows from missing ones.
  std::function<Json(const DataContext&)> data;
};

/// A row of bihive/thesis/experiments.h with its code.
struct Experiment {
  std::string id;       ///< "table-4.2": its name on the command line and its folder in thesis/ and in the output
  std::string section;  ///< of the thesis's chapter: "B" to "G"
  std::string title;    ///< "Table 4.2: statistics of the trees"
  ExperimentCode code;
};

/// figure_4_1() in scenes.cpp, figure_4_2() in recursion_depths.cpp, figure_4_3() in small_trees.cpp, section_d() in
/// one_leaf.cpp, table_4_2() in tree_statistics.cpp, figure_4_4() in frame_rates.cpp, figure_4_5() in tree_memory.cpp.
#define BIHIVE_DECLARE(name, id, section, title) ExperimentCode name();
BIHIVE_THESIS_EXPERIMENTS(BIHIVE_DECLARE)
#undef BIHIVE_DECLARE
std::vector<Experiment> all_experiments();

}  // namespace bihive::thesis
