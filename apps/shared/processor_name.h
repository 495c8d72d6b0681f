// The name of the machine's processor.
#pragma once

#include <algorithm>
#include <fstream>
#include <string>

namespace bihive {

/// As the system names it; "unknown processor" if it does not.
inline std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.rfind("model name", 0) == 0) return line.substr(std::min(line.size(), line.find(':') + 2));
  return "unknown processor";
}

}  // namespace bihive
