// A chunk of a LAMMPS dump: some of its lines.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bihive/base/result.h"
#include "bihive/io/chunk.h"
#include "bihive/io/packed/random_file.h"
#include "bihive/io/raw_spheres.h"

namespace bihive {

/// The atoms of a file that begins as a dump, no column of which needs all rows (io/text/sphere_table.h), and that is
/// as large as one frame alone makes it, with ids in order. Nothing: chunks of it cannot be read.
std::optional<std::int64_t> atoms_in_chunks(const RandomFile& file);

/// The lines before the atoms, around the one that states their number.
struct DumpHead {
  std::string before_count, after_count;
  std::int64_t atoms = 0;
  std::int64_t lines = 0, count_line = 0;
  std::int64_t end = 0;      ///< where the first atom begins
  double line_bytes = 0;     ///< of the first atoms, in the mean
  bool ids_increase = true;  ///< those of the first atoms
};

/// The atoms whose lines begin in a chunk of the bytes.
class DumpChunk {
 public:
  static Result<DumpChunk> read(const RandomFile& file, RowChunk chunk);
  std::int64_t rows() const { return rows_; }

  /// `first`: lines in the chunks before; `all`: in all chunks. Errors as those of the reader of the whole file; more
  /// or fewer lines than atoms. At most once: the lines are gone then.
  Result<RawSpheres> spheres(std::int64_t first, std::int64_t all);

 private:
  std::string path_, lines_;
  std::int64_t rows_ = 0;
  DumpHead head_;
};

}  // namespace bihive
