#include "bihive/base/resident_memory.h"

#include <cinttypes>
#include <cstdio>
#include <memory>
#include <string>

namespace bihive {
namespace {

struct Closes {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using SystemFile = std::unique_ptr<std::FILE, Closes>;

// A line of /proc/self/status in bytes; 0 if the system has none.
std::int64_t status_bytes(const char* name) {
  const SystemFile status(std::fopen("/proc/self/status", "r"));
  if (!status) return 0;
  const std::string wanted = std::string(name) + ": %" SCNd64 " kB";
  std::int64_t kilobytes = 0;
  for (char line[256]; std::fgets(line, sizeof line, status.get()) != nullptr;)
    if (std::sscanf(line, wanted.c_str(), &kilobytes) == 1) return kilobytes * 1024;
  return 0;
}

}  // namespace

std::int64_t resident_bytes() {
  return status_bytes("VmRSS");
}

std::int64_t peak_bytes() {
  return status_bytes("VmHWM");
}

bool forget_peak() {
  const SystemFile file(std::fopen("/proc/self/clear_refs", "w"));
  return file && std::fputs("5", file.get()) >= 0 && std::fflush(file.get()) == 0;
}

}  // namespace bihive
