#include "bihive/base/memory_groups.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace bihive {
namespace {

// The lowest limit on the way from a control group up to the root of its tree. The word "max" is none.
void lower_by_groups(MemoryLimit& limit, const std::string& root, std::string group, const char* name) {
  while (true) {
    const std::string text = beginning_of_file(root + (group == "/" ? "" : group) + "/" + name);
    char* end = nullptr;
    const double bytes = std::strtod(text.c_str(), &end);
    if (end != text.c_str() && bytes > 0 && bytes < limit.bytes) limit = {bytes, "this control group allows"};
    if (group.empty() || group == "/") return;
    group.resize(group.rfind('/'));
  }
}

}  // namespace

std::string beginning_of_file(const std::string& path) {
  std::FILE* const file = std::fopen(path.c_str(), "re");
  if (file == nullptr) return "";
  char bytes[4096];
  const std::size_t count = std::fread(bytes, 1, sizeof(bytes), file);
  std::fclose(file);
  return {bytes, count};
}

// Each line of the file is "number:controllers:group". Inside a container the group may be named as it is seen
// from outside; then the root of the tree is the container's own.
MemoryLimit memory_limit_of_groups(const std::string& groups_file, const std::string& root) {
  MemoryLimit limit{HUGE_VAL, ""};
  std::string lines = beginning_of_file(groups_file);
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
    if (controllers == ",,") lower_by_groups(limit, root, group, "memory.max");
    if (controllers.find(",memory,") != std::string::npos)
      lower_by_groups(limit, root + "/memory", group, "memory.limit_in_bytes");
  }
  return limit;
}

}  // namespace bihive
