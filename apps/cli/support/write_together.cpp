#include "support/write_together.h"

#include <deque>

#include "bihive/base/write_file.h"
#include "bihive/job/failure.h"
#include "support/interrupt.h"

namespace bihive::cli {

void write_together(const std::vector<FileToWrite>& files) {
  std::deque<RemovedWhenEnded> removed;
  std::vector<GrowingFile> aside;
  {
    const WritingSection section;
    for (const FileToWrite& file : files) {
      if (is_stream(file.path)) continue;
      aside.push_back(value_or_fail(GrowingFile::begin(file.path)));
      removed.emplace_back(aside.back().path_aside());
      value_or_fail(aside.back().append(file.bytes));
    }
  }
  for (const FileToWrite& file : files) {
    if (!is_stream(file.path)) continue;
    const StreamSection nobody_may_read;
    value_or_fail(write_file(file.path, file.bytes));
  }
  const WritingSection section;
  value_or_fail(GrowingFile::finish_together(aside));
}

}  // namespace bihive::cli
