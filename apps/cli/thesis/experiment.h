// An experiment of the thesis: steps that measure or draw, and a section that shows the results.
//
// Each step's result is saved as its own JSON file, so that an interrupted run continues where it stopped. The section
// is made from the saved results alone, repeatedly, also while some are still missing.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "bihive/base/cancel.h"
#include "bihive/image/image.h"
#include "thesis/section.h"
#include "thesis/stated_values.h"

namespace bihive::cli::thesis {

struct Settings {
  bool quick = false;      ///< everything small, within a minute on two cores
  int threads = 0;         ///< 0 = all
  std::uint64_t seed = 1;  ///< of "this seed", and of pictures; means are over the seeds 1, 2, ...
  /// Figure 4.4: the costs at which the text's claims are judged (figure_4_4_cost_model.h): an inner node in sphere
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

/// `run` returns the data for the section, as JSON. Names are file names ("scenario1-max_prims8"). `weight` is the
/// step's time relative to the other steps of the whole run, about in seconds.
struct Step {
  std::string name;
  double weight;
  std::function<Json(StepContext&)> run;
};

/// The results of all finished steps, by name.
using StepResults = std::map<std::string, Json>;

struct SectionContext {
  const Settings& settings;
  const Values& values;
  const StepResults& results;
  std::string folder;  ///< of the experiment: charts go there
};

struct Experiment {
  std::string id;     ///< "table-4.2": its name on the command line and its folder in thesis/ and in the output
  std::string title;  ///< "Table 4.2: tree statistics"
  std::function<std::vector<Step>(const Settings&, const Values&)> steps;
  /// Must work with any subset of the results; leaves missing ones out.
  std::function<Section(const SectionContext&)> section;
};

/// One factory for each file; the order is that of the report.
Experiment figure_4_1();
Experiment figure_4_2();
Experiment figure_4_3();
Experiment table_4_2();
Experiment figure_4_4();
Experiment figure_4_5();
Experiment section_d();
std::vector<Experiment> all_experiments();

}  // namespace bihive::cli::thesis
