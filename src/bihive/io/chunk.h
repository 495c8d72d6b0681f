// Chunks of a list, for processes that read some of a file's rows each.
#pragma once

#include <cstdint>

namespace bihive {

/// The rows of a list from `first` to before `end`.
struct RowRange {
  std::int64_t first = 0, end = 0;
  std::int64_t count() const { return end - first; }
};

/// Chunk `index` of `count` of equal length, about; they follow each other.
struct RowChunk {
  int index = 0, count = 1;

  /// Its rows of a list: from about rows * index / count on.
  RowRange of(std::int64_t rows) const { return {begin(index, rows), begin(index + 1, rows)}; }

 private:
  std::int64_t begin(int chunk, std::int64_t rows) const { return rows / count * chunk + rows % count * chunk / count; }
};

}  // namespace bihive
