// bihive-thesis, started by `bihive thesis` with the same command line: runs experiments step by step, and writes the
// report.

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

#include "../shared/last_line.h"
#include "against.h"
#include "bihive/base/parallel.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/simd/target.h"
#include "command_line.h"
#include "devices.h"
#include "report.h"
#include "step_store.h"
#include "support/failure.h"
#include "support/interrupt.h"
#include "support/messages.h"
#include "support/outputs.h"
#include "support/request_files.h"

namespace bihive::thesis {
namespace {

namespace fs = std::filesystem;
using cli::CancellableSection;
using cli::fail;
using cli::ThesisOptions;

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

bool asks_for(const ThesisOptions& options, const std::string& experiment) {
  const std::vector<std::string>& named = options.experiments;
  return named.empty() || std::count(named.begin(), named.end(), "all") > 0 ||
         std::count(named.begin(), named.end(), experiment) > 0;
}

void make_folder(const std::string& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder))
    fail({"the folder cannot be made: " + (error ? error.message() : "a file is in its place"), folder, 0, 0, ""});
}

// Steps draw pictures, and somebody may have removed them since.
bool has_its_pictures(const Json& result, const std::string& folder) {
  if (result.is_object() && result.contains("picture_hash"))
    return fs::is_regular_file(folder + "/" + result.value("name", ""));
  return !result.is_structured() ||
         std::all_of(result.begin(), result.end(), [&](const Json& part) { return has_its_pictures(part, folder); });
}

// A result of another build may lack what this one reads.
bool is_readable(const Run& run, const Settings& settings, const std::string& out) {
  if (run.results.empty()) return true;
  make_folder(run.folder);
  try {
    run.experiment.code.data({settings, run.values, run.results, run.folder});
  } catch (const Json::exception&) {
    cli::warn(out + "/steps/" + run.experiment.id + ": holds what this program did not write; the steps are run again");
    return false;
  }
  return std::all_of(run.results.begin(), run.results.end(),
                     [&](const auto& each) { return has_its_pictures(each.second, run.folder); });
}

// Other values: the folder must be there, with a file for each experiment that is named. Of `all` it may hold some, and
// the user is told which ones are the bundled ones.
void check_values(const ThesisOptions& options) {
  if (options.values.empty()) return;
  if (!fs::is_directory(options.values)) fail({"there is no such folder", options.values, 0, 0, "--values names one"});
  std::string bundled;
  std::int64_t found = 0;
  for (const Experiment& experiment : all_experiments()) {
    const bool named = std::count(options.experiments.begin(), options.experiments.end(), experiment.id) > 0;
    if (!asks_for(options, experiment.id)) continue;
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
  if (!bundled.empty()) cli::warn(options.values + ": holds no values of " + bundled + "; the bundled ones are used");
}

// The requested experiments, and those of an earlier run into the same folder that are still valid.
std::vector<Run> collect_runs(const ThesisOptions& options, const Settings& settings, const StepStore& store) {
  std::vector<Run> runs;
  for (Experiment& experiment : all_experiments()) {
    Values values = load_values(experiment.id, options.values);
    Run run{std::move(experiment), std::move(values), {}, {}, {}, "", false};
    run.steps = run.experiment.code.steps(settings, run.values);
    run.folder = options.out + "/" + run.experiment.id;
    for (const Step& step : run.steps)
      if (std::optional<StepStore::Saved> saved = store.load(run.experiment.id, step.name, run.values)) {
        run.results.emplace(step.name, std::move(saved->result));
        run.loads.emplace(step.name, saved->load);
      }
    if (!is_readable(run, settings, options.out)) {
      run.results.clear();
      run.loads.clear();
    }
    run.asked = asks_for(options, run.experiment.id);
    if (run.asked || !run.results.empty()) runs.push_back(std::move(run));
  }
  return runs;
}

// Runs the steps that are not done yet. Returns early after a signal.
void run_steps(std::vector<Run>& runs, const Settings& settings, const StepStore& store) {
  cli::Progress progress("thesis");
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

std::vector<ReportPart> parts_of(const std::vector<Run>& runs, const Settings& settings) {
  std::vector<ReportPart> parts;
  parts.reserve(runs.size());  // claims point to findings
  for (const Run& run : runs) {
    ReportPart& part = parts.emplace_back();
    part.experiment = &run.experiment;
    part.values = &run.values;
    part.data = run.experiment.code.data({settings, run.values, run.results, run.folder});
    part.findings = judge(run.values, part.data);
    part.claims = claims_of(run.experiment, run.values, part.findings);
    for (const Step& step : run.steps)
      if (!run.done(step))
        part.missing_steps.push_back(step.name);
      else if (const auto load = run.loads.find(step.name); load != run.loads.end())
        part.load.add(load->second);
  }
  return parts;
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

void print_summary(const Report& report, const std::string& file) {
  for (const ReportPart& part : report.parts)
    if (!part.missing_steps.empty())
      cli::print(fmt::format("{}: {} steps missing\n", part.experiment->id, part.missing_steps.size()));
  cli::print("Claims: " + summary_of(report.parts) + ".\n");
  if (!report.against.is_null())
    cli::print(fmt::format("Beside {}: {} findings are as they were, {} have another verdict, {} another value.\n",
                           escaped(report.against["file"].get<std::string>()), report.against["same"].get<int>(),
                           report.against["changed"].get<int>(), report.against["moved"].get<int>()));
  cli::print(escaped(file) + "\n");
}

void run_thesis(const ThesisOptions& options) {
  const Settings settings{options.quick, static_cast<int>(options.threads), options.seed, options.costs};
  check_values(options);
  if (options.out == cli::kStandardStream) cli::fail_usage("--out names a folder, and - is none");
  if (fs::is_directory(options.out)) cli::check_outputs(cli::outputs_of(options), cli::inputs_of(options));
  // Other runs are read before the long work: a file that is none is told at once, and this run may write over it.
  Json older;
  if (!options.against.empty()) older = read_older_run(options.against);
  Report report;
  if (!options.devices.empty())
    report.devices = devices_data(options.devices, load_values("figure-4.4", options.values));
  make_folder(options.out);
  cli::check_outputs(cli::outputs_of(options), cli::inputs_of(options));
  const StepStore store(options.out, settings);
  std::vector<Run> runs = collect_runs(options, settings, store);

  // The report is also written after an interruption. The section lives until then, so that only a second signal ends
  // it at once.
  const CancellableSection section;
  run_steps(runs, settings, store);
  report.settings = settings;
  report.about = {{"version", std::string(version())},
                  {"commit", std::string(commit())},
                  {"command", command_of(options)},
                  {"compiler", compiler()},
                  {"machine", fmt::format("{}, {} threads", processor(),
                                          settings.threads > 0 ? settings.threads : hardware_threads())},
                  {"date", now()}};
  report.parts = parts_of(runs, settings);
  for (const ReportPart& part : report.parts) report.load.add(part.load);
  if (!older.is_null()) report.against = compared_with(std::move(older), report.parts);
  const Json json = results_json(report);
  const std::string text = json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
  const std::string file = options.out + "/report.html";
  if (const Status status = write_file(options.out + "/results.json", text); !status) fail(status.error());
  if (const Status status = write_file(file, report_html(report, options.out)); !status) fail(status.error());
  CancellableSection::leave_if_cancelled();
  if (options.json)
    cli::print(text);
  else
    print_summary(report, file);
}

// Before the shared libraries make their variables, some of which need memory.
void prepare() {
  end_in_one_line(cli::remove_unfinished);
}
__attribute__((section(".preinit_array"), used)) void (*const kFirst)() = prepare;

int run(int argc, const char* const* argv) {
  try {
    cli::handle_signals();
    cli::name_settings_as_options();
    if (const Status status = check_target_environment(); !status) throw cli::Failure{cli::kBadUsage, status.error()};
    const cli::Request request = cli::parse_command_line(argc, argv);
    const auto* const options = std::get_if<ThesisOptions>(&request);
    if (options == nullptr) cli::fail_usage("this program is started by `bihive thesis`");
    run_thesis(*options);
    cli::finish_output();
    return cli::kSuccess;
  } catch (const cli::Failure& failure) {
    cli::say_error(failure.error.to_string());
    cli::say_lines(failure.shown);
    return failure.code;
  } catch (const std::bad_alloc&) {
    say_no_memory();
  } catch (const std::exception& error) {
    cli::say_error(error.what());
  }
  return cli::kBadInput;
}

}  // namespace

std::vector<Experiment> all_experiments() {
  std::vector<Experiment> all;
#define BIHIVE_ADD(name, id, section, title) all.push_back({id, section, title, name()});
  BIHIVE_THESIS_EXPERIMENTS(BIHIVE_ADD)
#undef BIHIVE_ADD
  return all;
}

}  // namespace bihive::thesis

int main(int argc, char** argv) {
  try {
    return bihive::thesis::run(argc, argv);
  } catch (const std::exception&) {
    bihive::say_no_memory();
  }
  return bihive::cli::kBadInput;
}
