// The steps of a run, and the files that keep their results.
#include <algorithm>
#include <filesystem>
#include <utility>

#include "bihive/base/json_text.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/job/messages.h"
#include "experiment.h"
#include "machine_load.h"

namespace bihive::thesis {
namespace {

namespace fs = std::filesystem;

std::string path_of(const Experiment& experiment, const std::string& step, const std::string& out) {
  return out + "/steps/" + experiment.id + "/" + step + ".json";
}

// All data on which a result depends.
Json key_of(const Experiment& experiment) {
  const Settings& settings = experiment.settings;
  return {
      {"version", std::string(version())}, {"commit", std::string(commit())}, {"quick", settings.quick},
      {"threads", settings.threads},       {"seed", settings.seed},           {"values", experiment.values.document()}};
}

// Steps draw pictures, and somebody may have removed them since.
bool has_its_pictures(const Json& result, const std::string& folder) {
  if (result.is_object() && result.contains("picture_hash"))
    return fs::is_regular_file(folder + "/" + result.value("name", ""));
  return !result.is_structured() ||
         std::all_of(result.begin(), result.end(), [&](const Json& part) { return has_its_pictures(part, folder); });
}

// A result of another build may lack what this one reads.
bool is_readable(Experiment& experiment, const std::string& out) {
  try {
    experiment.make_data(experiment);
  } catch (const Json::exception&) {
    warn(out + "/steps/" + experiment.id + ": holds what this program did not write; the steps are run again");
    return false;
  }
  return std::all_of(experiment.results.begin(), experiment.results.end(),
                     [&](const auto& each) { return has_its_pictures(each.second, experiment.folder); });
}

}  // namespace

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    fail({"the folder cannot be made: " + (error ? error.message() : "a file is in its place"), folder, 0, 0, ""});
}

void load_results(Experiment& experiment, const std::string& out) {
  const Json key = key_of(experiment);
  for (const Step& step : experiment.steps) {
    // A damaged file or a file of another run counts as missing.
    const Result<std::string> bytes = read_file(path_of(experiment, step.name, out));
    Result<Json> saved = bytes ? json_from_text<Json>(*bytes) : Result<Json>(bytes.error());
    if (!saved || !saved->is_object() || saved->value("key", Json()) != key || !saved->contains("result")) continue;
    const Json others = saved->value("others", Json());
    if (!others.is_number()) continue;
    experiment.others = std::max(experiment.others, others.get<double>());
    experiment.results.emplace(step.name, std::move((*saved)["result"]));
  }
  if (experiment.results.empty()) return;
  make_folder(experiment.folder);
  if (is_readable(experiment, out)) return;
  experiment.results.clear();
  experiment.others = -1;
}

void run_steps(std::list<Experiment>& experiments, const std::string& out) {
  Progress progress("thesis");
  double all = 0, done = 0;
  for (const Experiment& experiment : experiments)
    for (const Step& step : experiment.steps)
      if (experiment.asked && experiment.result(step.name) == nullptr) all += step.weight;
  for (Experiment& experiment : experiments) {
    if (!experiment.asked) continue;
    make_folder(experiment.folder);
    make_folder(out + "/steps/" + experiment.id);
    const Json key = key_of(experiment);
    for (const Step& step : experiment.steps) {
      if (experiment.result(step.name) != nullptr) continue;
      progress.rename(experiment.id + " " + step.name);
      progress.update(done / all);
      const LoadWatch watch;
      Json result = step.run();
      if (experiment.cancel.cancelled()) return;
      const double others = watch.others();
      const Json document{{"key", key}, {"others", others}, {"result", result}};
      value_or_fail(write_file(path_of(experiment, step.name, out), document.dump(1) + "\n"));
      experiment.results.emplace(step.name, std::move(result));
      experiment.others = std::max(experiment.others, others);
      done += step.weight;
    }
  }
}

}  // namespace bihive::thesis
