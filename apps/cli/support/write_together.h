// Writes several files that belong together: all or none.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bihive::cli {

struct FileToWrite {
  std::string path;
  std::string_view bytes;
};

/// Writes the regular files under temporary names, then the pipes and devices, then renames all regular files, or none.
/// Fails with the first error. Signals are deferred while files are written, but not while a pipe is (interrupt.h).
void write_together(const std::vector<FileToWrite>& files);

}  // namespace bihive::cli
