// bihive, the program: parses the command line, runs the sub-command, and turns failures into exit codes.

#include <fcntl.h>
#include <unistd.h>

#include <variant>

#include "../shared/exit_code.h"
#include "../shared/last_line.h"
#include "bihive/base/memory.h"
#include "bihive/base/parallel.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/job/scene_request.h"
#include "bihive/simd/target.h"
#include "command_line.h"
#include "film/film_sink.h"
#include "support/interrupt.h"
#include "support/outputs.h"
#include "support/request_files.h"
#include "support/sibling_program.h"
#include "words/read_program_words.h"

namespace bihive::cli {
namespace {

// The request of a command that draws nothing: of a picture's request in a scene file it takes the input.
template <class Options>
Options with_input(const Options& asked) {
  Options options = asked;
  // The scene file is an input as well.
  if constexpr (requires { outputs_of(options); }) check_outputs(outputs_of(options), inputs_of(options));
  if constexpr (requires { options.tree; })
    take_saved_input(options.input, &options.tree);
  else
    take_saved_input(options.input);
  return options;
}

// One call for each kind of request.
struct Run {
  const char* const* arguments;  // argv

  int operator()(const HelpText& help) const {
    if (help.asked_for) {
      print(help.text);
      return kSuccess;
    }
    say_lines(help.text);
    return kBadUsage;
  }
  int operator()(const RenderOptions& options) const { return run_render(options), kSuccess; }
  int operator()(const AgainOptions& options) const { return run_again(options), kSuccess; }
  int operator()(const VerifyOptions& options) const { return run_verify(options) ? kSuccess : kBadInput; }
  int operator()(const FilmOptions& options) const { return run_film(options), kSuccess; }
  int operator()(const ViewOptions& options) const { run_view(options); }
  int operator()(const StatsOptions& options) const { return run_stats(with_input(options)), kSuccess; }
  int operator()(const CompareOptions& options) const { return run_compare(with_input(options)), kSuccess; }
  int operator()(const TuneCommandOptions& options) const { return run_tune(with_input(options)), kSuccess; }
  int operator()(const TraceOptions& options) const { return run_trace(with_input(options)), kSuccess; }
  int operator()(const SceneOptions& options) const { return run_scene(options), kSuccess; }
  int operator()(const SceneSaveOptions& options) const { return run_scene_save(options), kSuccess; }
  int operator()(const InfoOptions& options) const { return run_info(with_input(options)), kSuccess; }
  int operator()(const StylesOptions& options) const { return run_styles(options), kSuccess; }
  int operator()(const SelectOptions& options) const { return run_select(with_input(options)), kSuccess; }
  int operator()(const MeasureCommandOptions& options) const { return run_measure(with_input(options)), kSuccess; }
  int operator()(const ConvertOptions& options) const { return run_convert(with_input(options)), kSuccess; }
  int operator()(const ThesisOptions& options) const {
    if (!options.page.empty()) return write_phone_page(options.page), kSuccess;
    become_program("bihive-thesis", arguments, "build it: cmake --build build --target bihive-thesis");
  }
  int operator()(const WebOptions& options) const { return run_web(options), kSuccess; }
};

void prepare() {
  end_in_one_line(remove_unfinished);
}

// Before the shared libraries make their variables, some of which need memory.
__attribute__((section(".preinit_array"), used)) void (*const kFirst)() = prepare;

// If the caller has closed a stream, the next opened file would get its number, and messages would go into that. The
// file that replaces it refuses writing, as a closed stream does; stderr drops it.
void fill_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
}

// With a control group that limits memory, allocations fail before the kernel kills the program. Servers and windows
// live long beside other processes, and refuse by predictions alone.
void keep_within_control_group(const Request& request) {
  if (std::holds_alternative<WebOptions>(request) || std::holds_alternative<ViewOptions>(request) ||
      std::holds_alternative<ThesisOptions>(request) || std::holds_alternative<HelpText>(request))
    return;
  const auto* const film = std::get_if<FilmOptions>(&request);
  // ffmpeg would inherit the limit, which is not its own.
  if (film != nullptr && (film->join || film_kind(film->picture.output) == FilmKind::encoded)) return;
  // Stacks of threads are reserved, but hardly used: create the threads first. A film has some of its own.
  constexpr double kStack = 8 << 20, kOwnThreadsOfFilm = 4;
  const double of_film = film != nullptr ? kOwnThreadsOfFilm * kStack : 0;
  const int threads = hardware_threads();
  const char* const text = turn_group_limit_into_failing_allocations(2 * threads * kStack + of_film);
  if (text == nullptr) return;
  name_limit_of_memory(text);
  parallel_for(0, 4 * threads, [](std::int64_t) {});
  turn_group_limit_into_failing_allocations(of_film);
}

int run(int argc, const char* const* argv) {
  fill_closed_streams();
  handle_signals();
  name_settings_as_options();
  if (const Status status = check_target_environment(); !status) throw Failure{kBadUsage, status.error()};
  const Request request = parse_command_line(argc, argv, describe);
  keep_within_control_group(request);
  const int code = std::visit(Run{argv}, request);
  finish_output();
  return code;
}

}  // namespace
}  // namespace bihive::cli

int main(int argc, char** argv) {
  return bihive::exit_code_of([&] { return bihive::cli::run(argc, argv); });
}
