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

/// Writes all of them beside their paths first and then renames them, so that a full disk leaves every path as it was.
/// Pipes and devices are written last. Fails with the first error. Signals wait meanwhile (interrupt.h).
void write_together(const std::vector<FileToWrite>& files);

}  // namespace bihive::cli
