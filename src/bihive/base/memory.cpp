#include "bihive/base/memory.h"

#include <unistd.h>

#ifdef __EMSCRIPTEN__
#include <emscripten/heap.h>
#endif

#include <algorithm>
#include <cstdlib>

#include "bihive/base/readable.h"

namespace bihive {
namespace {

double whole_memory() {
#ifdef __EMSCRIPTEN__
  return static_cast<double>(emscripten_get_heap_max());
#else
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
#endif
}

}  // namespace

double memory_bytes() {
  const double whole = whole_memory();
  const char* const wish = std::getenv("BIHIVE_MEMORY");  // NOLINT(concurrency-mt-unsafe)
  if (wish == nullptr) return whole;
  char* end = nullptr;
  const double bytes = std::strtod(wish, &end);
  return end != wish && *end == '\0' && bytes > 0 ? std::min(bytes, whole) : whole;
}

Status check_memory(double bytes, const std::string& what) {
  const double there = memory_bytes();
  if (bytes <= there) return Done{};
#ifdef __EMSCRIPTEN__
  const std::string place = "a page";
#else
  const std::string place = "this machine";
#endif
  return Error{what + " would take about " + readable_bytes(bytes) + " of memory, and " + place + " has " +
                   readable_bytes(there),
               "", 0, 0, ""};
}

}  // namespace bihive
