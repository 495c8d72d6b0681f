#include "bihive/base/memory.h"

#include <unistd.h>

#ifdef __EMSCRIPTEN__
#include <emscripten/heap.h>
#else
#include <sys/resource.h>
#endif

#include <algorithm>
#include <cstdlib>

#include "bihive/base/memory_groups.h"
#include "bihive/base/readable.h"

namespace bihive {
namespace {

// Takes the smaller limit.
void lower(MemoryLimit& limit, double bytes, const char* whose) {
  if (bytes < limit.bytes) limit = {bytes, whose};
}

#ifndef __EMSCRIPTEN__

// Bytes of address space in use.
double mapped_bytes() {
  const std::string text = beginning_of_file("/proc/self/statm");
  return std::strtod(text.c_str(), nullptr) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

void lower_by_process(MemoryLimit& limit) {
  rlimit said{};
  if (getrlimit(RLIMIT_AS, &said) == 0 && said.rlim_cur != RLIM_INFINITY)
    lower(limit, std::max(0.0, static_cast<double>(said.rlim_cur) - mapped_bytes()),
          "the limit of this process (ulimit -v) leaves");
  if (getrlimit(RLIMIT_DATA, &said) == 0 && said.rlim_cur != RLIM_INFINITY)
    lower(limit, static_cast<double>(said.rlim_cur), "the limit of this process (ulimit -d) allows");
}

#endif

}  // namespace

MemoryLimit memory_limit() {
#ifdef __EMSCRIPTEN__
  MemoryLimit limit{static_cast<double>(emscripten_get_heap_max()), "a page has"};
#else
  MemoryLimit limit{static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE)),
                    "this machine has"};
  // Groups seldom change, and asking for them opens files.
  static const MemoryLimit groups = memory_limit_of_groups("/proc/self/cgroup", "/sys/fs/cgroup");
  if (groups.bytes < limit.bytes) limit = groups;
  lower_by_process(limit);
#endif
  const char* const wish = std::getenv("BIHIVE_MEMORY");  // NOLINT(concurrency-mt-unsafe)
  if (wish == nullptr) return limit;
  char* end = nullptr;
  const double bytes = std::strtod(wish, &end);
  if (end != wish && *end == '\0' && bytes > 0) lower(limit, bytes, "BIHIVE_MEMORY allows");
  return limit;
}

double memory_bytes() {
  return memory_limit().bytes;
}

Status check_memory(double bytes, const std::string& what) {
  const MemoryLimit limit = memory_limit();
  if (bytes <= limit.bytes) return Done{};
  return Error{what + " would take about " + readable_bytes(bytes) + " of memory, and " + limit.whose + " " +
                   readable_bytes(limit.bytes),
               "", 0, 0, ""};
}

}  // namespace bihive
