// A picture in tiles that several processes or threads draw in any order.
#pragma once

#include <cstdint>

#include "bihive/render/renderer.h"

namespace bihive {

/// Several tiles for each of those who draw, so that an expensive corner does not keep one of them alone. Small tiles
/// cost more, because effects that look at neighbouring pixels draw the border of a tile anew.
class PictureTiles {
 public:
  /// `who_draw`: at least 1.
  PictureTiles(const RenderSettings& settings, int who_draw);

  /// Tiles are numbered row by row, in each row from the left.
  std::int64_t count() const { return std::int64_t{columns_} * rows_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  /// A tile's pixels in the whole picture.
  Tile pixels(std::int64_t number) const;
  /// All pixels of a row of tiles.
  Tile pixels_of_row(int row) const;

 private:
  Tile all_;
  int width_, height_;  // of a tile; those on the right and below may be smaller
  int columns_, rows_;
};

}  // namespace bihive
