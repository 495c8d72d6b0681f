// Several files that belong together come into being all or not at all.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace bihive::cli {

struct FileToWrite {
  std::string path;
  std::string_view bytes;
};

/// Writes all of them aside first and renames them then, so that a full disk leaves every path as it was. Pipes and
/// devices are written to last. Fails with what went wrong first. Signals wait meanwhile (interrupt.h).
void write_together(const std::vector<FileToWrite>& files);

}  // namespace bihive::cli
