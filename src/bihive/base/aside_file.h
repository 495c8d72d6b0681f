// New files on their way to their path: without a name, or under a random one; and those that a killed program left.
#pragma once

#include <sys/types.h>

#include <optional>
#include <string>
#include <string_view>

namespace bihive {

/// ".bihive-0123456789abcdef.kept": holds the only copy of a file for a moment, so that no program removes it.
std::string random_kept_name();
/// Whether random_part_name() (open_file.h) may have made it.
bool is_part_name(std::string_view name);

/// Removes the files that killed programs left in the folder, a descriptor: regular files under such names, of this
/// user or of `also_of`, on which no living program holds a lock. A folder of very many files is read once a minute at
/// most.
void remove_left_parts(int folder, uid_t also_of);

/// A locked file without a name, readable and writable; -1 where the system has none, or no way to name it later. The
/// file mode creation mask applies to `mode`.
int open_nameless(int folder, mode_t mode);

/// A locked file under a new random name. -1 and errno after a failure.
int open_under_random_name(int folder, mode_t mode, std::string& name);

/// "/proc/self/fd/3"
std::string path_of_descriptor(int file);

}  // namespace bihive
