#include "bihive/base/memory.h"

#if defined(__EMSCRIPTEN__)
#include <emscripten/heap.h>
#elif defined(_WIN32)
#include <windows.h>
#else
#define BIHIVE_HAS_LIMITS 1  // of processes and control groups
#include <sys/resource.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "bihive/base/memory_groups.h"
#include "bihive/base/readable.h"

namespace bihive {
namespace {

constexpr double kLittleBytes = 1 << 20;

// Takes the smaller limit.
void lower(MemoryLimit& limit, double bytes, const char* whose) {
  if (bytes < limit.bytes) limit = {bytes, whose};
}

#ifdef BIHIVE_HAS_LIMITS

// The numbers of /proc/self/statm, in bytes: address space in use, and data that is not shared, with the stack.
struct InUse {
  double mapped = 0, data = 0;

  InUse() {
    const std::string text = beginning_of_file("/proc/self/statm");
    const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
    const char* at = text.c_str();
    for (int field = 0; field < 6; ++field) {
      char* end = nullptr;
      const double pages = std::strtod(at, &end);
      if (end == at) return;
      if (field == 0) mapped = pages * page;
      if (field == 5) data = pages * page;
      at = end;
    }
  }
};

// The limit of data that the user gave the process (ulimit -d), and whether the process has lowered it itself.
struct DataLimit {
  rlim_t given = RLIM_INFINITY;
  bool is_lowered = false;

  static DataLimit& own() {
    static DataLimit limit;
    return limit;
  }
};

void lower_by_process(MemoryLimit& limit) {
  rlimit said{};
  if (getrlimit(RLIMIT_AS, &said) == 0 && said.rlim_cur != RLIM_INFINITY)
    lower(limit, std::max(0.0, static_cast<double>(said.rlim_cur) - InUse().mapped),
          "the limit of this process (ulimit -v) leaves");
  if (DataLimit::own().is_lowered || getrlimit(RLIMIT_DATA, &said) != 0) said.rlim_cur = DataLimit::own().given;
  if (said.rlim_cur != RLIM_INFINITY)
    lower(limit, std::max(0.0, static_cast<double>(said.rlim_cur) - InUse().data),
          "the limit of this process (ulimit -d) leaves");
}

#endif

// The machine's memory and BIHIVE_MEMORY, which do not tell how much is in use.
MemoryLimit limit_of_all() {
#if defined(__EMSCRIPTEN__)
  MemoryLimit limit{static_cast<double>(emscripten_get_heap_max()), "a page has"};
#elif defined(_WIN32)
  MEMORYSTATUSEX memory{};
  memory.dwLength = sizeof memory;
  GlobalMemoryStatusEx(&memory);
  MemoryLimit limit{static_cast<double>(memory.ullTotalPhys), "this machine has"};
#else
  MemoryLimit limit{static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)),
                    "this machine has"};
#endif
  const char* const request = std::getenv("BIHIVE_MEMORY");  // NOLINT(concurrency-mt-unsafe)
  if (request == nullptr) return limit;
  char* end = nullptr;
  const double bytes = std::strtod(request, &end);
  if (end != request && *end == '\0' && bytes > 0) lower(limit, bytes, "BIHIVE_MEMORY allows");
  return limit;
}

// The limits of control groups and of the process, less what is in use.
MemoryLimit limit_of_more() {
  MemoryLimit limit{HUGE_VAL, ""};
#ifdef BIHIVE_HAS_LIMITS
  limit = memory_left_by_own_groups();
  lower_by_process(limit);
#endif
  return limit;
}

}  // namespace

MemoryLimit memory_limit() {
  const MemoryLimit all = limit_of_all(), more = limit_of_more();
  return more.bytes < all.bytes ? more : all;
}

double memory_bytes() {
  return memory_limit().bytes;
}

Status check_memory(double bytes, const std::string& what, double held_bytes, double overhead_bytes) {
  MemoryLimit limit = limit_of_all();
  double wanted = bytes + held_bytes;
  if (wanted <= limit.bytes) {
    wanted = bytes + overhead_bytes;
    // The files that tell the limits take longer to read than so little takes to fill.
    if (wanted <= kLittleBytes) return Done{};
    limit = limit_of_more();
  }
  if (wanted <= limit.bytes) return Done{};
  return Error{what + " would take about " + readable_bytes(wanted) + " of memory, and " + limit.whose + " " +
                   readable_bytes(limit.bytes),
               "", 0, 0, ""};
}

Error no_memory_for(const std::string& what) {
  const MemoryLimit limit = memory_limit();
  return {"not enough memory for " + what + ": " + limit.whose + " " + readable_bytes(limit.bytes), "", 0, 0, ""};
}

const char* turn_group_limit_into_failing_allocations(double allowance_bytes) {
#ifdef BIHIVE_HAS_LIMITS
  const MemoryLimit left = memory_left_by_own_groups();
  const double machine = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  rlimit said{};
  if (!(left.bytes < machine) || getrlimit(RLIMIT_DATA, &said) != 0) return nullptr;
  DataLimit& own = DataLimit::own();
  if (!own.is_lowered) own = {said.rlim_cur, true};
  // Tables of pages, stacks of the kernel and the like count as well.
  constexpr double kShareOfSystem = 1.0 / 64;
  const double data = InUse().data + left.bytes * (1 - kShareOfSystem) + allowance_bytes;
  const rlim_t most = std::min(own.given, said.rlim_max);
  said.rlim_cur = data < static_cast<double>(most) ? static_cast<rlim_t>(data) : most;
  if (setrlimit(RLIMIT_DATA, &said) != 0) return nullptr;
  static const std::string text = "not enough memory: " + left.whose + " too little";
  return text.c_str();
#else
  static_cast<void>(allowance_bytes);
  return nullptr;
#endif
}

}  // namespace bihive
