#include "bihive/image/film.h"

#include <algorithm>

namespace bihive {

std::vector<Tile> tiles_of(int width_px, int height_px, int tile_px) {
  return tiles_of({0, 0, width_px, height_px}, tile_px);
}

std::vector<Tile> tiles_of(const Tile& part, int tile_px) {
  std::vector<Tile> tiles;
  for (int y = part.y0; y < part.y1; y += tile_px)
    for (int x = part.x0; x < part.x1; x += tile_px)
      tiles.push_back({x, y, std::min(x + tile_px, part.x1), std::min(y + tile_px, part.y1)});
  return tiles;
}

Film part_of(const Film& film, const Tile& part) {
  Film cut;
  cut.resize(part.width(), part.height(), !film.coverage.empty());
  for (int y = 0; y < cut.height; ++y)
    for (int x = 0; x < cut.width; ++x) {
      const std::size_t from = film.number_of(part.x0 + x, part.y0 + y);
      const std::size_t to = cut.number_of(x, y);
      cut.radiance[to] = film.radiance[from];
      if (!cut.coverage.empty()) cut.coverage[to] = film.coverage[from];
    }
  return cut;
}

void paste(const Film& part, int x, int y, Film& film) {
  for (int row = 0; row < part.height; ++row) {
    const std::size_t from = part.number_of(0, row);
    const std::size_t to = film.number_of(x, y + row);
    std::copy_n(part.radiance.data() + from, part.width, film.radiance.data() + to);
    if (!part.coverage.empty()) std::copy_n(part.coverage.data() + from, part.width, film.coverage.data() + to);
  }
}

}  // namespace bihive
