// bihive, the program: parses the command line, runs the sub-command, and turns failures into exit codes.

#include <cxxabi.h>
#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <variant>

#include "bihive/simd/target.h"
#include "command_line.h"
#include "support/failure.h"
#include "support/interrupt.h"
#include "support/messages.h"

namespace bihive::cli {
namespace {

// One call for each kind of request.
struct Run {
  int operator()(const HelpText& help) const {
    if (help.asked_for) {
      print(help.text);
      return kSuccess;
    }
    std::fputs(help.text.c_str(), stderr);
    return kBadUsage;
  }
  int operator()(const RenderOptions& options) const { return run_render(options), kSuccess; }
  int operator()(const FilmOptions& options) const { return run_film(options), kSuccess; }
  int operator()(const ViewOptions& options) const { run_view(options); }
  int operator()(const StatsOptions& options) const { return run_stats(options), kSuccess; }
  int operator()(const TraceOptions& options) const { return run_trace(options), kSuccess; }
  int operator()(const SceneOptions& options) const { return run_scene(options), kSuccess; }
  int operator()(const InfoOptions& options) const { return run_info(options), kSuccess; }
  int operator()(const StylesOptions& options) const { return run_styles(options), kSuccess; }
  int operator()(const SelectOptions& options) const { return run_select(options), kSuccess; }
  int operator()(const ConvertOptions& options) const { return run_convert(options), kSuccess; }
  int operator()(const ThesisOptions& options) const { return run_thesis(options), kSuccess; }
  int operator()(const WebOptions& options) const { return run_web(options), kSuccess; }
};

// Says it without memory: every other way to print may need some. A progress line is cleared. Threads that fail
// together say it once: all but the first wait for the end.
void say_without_memory(const char* text) {
  static std::atomic_flag said = ATOMIC_FLAG_INIT;
  while (said.test_and_set()) pause();
  // Other threads may break in the last moment: in libraries that do not look whether there was memory.
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS})
    std::signal(signal, [](int) {
      while (true) pause();
    });
  // One write, so that nothing of another program comes between.
  char line[512];
  const char* const wipe = isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "";
  const int length = std::snprintf(line, sizeof(line), "%sbihive: error: %.400s\n", wipe, text);
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line, static_cast<std::size_t>(length));
}

constexpr const char* kNoMemory = "not enough memory";

// An exception that nobody catches, for example on a thread: one line, no unfinished file, no core.
[[noreturn]] void end_after_exception() {
  remove_unfinished();
  try {
    if (abi::__cxa_current_exception_type() != nullptr) throw;
    say_without_memory("the program ended itself");
  } catch (const std::bad_alloc&) {
    say_without_memory(kNoMemory);
  } catch (const std::exception& error) {
    say_without_memory(error.what());
  } catch (...) {
    say_without_memory("an exception that nobody expected");
  }
  _exit(kBadInput);
}

// Called when `new` finds no memory. It is asked once more, because another thread may have given some back. If there
// is none for small things either, the program ends here: many libraries lose their order when that happens in them. A
// single large wish is refused by an exception.
void on_no_memory() {
  constexpr std::size_t kSmall = 1 << 16;
  thread_local bool asked_again = false;
  void* const small = std::malloc(kSmall);
  if (small == nullptr) {
    remove_unfinished();
    say_without_memory(kNoMemory);
    _exit(kBadInput);
  }
  std::free(small);
  asked_again = !asked_again;
  if (!asked_again) throw std::bad_alloc();
}

// With a limit of address space the C library must not reserve 64 MB of it for each thread.
void prepare() {
  std::set_terminate(end_after_exception);
  std::set_new_handler(on_no_memory);
  rlimit space{};
  if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) mallopt(M_ARENA_MAX, 1);
}

// Before the shared libraries make their variables, some of which need memory.
__attribute__((section(".preinit_array"), used)) void (*const kFirst)() = prepare;

// A stream that the caller has closed leaves its number to the next file that is opened, and messages would go into
// that. The file in its place refuses writing, as a closed stream does; stderr drops it.
void fill_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (fcntl(stream, F_GETFD) < 0 && open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY) < 0) return;
}

int run(int argc, const char* const* argv) {
  try {
    fill_closed_streams();
    handle_signals();
    if (const Status status = check_target_environment(); !status) throw Failure{kBadUsage, status.error()};
    const int code = std::visit(Run{}, parse_command_line(argc, argv));
    finish_output();
    return code;
  } catch (const Failure& failure) {
    say_error(failure.error.to_string());
    std::fputs(failure.shown.c_str(), stderr);
    return failure.code;
  } catch (const std::bad_alloc&) {
    say_without_memory(kNoMemory);
  } catch (const std::length_error&) {
    say_without_memory(kNoMemory);
  } catch (const std::exception& error) {
    say_error(error.what());
  }
  return kBadInput;
}

}  // namespace
}  // namespace bihive::cli

int main(int argc, char** argv) {
  // Saying what is wrong may need memory too.
  try {
    return bihive::cli::run(argc, argv);
  } catch (const std::exception&) {
    bihive::cli::say_without_memory(bihive::cli::kNoMemory);
  }
  return bihive::cli::kBadInput;
}
