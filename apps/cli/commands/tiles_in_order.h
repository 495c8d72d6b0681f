// Reorders the tiles of a picture, drawn in any order, for a file written from the top.
#pragma once

#include <cstdint>
#include <map>

#include "bihive/base/result.h"
#include "bihive/image/film.h"
#include "bihive/render/picture_tiles.h"
#include "commands/picture_file.h"

namespace bihive::cli {

/// Writes rows of tiles into the file in order, and keeps tiles that arrive early.
class TilesInOrder {
 public:
  /// All must outlive it.
  TilesInOrder(const PictureTiles& tiles, PictureFile& file, const ProgressCallback& progress)
      : tiles_(tiles), file_(file), progress_(progress) {}

  void add(std::int64_t number, Film film);
  /// The first error of the file.
  const Status& status() const { return status_; }

 private:
  bool has_row(int row) const;
  Film take_row(int row);

  const PictureTiles& tiles_;
  PictureFile& file_;
  const ProgressCallback& progress_;
  std::map<std::int64_t, Film> early_;  // tiles of rows not yet written
  std::int64_t added_ = 0;
  int rows_written_ = 0;
  Status status_ = Done{};
};

}  // namespace bihive::cli
