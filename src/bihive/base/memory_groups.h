// The memory that the control groups of this process allow (containers, services), versions 1 and 2.
#pragma once

#include <string>
#include <vector>

#include "bihive/base/memory.h"

namespace bihive {

/// A control group that limits this process's memory: the files that tell its limit and what it uses.
struct LimitedGroup {
  std::string limit, usage, statistics;
};

/// The process's groups and those above them, if they have a limit. `groups_file` is /proc/self/cgroup and `root`
/// /sys/fs/cgroup, or substitutes in a test.
std::vector<LimitedGroup> limited_groups(const std::string& groups_file, const std::string& root);

/// What the groups leave: the smallest limit less what is in use, by other processes of the group too. Pages of files
/// that the system can drop at any time do not count as used. Infinite bytes if there is no limit.
MemoryLimit memory_left_by_groups(const std::vector<LimitedGroup>& groups);

/// What the groups of this process leave, as memory_left_by_groups(). The list of groups is read once.
MemoryLimit memory_left_by_own_groups();

/// The first 4,096 bytes of a file of the system; an empty text if there is none.
std::string beginning_of_file(const std::string& path);

}  // namespace bihive
