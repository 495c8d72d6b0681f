// bihive thesis: runs experiments step by step, and writes the report.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

#include "bihive/base/parallel.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/simd/target.h"
#include "commands/commands.h"
#include "commands/picture_settings.h"
#include "support/failure.h"
#include "support/interrupt.h"
#include "support/messages.h"
#include "support/outputs.h"
#include "support/request_files.h"
#include "thesis/against.h"
#include "thesis/claims.h"
#include "thesis/devices.h"
#include "thesis/experiment.h"
#include "thesis/machine_load.h"
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
  std::map<std::string, MachineLoad> loads;  // of each step with a result
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

// Steps make pictures, and somebody may have removed the pictures since, or changed the steps.
bool has_its_pictures(const Run& run, const Settings& settings, const std::string& out) {
  if (run.results.empty()) return true;
  make_folder(run.folder);
  Section section;
  try {
    section = run.experiment.section({settings, run.values, run.results, run.folder});
  } catch (const std::exception&) {
    warn(out + "/steps/" + run.experiment.id + ": holds what this program did not write; the steps are run again");
    return false;
  }
  return std::all_of(section.illustrations.begin(), section.illustrations.end(),
                     [&](const Illustration& picture) { return fs::is_regular_file(out + "/" + picture.file); });
}

// Other stated values: the folder must be there, with a file for each experiment that is named. Of `all` it may hold
// some, and the user is told which ones are the bundled ones.
void check_values(const ThesisOptions& options) {
  if (options.values.empty()) return;
  if (!fs::is_directory(options.values)) fail({"there is no such folder", options.values, 0, 0, "--values names one"});
  const bool all =
      options.experiments.empty() || std::count(options.experiments.begin(), options.experiments.end(), "all") > 0;
  std::string bundled;
  std::int64_t found = 0;
  for (const Experiment& experiment : all_experiments()) {
    const bool named = std::count(options.experiments.begin(), options.experiments.end(), experiment.id) > 0;
    if (!all && !named) continue;
    const std::string file = options.values + "/" + experiment.id + "/values.json";
    std::error_code unknown;
    if (fs::exists(file, unknown) || unknown)
      ++found;
    else if (named)
      fail({"there are no values of " + experiment.id, file, 0, 0, "leave out --values, or name another experiment"});
    else
      bundled += (bundled.empty() ? "" : ", ") + experiment.id;
  }
  if (found == 0)
    fail({"there are no values in it", options.values, 0, 0, "expected " + options.values + "/EXPERIMENT/values.json"});
  if (!bundled.empty()) warn(options.values + ": holds no values of " + bundled + "; the bundled ones are used");
}

// The requested experiments, and those of an earlier run into the same folder that are still valid.
std::vector<Run> collect_runs(const ThesisOptions& options, const Settings& settings, const StepStore& store) {
  std::vector<Run> runs;
  for (Experiment& experiment : all_experiments()) {
    Values values = load_values(experiment.id, options.values);
    Run run{std::move(experiment), std::move(values), {}, {}, {}, "", false};
    run.steps = run.experiment.steps(settings, run.values);
    run.folder = options.out + "/" + run.experiment.id;
    for (const Step& step : run.steps)
      if (std::optional<StepStore::Saved> saved = store.load(run.experiment.id, step.name, run.values)) {
        run.results.emplace(step.name, std::move(saved->result));
        run.loads.emplace(step.name, saved->load);
      }
    if (!has_its_pictures(run, settings, options.out)) {
      run.results.clear();
      run.loads.clear();
    }
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
      const LoadWatch watch;
      Json result = step.run(context);
      if (CancellableSection::token().cancelled()) return;
      const MachineLoad load = watch.so_far();
      store.save(run.experiment.id, step.name, run.values, {result, load});
      run.results.emplace(step.name, std::move(result));
      run.loads.emplace(step.name, load);
      done += step.weight;
    }
  }
}

std::vector<ReportSection> sections_of(const std::vector<Run>& runs, const Settings& settings) {
  std::vector<ReportSection> sections;
  for (const Run& run : runs) {
    ReportSection section{run.experiment.id, run.experiment.title, {}, {}, &run.values, {}};
    section.section = run.experiment.section({settings, run.values, run.results, run.folder});
    for (const Step& step : run.steps)
      if (!run.done(step))
        section.missing_steps.push_back(step.name);
      else if (const auto load = run.loads.find(step.name); load != run.loads.end())
        section.load.add(load->second);
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

std::string compiler() {
#if defined(__clang__)
  const std::string name = "clang ";
#else
  const std::string name = "gcc ";
#endif
#ifdef NDEBUG
  const std::string checks = "";
#else
  const std::string checks = ", with assertions";
#endif
  return fmt::format("{}{}{}; vectors: {}", name, __VERSION__, checks, active_target());
}

// A word of a command line, in quotes where a shell would take it apart.
std::string in_shell(const std::string& word) {
  const bool plain = std::all_of(word.begin(), word.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_./:=,+@%-").find(c) != std::string_view::npos;
  });
  if (plain && !word.empty()) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// The command of this run, as one could write it again; defaults are left out.
std::string command_of(const ThesisOptions& options) {
  std::string command = "bihive thesis";
  for (const std::string& experiment : options.experiments) command += " " + experiment;
  command += " --out " + in_shell(options.out);
  if (options.quick) command += " --quick";
  if (options.seed != ThesisOptions{}.seed) command += fmt::format(" --seed {}", options.seed);
  if (options.threads != 0) command += fmt::format(" --threads {}", options.threads);
  if (!options.costs.empty()) command += fmt::format(" --costs {}", fmt::join(options.costs, ","));
  if (!options.values.empty()) command += " --values " + in_shell(options.values);
  for (const std::string& device : options.devices) command += " --device " + in_shell(device);
  if (!options.against.empty()) command += " --against " + in_shell(options.against);
  return command;
}

std::string now() {
  const std::time_t time = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
  char text[32];
  return {text, std::strftime(text, sizeof(text), "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&time))};
}

void print_summary(const std::vector<ReportSection>& sections, const std::vector<ReportFront>& fronts,
                   const std::string& report) {
  for (const ReportSection& section : sections) {
    const VerdictCounts counts = count_verdicts(section.section);
    const std::string state =
        section.missing_steps.empty() ? "complete" : fmt::format("{} steps missing", section.missing_steps.size());
    std::string text = fmt::format("{:<12} {:<18} of the text: {} agree, {} differ, {} undecided", section.id, state,
                                   counts.stated.agrees, counts.stated.differs, counts.stated.undecided);
    const auto add = [&](const VerdictCounts::OfKind& kind, const char* what) {
      if (kind.all() > 0) text += fmt::format("; {}: {} of {}", what, kind.agrees, kind.all());
    };
    add(counts.inferred, "inferred");
    add(counts.own_check, "own checks");
    if (counts.text_inconsistent > 0) text += fmt::format("; text inconsistent: {}", counts.text_inconsistent);
    print(text + "\n");
  }
  for (const ReportFront& front : fronts)
    if ((front.id == "verdicts" || front.id == "against") && !front.paragraphs.empty())
      print(front.paragraphs.back() + "\n");
  print(escaped(report) + "\n");
}

}  // namespace
}  // namespace bihive::cli::thesis

namespace bihive::cli {

void run_thesis(const ThesisOptions& options) {
  using namespace thesis;
  const Settings settings{options.quick, static_cast<int>(options.threads), options.seed, options.costs};
  check_values(options);
  if (options.out == kStandardStream) fail_usage("--out names a folder, and - is none");
  if (fs::is_directory(options.out)) check_outputs(outputs_of(options), inputs_of(options));
  // Other runs are read before the long work: a file that is none is told at once, and this run may write over it.
  std::optional<OlderRun> older;
  if (!options.against.empty()) older = read_older_run(options.against);
  std::vector<ReportFront> devices;
  if (!options.devices.empty()) devices = devices_pages(options.devices, load_values("figure-4.4", options.values));
  make_folder(options.out);
  const std::string report = options.out + "/report.html";
  check_outputs(outputs_of(options), inputs_of(options));
  const StepStore store(options.out, settings);
  std::vector<Run> runs = collect_runs(options, settings, store);

  // The report is also written after an interruption. The section lives until then, so that only a second signal ends
  // it at once.
  const CancellableSection section;
  run_steps(runs, settings, store);
  const std::vector<ReportSection> sections = sections_of(runs, settings);
  const int threads = settings.threads > 0 ? settings.threads : hardware_threads();
  ReportHeader header{settings,
                      std::string(version()),
                      std::string(commit()),
                      fmt::format("{}, {} threads", processor(), threads),
                      compiler(),
                      command_of(options),
                      now(),
                      {}};
  for (const ReportSection& of_experiment : sections) header.load.add(of_experiment.load);
  std::vector<ReportFront> fronts{verdict_page(sections)};
  for (ReportFront& page : devices) fronts.push_back(std::move(page));
  if (older) fronts.push_back(compared_with(*older, sections));
  const Json json = results_json(header, fronts, sections);
  const std::string text = json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
  if (const Status status = write_file(options.out + "/results.json", text); !status) fail(status.error());
  if (const Status status = write_file(report, report_html(header, fronts, sections, options.out)); !status)
    fail(status.error());
  CancellableSection::leave_if_cancelled();

  if (options.json)
    print(as_text(json, 2) + "\n");
  else
    print_summary(sections, fronts, report);
}

}  // namespace bihive::cli
