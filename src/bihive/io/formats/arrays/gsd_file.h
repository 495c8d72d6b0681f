// The container of GSD files: arrays under names, frame by frame [GSD].
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/chunk.h"
#include "bihive/io/packed/random_file.h"

namespace bihive {

/// One array: rows x columns numbers, as binary64.
struct GsdArray {
  std::int64_t rows = 0, columns = 0;
  std::vector<double> values;  ///< row after row: all, or those of a chunk
};

/// Any number of threads may read at a time.
class GsdFile {
 public:
  /// Whether a file begins as a GSD file.
  static bool looks_like(std::string_view first_bytes);
  /// Errors: another format; a damaged index.
  static Result<GsdFile> open(RandomFile file);

  /// "hoomd" for simulations of HOOMD-blue.
  const std::string& schema() const { return schema_; }
  /// At least 1 if it holds any array.
  std::int64_t frame_count() const { return frames_; }
  const std::string& path() const { return file_.path(); }

  /// The array of that name in that frame; if the frame has none, that of frame 0, as the schema of HOOMD-blue says.
  /// Nothing: neither has one. With the values of the rows of `chunk` alone. Errors: damaged bytes.
  Result<std::optional<GsdArray>> array(std::int64_t frame, const std::string& name, RowChunk chunk = {}) const;
  /// Whether that frame itself has the array.
  bool has(std::int64_t frame, const std::string& name) const { return chunks_.contains({name, frame}); }
  /// Its rows, without reading it; nothing as in array().
  std::optional<std::int64_t> rows(std::int64_t frame, const std::string& name) const;

 private:
  explicit GsdFile(RandomFile file) : file_(std::move(file)) {}
  Status read_head();
  Error damaged(const std::string& what) const;

  struct Chunk {
    std::int64_t rows, place;
    std::uint32_t columns;
    std::uint8_t type;
  };
  const Chunk* find(std::int64_t frame, const std::string& name) const;

  RandomFile file_;
  std::string schema_;
  std::int64_t frames_ = 0;
  std::map<std::pair<std::string, std::int64_t>, Chunk> chunks_;
};

}  // namespace bihive
