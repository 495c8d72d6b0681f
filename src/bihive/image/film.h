// Linear RGB radiance of a picture, and the tiles in which it is made.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/math/vec3.h"

namespace bihive {

/// Row by row from the top.
struct Film {
  int width = 0;
  int height = 0;
  std::vector<Vec3f> radiance;

  Film() = default;
  Film(int width_px, int height_px)
      : width(width_px), height(height_px), radiance(static_cast<std::size_t>(width_px) * std::size_t(height_px)) {}

  /// Changes the size; contents are undefined.
  void resize(int width_px, int height_px) {
    width = width_px;
    height = height_px;
    radiance.resize(static_cast<std::size_t>(width_px) * std::size_t(height_px));
  }

  Vec3f& at(int x, int y) { return radiance[static_cast<std::size_t>(y) * std::size_t(width) + std::size_t(x)]; }
  Vec3f at(int x, int y) const { return radiance[static_cast<std::size_t>(y) * std::size_t(width) + std::size_t(x)]; }
};

/// Pixels with x0 <= x < x1 and y0 <= y < y1.
struct Tile {
  int x0, y0, x1, y1;
};

/// The tiles of a picture, row by row; those at the right and lower border may be smaller.
std::vector<Tile> tiles_of(int width_px, int height_px, int tile_px);

}  // namespace bihive
