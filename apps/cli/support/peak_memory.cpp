#include "support/peak_memory.h"

#include <sys/resource.h>

#include <cstdio>

namespace bihive::cli {

// Linux keeps ru_maxrss through exec(): it would be that of a large program that called this one.
double peak_memory_bytes() {
  double kilobytes = 0;
  if (std::FILE* const status = std::fopen("/proc/self/status", "re")) {
    char line[256];
    while (std::fgets(line, sizeof(line), status) != nullptr)
      if (std::sscanf(line, "VmHWM: %lf kB", &kilobytes) == 1) break;
    std::fclose(status);
  }
  if (kilobytes > 0) return 1024 * kilobytes;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace bihive::cli
