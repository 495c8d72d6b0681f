// Linear RGB radiance of a picture, and the tiles in which it is made.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/math/vec3.h"

namespace bihive {

/// Row by row from the top. `coverage`: of each pixel the share of its samples that hit something, 0 to 1. Then
/// `radiance` is the mean of these samples alone, 0 where there are none. Empty: `radiance` is the mean of all samples.
struct Film {
  int width = 0;
  int height = 0;
  std::vector<Vec3f> radiance;
  std::vector<float> coverage;

  Film() = default;
  Film(int width_px, int height_px)
      : width(width_px), height(height_px), radiance(static_cast<std::size_t>(width_px) * std::size_t(height_px)) {}

  /// Changes the size; contents are undefined.
  void resize(int width_px, int height_px, bool with_coverage = false) {
    width = width_px;
    height = height_px;
    radiance.resize(static_cast<std::size_t>(width_px) * std::size_t(height_px));
    coverage.resize(with_coverage ? radiance.size() : 0);
  }

  std::size_t number_of(int x, int y) const {
    return static_cast<std::size_t>(y) * std::size_t(width) + std::size_t(x);
  }
  Vec3f& at(int x, int y) { return radiance[number_of(x, y)]; }
  Vec3f at(int x, int y) const { return radiance[number_of(x, y)]; }
};

/// Pixels with x0 <= x < x1 and y0 <= y < y1.
struct Tile {
  int x0, y0, x1, y1;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
};

/// The tiles of a picture or of a part of it, row by row; those at the right and lower border may be smaller.
std::vector<Tile> tiles_of(int width_px, int height_px, int tile_px);
std::vector<Tile> tiles_of(const Tile& part, int tile_px);

/// These pixels of a film as a film of their own. They must be inside it.
Film part_of(const Film& film, const Tile& part);

/// Copies a film into another one, which is large enough and has coverage if the first has, with its left upper pixel
/// at (x, y).
void paste(const Film& part, int x, int y, Film& film);

}  // namespace bihive
