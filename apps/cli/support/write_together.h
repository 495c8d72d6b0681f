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

/// Writes the regular files aside first, then the pipes and devices, then all regular files take their places, or none.
/// Fails with the first error. Signals wait while files are written, but not while a pipe is (interrupt.h).
void write_together(const std::vector<FileToWrite>& files);

}  // namespace bihive::cli
