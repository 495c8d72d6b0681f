#include "last_line.h"

#include <cxxabi.h>
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

namespace bihive {
namespace {

constexpr int kExitCode = 1;

void (*g_before_end)() = nullptr;

char g_no_memory[200];  // empty: kNoMemory

void prepare_end() {
  if (g_before_end != nullptr) g_before_end();
}

// An uncaught exception, for example on a thread: one line, no unfinished file, no core.
[[noreturn]] void end_after_exception() {
  prepare_end();
  try {
    if (abi::__cxa_current_exception_type() != nullptr) throw;
    say_without_memory("the program ended itself");
  } catch (const std::bad_alloc&) {
    say_no_memory();
  } catch (const std::exception& error) {
    say_without_memory(error.what());
  } catch (...) {
    say_without_memory("an exception that nobody expected");
  }
  _exit(kExitCode);
}

// Called when `new` finds no memory. It retries once, because another thread may have freed some. If even small
// allocations fail, the program ends here: many libraries cannot handle that. A single large request is refused by an
// exception.
void on_no_memory() {
  constexpr std::size_t kSmall = 1 << 16;
  thread_local bool asked_again = false;
  void* const small = std::malloc(kSmall);
  if (small == nullptr) {
    prepare_end();
    say_no_memory();
    _exit(kExitCode);
  }
  std::free(small);
  asked_again = !asked_again;
  if (!asked_again) throw std::bad_alloc();
}

}  // namespace

void say_without_memory(const char* text) {
  static std::atomic_flag said = ATOMIC_FLAG_INIT;
  while (said.test_and_set()) pause();
  // Other threads may crash in the last moment, in libraries that do not check their allocations.
  for (const int signal : {SIGSEGV, SIGABRT, SIGBUS})
    std::signal(signal, [](int) {
      while (true) pause();
    });
  // One write, so that no other program's output is interleaved.
  char line[512];
  const char* const wipe = isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "";
  const int length = std::snprintf(line, sizeof(line), "%sbihive: error: %.400s\n", wipe, text);
  // The text of an exception may hold anything, and base/readable.h needs memory.
  for (char* c = line + std::strlen(wipe); *c != 0; ++c)
    if ((*c < ' ' && *c != '\n') || *c > '~') *c = '?';
  [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, line, static_cast<std::size_t>(length));
}

void say_no_memory() {
  say_without_memory(g_no_memory[0] != '\0' ? g_no_memory : kNoMemory);
}

void name_limit_of_memory(const char* text) {
  std::snprintf(g_no_memory, sizeof(g_no_memory), "%s", text);
}

// With a limit of address space the C library must not reserve 64 MB of it per thread.
void end_in_one_line(void (*before_end)()) {
  g_before_end = before_end;
  std::set_terminate(end_after_exception);
  std::set_new_handler(on_no_memory);
  rlimit space{};
  if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) mallopt(M_ARENA_MAX, 1);
}

}  // namespace bihive
