// The memory that the control groups of this process allow (containers, services), versions 1 and 2.
#pragma once

#include <string>

#include "bihive/base/memory.h"

namespace bihive {

/// The smallest limit of the process's groups and of those above them; infinite bytes if there is none. `groups_file`
/// is /proc/self/cgroup and `root` /sys/fs/cgroup, or others in their place for a test.
MemoryLimit memory_limit_of_groups(const std::string& groups_file, const std::string& root);

/// The first 4,096 bytes of a file of the system; an empty text if there is none.
std::string beginning_of_file(const std::string& path);

}  // namespace bihive
