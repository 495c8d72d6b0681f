// Chunks of a file's spheres, for sets that several processes read together (spread/read_chunk.h). Nothing here waits
// for another process: what must be known of all chunks is handed in.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/io/chunk.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// Whether chunks of this file can be read: NPY with three or four columns, in C order; GSD, H5MD and LAMMPS dumps of
/// one frame with many particles. Not packed, as it lies on a disk. Other files are read as a whole.
bool can_read_chunks(const std::string& path);

/// A chunk that was opened, but not read yet.
struct FileChunk {
  /// Equal in all processes that see the same file: its format, shape, size, and samples of its contents.
  std::vector<double> facts;
  std::int64_t rows = 0;
  /// The numbers decide whether a column is a text, numbers, or nothing: compare columns_of() of all chunks.
  bool columns_may_differ = false;
  /// Reads the rows, of which `first` lie before this chunk and `all` in all chunks. Errors as those of the reader of
  /// the whole file. At most once.
  std::function<Result<RawSpheres>(std::int64_t first, std::int64_t all)> read;
};
/// Errors: the file cannot be opened.
Result<FileChunk> open_chunk(const std::string& path, RowChunk chunk);

/// Equal for chunks of the same columns, all of which are numbers; nothing: some are texts.
std::optional<double> columns_of(const RawSpheres& spheres);

/// Facts about a chunk's ids for ids_increase().
std::vector<double> ids_of(const RawSpheres& chunk);
/// Whether the chunks of a file with these facts, one after the other, are chunks of the set, whose spheres are in the
/// order of their ids.
bool ids_increase(const std::vector<std::vector<double>>& of_chunks);

}  // namespace bihive
