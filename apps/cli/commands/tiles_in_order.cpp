#include "commands/tiles_in_order.h"

#include <utility>

namespace bihive::cli {

void TilesInOrder::add(std::int64_t number, Film film) {
  early_.emplace(number, std::move(film));
  while (rows_written_ < tiles_.rows() && has_row(rows_written_)) {
    const Film row = take_row(rows_written_);
    if (status_) status_ = file_.add(row, tiles_.pixels_of_row(rows_written_));
    ++rows_written_;
  }
  progress_(static_cast<double>(++added_) / static_cast<double>(tiles_.count()));
}

// All tiles before the row are written, so those of the row are the first kept.
bool TilesInOrder::has_row(int row) const {
  const std::int64_t last = std::int64_t{row + 1} * tiles_.columns() - 1;
  auto tile = early_.begin();
  for (int column = 0; column < tiles_.columns(); ++column, ++tile)
    if (tile == early_.end() || tile->first > last) return false;
  return true;
}

Film TilesInOrder::take_row(int row) {
  if (tiles_.columns() == 1) return std::move(early_.extract(early_.begin()).mapped());
  const Tile all = tiles_.pixels_of_row(row);
  Film film;
  film.resize(all.width(), all.height(), !early_.begin()->second.coverage.empty());
  for (int column = 0; column < tiles_.columns(); ++column) {
    const auto tile = early_.extract(early_.begin());
    const Tile pixels = tiles_.pixels(tile.key());
    paste(tile.mapped(), pixels.x0 - all.x0, 0, film);
  }
  return film;
}

}  // namespace bihive::cli
