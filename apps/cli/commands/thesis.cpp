// bihive thesis: runs experiments step by step, and writes the report.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>

#include "bihive/base/parallel.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "commands/commands.h"
#include "support/failure.h"
#include "support/interrupt.h"
#include "support/messages.h"
#include "thesis/experiment.h"
#include "thesis/report.h"
#include "thesis/step_store.h"

namespace bihive::cli::thesis {
namespace {

namespace fs = std::filesystem;

// An experiment with all data of its run.
struct Run {
  Experiment experiment;
  Values values;
  std::vector<Step> steps;
  StepResults results;
  std::string folder;
  bool asked = false;  // on the command line; else it is shown as an earlier run left it

  bool done(const Step& step) const { return results.count(step.name) != 0; }
};

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    fail({"the folder cannot be made: " + (error ? error.message() : "a file is in its place"), folder, 0, 0, ""});
}

// Steps make pictures, and somebody may have removed the pictures since.
bool has_its_pictures(const Run& run, const Settings& settings, const std::string& out) {
  if (run.results.empty()) return true;
  make_folder(run.folder);
  const Section section = run.experiment.section({settings, run.values, run.results, run.folder});
  return std::all_of(section.illustrations.begin(), section.illustrations.end(),
                     [&](const Illustration& picture) { return fs::is_regular_file(out + "/" + picture.file); });
}

// The requested experiments, and those of an earlier run into the same folder that are still valid.
std::vector<Run> collect_runs(const ThesisOptions& options, const Settings& settings, const StepStore& store) {
  std::vector<Run> runs;
  for (Experiment& experiment : all_experiments()) {
    Values values = load_values(experiment.id, options.values);
    Run run{std::move(experiment), std::move(values), {}, {}, "", false};
    run.steps = run.experiment.steps(settings, run.values);
    run.folder = options.out + "/" + run.experiment.id;
    for (const Step& step : run.steps)
      if (std::optional<Json> result = store.load(run.experiment.id, step.name, run.values))
        run.results.emplace(step.name, std::move(*result));
    if (!has_its_pictures(run, settings, options.out)) run.results.clear();
    const bool all =
        options.experiments.empty() || std::count(options.experiments.begin(), options.experiments.end(), "all") > 0;
    run.asked = all || std::count(options.experiments.begin(), options.experiments.end(), run.experiment.id) > 0;
    if (run.asked || !run.results.empty()) runs.push_back(std::move(run));
  }
  return runs;
}

// Runs the steps that are not done yet. Returns early after a signal.
void run_steps(std::vector<Run>& runs, const Settings& settings, const StepStore& store) {
  Progress progress("thesis");
  double all = 0;
  for (const Run& run : runs)
    for (const Step& step : run.steps)
      if (run.asked && !run.done(step)) all += step.weight;
  double done = 0;
  for (Run& run : runs) {
    if (!run.asked) continue;
    make_folder(run.folder);
    for (const Step& step : run.steps) {
      if (run.done(step)) continue;
      progress.rename(run.experiment.id + " " + step.name);
      progress.update(done / all);
      StepContext context{settings, run.values, run.folder, CancellableSection::token()};
      Json result = step.run(context);
      if (CancellableSection::token().cancelled()) return;
      store.save(run.experiment.id, step.name, run.values, result);
      run.results.emplace(step.name, std::move(result));
      done += step.weight;
    }
  }
}

std::vector<ReportSection> sections_of(const std::vector<Run>& runs, const Settings& settings) {
  std::vector<ReportSection> sections;
  for (const Run& run : runs) {
    ReportSection section{run.experiment.id, run.experiment.title, {}, {}, &run.values};
    section.section = run.experiment.section({settings, run.values, run.results, run.folder});
    for (const Step& step : run.steps)
      if (!run.done(step)) section.missing_steps.push_back(step.name);
    sections.push_back(std::move(section));
  }
  return sections;
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown processor";
}

std::string now() {
  const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char text[32];
  return {text, std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time))};
}

void print_summary(const std::vector<ReportSection>& sections, const std::string& report) {
  for (const ReportSection& section : sections) {
    const Verdicts verdicts = count_verdicts(section.section);
    const std::string state =
        section.missing_steps.empty() ? "complete" : fmt::format("{} steps missing", section.missing_steps.size());
    print(
        fmt::format("{:<12} {:<18} {} values agree, {} differ\n", section.id, state, verdicts.agree, verdicts.differ));
  }
  print(report + "\n");
}

}  // namespace
}  // namespace bihive::cli::thesis

namespace bihive::cli {

void run_thesis(const ThesisOptions& options) {
  using namespace thesis;
  const Settings settings{options.quick, static_cast<int>(options.threads), options.seed};
  make_folder(options.out);
  const std::string report = options.out + "/report.html";
  if (const Status status = check_writable(report); !status) fail(status.error());
  const StepStore store(options.out, settings);
  std::vector<Run> runs = collect_runs(options, settings, store);

  // The report is also written after an interruption. The section lives until then, so that only a second signal ends
  // it at once.
  const CancellableSection section;
  run_steps(runs, settings, store);
  const std::vector<ReportSection> sections = sections_of(runs, settings);
  const int threads = settings.threads > 0 ? settings.threads : hardware_threads();
  const ReportHeader header{settings, std::string(version()), std::string(commit()),
                            fmt::format("{}, {} threads", processor(), threads), now()};
  const std::string json = results_json(header, sections).dump(2) + "\n";
  if (const Status status = write_file(options.out + "/results.json", json); !status) fail(status.error());
  if (const Status status = write_file(report, report_html(header, sections, options.out)); !status)
    fail(status.error());
  CancellableSection::leave_if_cancelled();

  if (options.json)
    print(json);
  else
    print_summary(sections, report);
}

}  // namespace bihive::cli
