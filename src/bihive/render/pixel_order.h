// In which order the pixels of a tile are traced, so that neighbours among rays are neighbours in the picture.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bihive/render/film.h"

namespace bihive {

/// The side of a block, as RayOrder::blocks wants them.
constexpr int kBlockPx = 8;

struct PixelPlace {
  std::uint16_t x, y;
};

/// Blocks of 8 x 8 pixels, row by row; inside a block along a Z curve, so that any 4, 16 or 64 neighbours counted from
/// the first are a square. Blocks that the tile's border cuts come last, so that all others start at a multiple of 64.
inline void order_pixels(const Tile& tile, std::vector<PixelPlace>& pixels) {
  pixels.clear();
  for (const bool whole : {true, false})
    for (int y0 = tile.y0; y0 < tile.y1; y0 += kBlockPx)
      for (int x0 = tile.x0; x0 < tile.x1; x0 += kBlockPx) {
        const int width = std::min(kBlockPx, tile.x1 - x0);
        const int height = std::min(kBlockPx, tile.y1 - y0);
        if ((width == kBlockPx && height == kBlockPx) != whole) continue;
        for (int i = 0; i < kBlockPx * kBlockPx; ++i) {
          // The odd bits of i are y, the even ones x.
          const int x = (i & 1) | (i >> 1 & 2) | (i >> 2 & 4);
          const int y = (i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4);
          if (x < width && y < height)
            pixels.push_back({static_cast<std::uint16_t>(x0 + x), static_cast<std::uint16_t>(y0 + y)});
        }
      }
}

}  // namespace bihive
