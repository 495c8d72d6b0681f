// bihive-thesis, started by `bihive thesis` with the same command line: runs experiments step by step, and writes the
// report.

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <utility>
#include <variant>

#include "../shared/exit_code.h"
#include "../shared/last_line.h"
#include "../shared/processor_name.h"
#include "bihive/base/parallel.h"
#include "bihive/base/version.h"
#include "bihive/base/write_file.h"
#include "bihive/job/messages.h"
#include "bihive/simd/target.h"
#include "claims.h"
#include "command_line.h"
#include "report.h"
#include "support/interrupt.h"
#include "support/outputs.h"
#include "support/request_files.h"

namespace bihive::thesis {
namespace {

namespace fs = std::filesystem;
using cli::CancellableSection;
using cli::ThesisOptions;

bool names(const ThesisOptions& options, const std::string& experiment) {
  return std::count(options.experiments.begin(), options.experiments.end(), experiment) > 0;
}
bool asks_for(const ThesisOptions& options, const std::string& experiment) {
  return options.experiments.empty() || names(options, "all") || names(options, experiment);
}

// Other values: the folder must be there, with a file for each experiment that is named. Of `all` it may hold some, and
// the user is told which ones are the bundled ones.
void check_values(const ThesisOptions& options) {
  if (options.values.empty()) return;
  if (!fs::is_directory(options.values)) fail({"there is no such folder", options.values, 0, 0, "--values names one"});
  std::vector<std::string> own, bundled;
  for (const std::string& id : cli::thesis_experiments()) {
    if (id == "all" || !asks_for(options, id)) continue;
    const std::string file = options.values + "/" + id + "/values.json";
    std::error_code unknown;
    const bool here = fs::exists(file, unknown) || unknown;
    if (!here && names(options, id))
      fail({"there are no values of " + id, file, 0, 0, "leave out --values, or name another experiment"});
    (here ? own : bundled).push_back(id);
  }
  if (own.empty())
    fail({"there are no values in it", options.values, 0, 0, "expected " + options.values + "/EXPERIMENT/values.json"});
  if (!bundled.empty())
    warn(fmt::format("{}: holds no values of {}; the bundled ones are used", options.values, fmt::join(bundled, ", ")));
}

void add_experiments(const ThesisOptions& options, Report& report) {
#define BIHIVE_ADD(name, id, section, title)                                                           \
  report.parts.push_back({id, section, title, thesis_template_##name(), report.settings,               \
                          Values(id, builtin_values_##name(), options.values), options.out + "/" + id, \
                          CancellableSection::token()});                                               \
  name(report.parts.back());
  BIHIVE_THESIS_EXPERIMENTS(BIHIVE_ADD)
#undef BIHIVE_ADD
}

std::string compiler() {
  std::string name = "gcc " __VERSION__;
#ifdef __clang__
  name = "clang " __VERSION__;
#endif
#ifndef NDEBUG
  name += ", with assertions";
#endif
  return fmt::format("{}; vectors: {}", name, active_target());
}

// The command of this run, to repeat it, with quotes around arguments that a shell would split.
std::string command_of(int argc, const char* const* argv) {
  constexpr const char* kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./:=,+@%-";
  std::string command = "bihive";
  for (int i = 1; i < argc; ++i) {
    std::string word = argv[i];
    if (word.empty() || word.find_first_not_of(kPlain) != std::string::npos) {
      for (std::size_t at = 0; (at = word.find('\'', at)) != std::string::npos; at += 4) word.replace(at, 1, "'\\''");
      word = "'" + word + "'";
    }
    command += " " + word;
  }
  return command;
}

void print_summary(const Report& report, const std::string& file) {
  for (const Experiment& part : report.parts)
    if (const std::size_t missing = part.missing_steps().size(); missing > 0)
      print(fmt::format("{}: {} steps missing\n", part.id, missing));
  // At asked costs the claims themselves are wanted.
  for (const Experiment& part : report.parts)
    if (!report.settings.costs.empty() && part.data.contains("claims_at_costs"))
      for (const Json& row : part.data["claims_at_costs"]["rows"]) {
        const std::string claim = row["claim"], of = row["row"], ours = row["ours"], words = row["words"];
        print(escaped(fmt::format("{}: {}{}{}: {}", words, claim, of.empty() ? "" : ", ", of, ours)) + "\n");
      }
  print("Claims: " + summary_of(report) + ".\n");
  print(escaped(file) + "\n");
}

void run_thesis(const ThesisOptions& options, const std::string& command) {
  const Settings settings{options.quick, static_cast<int>(options.threads), options.seed, options.costs};
  check_values(options);
  if (options.out == kStandardStream) fail_usage("--out names a folder, and - is none");
  if (fs::is_directory(options.out)) cli::check_outputs(cli::outputs_of(options), cli::inputs_of(options));
  Report report{settings};
  add_experiments(options, report);
  // Files are read before the long work: a wrong one is reported at once.
  if (!options.devices.empty())
    for (const Experiment& part : report.parts)
      if (part.id == "figure-4.4") report.devices = devices_data(options.devices, part.values);
  make_folder(options.out);
  cli::check_outputs(cli::outputs_of(options), cli::inputs_of(options));

  // The requested experiments, and those of an earlier run into the same folder that are still valid.
  for (Experiment& part : report.parts) {
    part.asked = asks_for(options, part.id);
    load_results(part, options.out);
  }
  report.parts.remove_if([](const Experiment& part) { return !part.asked && part.results.empty(); });

  // The report is also written after an interruption. The section lives until then, so that only a second signal ends
  // it at once.
  const CancellableSection section;
  run_steps(report.parts, options.out);
  for (Experiment& part : report.parts) {
    part.data = part.make_data(part);
    part.findings = judge(part.values, part.data);
    part.claims = claims_of(part);
  }
  const int threads = settings.threads > 0 ? settings.threads : hardware_threads();
  report.about = {{"version", std::string(version())},
                  {"commit", std::string(commit())},
                  {"command", command},
                  {"compiler", compiler()},
                  {"machine", fmt::format("{}, {} threads", processor_name(), threads)},
                  {"date", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)))}};
  const Json json = results_json(report);
  const std::string text = json.dump(2, ' ', /*ensure_ascii=*/false, Json::error_handler_t::replace) + "\n";
  const std::string file = options.out + "/report.html";
  value_or_fail(write_file(options.out + "/results.json", text));
  value_or_fail(write_file(file, report_html(report, options.out)));
  CancellableSection::leave_if_cancelled();
  if (options.json)
    print(text);
  else
    print_summary(report, file);
}

// Before the shared libraries make their variables, some of which need memory.
void prepare() {
  end_in_one_line(cli::remove_unfinished);
}
__attribute__((section(".preinit_array"), used)) void (*const kFirst)() = prepare;

int run(int argc, const char* const* argv) {
  cli::handle_signals();
  name_settings_as_options();
  if (const Status status = check_target_environment(); !status) throw Failure{kBadUsage, status.error()};
  const cli::Request request = cli::parse_command_line(argc, argv);
  const auto* const options = std::get_if<ThesisOptions>(&request);
  if (options == nullptr) fail_usage("this program is started by `bihive thesis`");
  run_thesis(*options, command_of(argc, argv));
  finish_output();
  return kSuccess;
}

}  // namespace
}  // namespace bihive::thesis

int main(int argc, char** argv) {
  return bihive::exit_code_of([&] { return bihive::thesis::run(argc, argv); });
}
