// An experiment of the thesis: steps that measure or draw, and the numbers that follow from them.
//
// Claims (claims.h) and the report's templates (report.h) read only an experiment's data.
#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/cancel.h"
#include "bihive/thesis/experiments.h"
#include "values.h"

namespace bihive::thesis {

struct Settings {
  bool quick = false;      ///< everything small, within a minute on two cores
  int threads = 0;         ///< 0 = all
  std::uint64_t seed = 1;  ///< of "this seed", and of pictures; means are over the seeds 1, 2, ...
  /// Figure 4.4: the costs at which the text's claims are judged (bihive/thesis/cost_model.h): an inner node in sphere
  /// tests, a leaf in inner nodes, the fixed part of a ray in sphere tests. Empty: those that suit the text best.
  std::vector<double> costs = {};
};

/// `run` returns the step's result; anything after cancellation. Names are file names ("scenario1-max_prims8").
/// `weight` is the step's time relative to the other steps of the whole run, about in seconds.
struct Step {
  std::string name;
  double weight;
  std::function<Json()> run;
};

/// An experiment in a run. Not movable: its steps refer to it.
struct Experiment {
  // A row of bihive/thesis/experiments.h.
  std::string id;         ///< "table-4.2": its name on the command line and its folder in thesis/ and in the output
  std::string section;    ///< of the thesis's chapter: "B" to "G"
  std::string title;      ///< "Table 4.2: statistics of the trees"
  std::string_view page;  ///< its template

  const Settings& settings;
  Values values;
  std::string folder;         ///< in the output; exists while a step runs, and while data are made: pictures go there
  const CancelToken& cancel;  ///< long work watches it

  /// Filled by the experiment's own function.
  std::vector<Step> steps = {};
  /// Gives an object. Works with any subset of the results, and omits what depends on missing ones.
  Json (*make_data)(const Experiment& experiment) = nullptr;

  bool asked = true;                         ///< requested on the command line; else shown with an earlier run's
                                             ///< results
  std::map<std::string, Json> results = {};  ///< of all finished steps, by name
  double others = -1;                        ///< the largest of their shares of other programs (LoadWatch::others())
  Json data = Json::object();                ///< made of the results
  Json findings = Json::array(), claims = Json::array();

  /// The step is `run(*this, of...)`.
  template <class Run, class... Of>
  void add(std::string step, double quick_weight, double weight, const Run& run, const Of&... of) {
    steps.push_back({std::move(step), settings.quick ? quick_weight : weight, [=, this] { return run(*this, of...); }});
  }
  /// The step's result, or null if it is not done.
  const Json* result(const std::string& step) const {
    const auto found = results.find(step);
    return found == results.end() ? nullptr : &found->second;
  }
  /// The finished steps in their order: name and result.
  std::vector<std::pair<std::string, const Json*>> finished() const {
    std::vector<std::pair<std::string, const Json*>> all;
    for (const Step& step : steps)
      if (const Json* const done = result(step.name)) all.emplace_back(step.name, done);
    return all;
  }
  std::vector<std::string> missing_steps() const {
    std::vector<std::string> names;
    for (const Step& step : steps)
      if (result(step.name) == nullptr) names.push_back(step.name);
    return names;
  }
};

/// Add steps and data: figure_4_1() in scenes.cpp, figure_4_2() in recursion_depths.cpp, figure_4_3() in
/// small_trees.cpp, section_d() in one_leaf.cpp, table_4_2() in tree_statistics.cpp, figure_4_4() in frame_rates.cpp,
/// figure_4_5() in tree_memory.cpp.
#define BIHIVE_DECLARE(name, id, section, title) void name(Experiment& experiment);
BIHIVE_THESIS_EXPERIMENTS(BIHIVE_DECLARE)
#undef BIHIVE_DECLARE

/// Fails if it cannot be made.
void make_folder(const std::string& folder);

/// Results of steps are kept as files, so that an interrupted run can go on: <out>/steps/<experiment>/<step>.json. This
/// loads what the same build of the program saved with the same settings and stated values, if all its pictures still
/// exist.
void load_results(Experiment& experiment, const std::string& out);

/// Runs the requested steps that are not done yet. Returns early after a signal. Fails if a result cannot be written.
void run_steps(std::list<Experiment>& experiments, const std::string& out);

}  // namespace bihive::thesis

// The report's templates, embedded in the program.
namespace bihive {

std::string_view thesis_template_report();    ///< thesis/report/report.html
std::string_view thesis_template_css();       ///< thesis/report/report.css
std::string_view thesis_template_findings();  ///< thesis/report/findings.html
std::string_view thesis_template_verdicts();  ///< thesis/report/verdicts.json
// thesis_template_figure_4_1() and so on: thesis/figure-4.1/report.html.
#define BIHIVE_DECLARE(name, id, section, title) std::string_view thesis_template_##name();
BIHIVE_THESIS_EXPERIMENTS(BIHIVE_DECLARE)
#undef BIHIVE_DECLARE

}  // namespace bihive
