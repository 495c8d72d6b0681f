#include "bihive/base/memory_groups.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "bihive/base/readable.h"

namespace bihive {
namespace {

// The number at the beginning of a file, if it is above 0; else 0. "max" is not a number.
double number_in(const std::string& path) {
  const std::string text = beginning_of_file(path);
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return end != text.c_str() && number > 0 ? number : 0;
}

// The number after a name at the beginning of a line; 0 if it is not there.
double number_of(const std::string& lines, const std::string& name) {
  const std::size_t at = ("\n" + lines).find("\n" + name + " ");
  return at == std::string::npos ? 0 : std::strtod(lines.c_str() + at + name.size(), nullptr);
}

// The groups with a limit on the way from a control group up to the root of its tree.
void add_groups(std::vector<LimitedGroup>& groups, const std::string& root, std::string group, bool version_2) {
  while (true) {
    const std::string folder = root + (group == "/" ? "" : group) + "/memory.";
    const LimitedGroup here = version_2
                                  ? LimitedGroup{folder + "max", folder + "current", folder + "stat"}
                                  : LimitedGroup{folder + "limit_in_bytes", folder + "usage_in_bytes", folder + "stat"};
    if (number_in(here.limit) > 0) groups.push_back(here);
    if (group.empty() || group == "/") return;
    group.resize(group.rfind('/'));
  }
}

double machine_bytes() {
  return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
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
std::vector<LimitedGroup> limited_groups(const std::string& groups_file, const std::string& root) {
  std::vector<LimitedGroup> groups;
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
    if (controllers == ",,") add_groups(groups, root, group, true);
    if (controllers.find(",memory,") != std::string::npos) add_groups(groups, root + "/memory", group, false);
  }
  return groups;
}

MemoryLimit memory_left_by_groups(const std::vector<LimitedGroup>& groups) {
  MemoryLimit left{HUGE_VAL, ""};
  for (const LimitedGroup& group : groups) {
    const double limit = number_in(group.limit);
    if (!(limit > 0)) continue;
    // Version 1 gives the sums over the groups below under names of their own.
    const std::string facts = beginning_of_file(group.statistics);
    const bool has_sums = facts.find("\ntotal_active_file ") != std::string::npos;
    const std::string prefix = has_sums ? "total_" : "";
    const double droppable = number_of(facts, prefix + "inactive_file") + number_of(facts, prefix + "active_file");
    const double bytes = std::max(0.0, limit - std::max(0.0, number_in(group.usage) - droppable));
    if (bytes < left.bytes) left = {bytes, "this control group, which allows " + readable_bytes(limit) + ", leaves"};
  }
  return left;
}

MemoryLimit memory_left_by_own_groups() {
  // Groups seldom change; what they leave does. Limits above the machine's memory do not count.
  static const std::vector<LimitedGroup> groups = [] {
    std::vector<LimitedGroup> all = limited_groups("/proc/self/cgroup", "/sys/fs/cgroup");
    const double machine = machine_bytes();
    const auto is_none = [&](const LimitedGroup& group) { return number_in(group.limit) >= machine; };
    all.erase(std::remove_if(all.begin(), all.end(), is_none), all.end());
    return all;
  }();
  return memory_left_by_groups(groups);
}

}  // namespace bihive
