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

}  // namespace bihive
