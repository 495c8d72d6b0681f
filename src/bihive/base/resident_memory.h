// The memory that this process holds, and its peak, as Linux reports them.
#pragma once

#include <cstdint>
#include <fstream>
#include <string>

namespace bihive {

/// A line of /proc/self/status in bytes; 0 if the system has none.
inline std::int64_t status_bytes(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    std::int64_t kilobytes = 0;
    if (word == name + ":" && status >> kilobytes) return kilobytes * 1024;
  }
  return 0;
}

/// Resident bytes now; 0 if the system does not report them.
inline std::int64_t resident_bytes() {
  return status_bytes("VmRSS");
}

/// The peak of resident bytes since forget_peak(); 0 if the system does not report it.
inline std::int64_t peak_bytes() {
  return status_bytes("VmHWM");
}
/// False where the system does not let a process do so; peak_bytes() is that since its start then.
inline bool forget_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace bihive
