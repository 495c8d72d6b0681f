#include "bihive/base/memory.h"

#include <unistd.h>

#ifdef __EMSCRIPTEN__
#include <emscripten/heap.h>
#else
#include <sys/resource.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bihive/base/readable.h"

namespace bihive {
namespace {

// Takes the smaller limit.
void lower(MemoryLimit& limit, double bytes, const char* whose) {
  if (bytes < limit.bytes) limit = {bytes, whose};
}

#ifndef __EMSCRIPTEN__

// The beginning of a short file of the system; an empty text if there is none.
std::string beginning_of(const std::string& path) {
  std::FILE* const file = std::fopen(path.c_str(), "re");
  if (file == nullptr) return "";
  char bytes[4096];
  const std::size_t count = std::fread(bytes, 1, sizeof(bytes), file);
  std::fclose(file);
  return {bytes, count};
}

// The lowest limit on the way from a control group up to the root of its tree. The word "max" is none.
void lower_by_groups(MemoryLimit& limit, const std::string& root, std::string group, const char* name) {
  while (true) {
    const std::string text = beginning_of(root + (group == "/" ? "" : group) + "/" + name);
    char* end = nullptr;
    const double bytes = std::strtod(text.c_str(), &end);
    if (end != text.c_str() && bytes > 0) lower(limit, bytes, "this control group allows");
    if (group.empty() || group == "/") return;
    group.resize(group.rfind('/'));
  }
}

// Each line of /proc/self/cgroup is "number:controllers:group". Inside a container the group may be named as it is seen
// from outside; then the root of the tree is the container's own.
MemoryLimit limit_of_groups() {
  MemoryLimit limit{HUGE_VAL, ""};
  std::string lines = beginning_of("/proc/self/cgroup");
  while (!lines.empty()) {
    const std::size_t end = std::min(lines.find('\n'), lines.size());
    const std::string line = lines.substr(0, end);
    lines.erase(0, end + 1);
    const std::size_t first = line.find(':');
    const std::size_t second = first == std::string::npos ? first : line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
    const std::string group = line.substr(second + 1);
    if (group.rfind('/', 0) != 0) continue;
    if (controllers == ",,") lower_by_groups(limit, "/sys/fs/cgroup", group, "memory.max");
    if (controllers.find(",memory,") != std::string::npos)
      lower_by_groups(limit, "/sys/fs/cgroup/memory", group, "memory.limit_in_bytes");
  }
  return limit;
}

// Bytes of address space in use.
double mapped_bytes() {
  const std::string text = beginning_of("/proc/self/statm");
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
  static const MemoryLimit groups = limit_of_groups();
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
