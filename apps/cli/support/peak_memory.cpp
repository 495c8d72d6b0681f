#include "support/peak_memory.h"

#include <sys/resource.h>

namespace bihive::cli {

double peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

}  // namespace bihive::cli
