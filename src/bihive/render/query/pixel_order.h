// The order in which the pixels of a tile are traced: neighbouring rays belong to neighbouring pixels.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bihive/image/film.h"

namespace bihive {

/// The side of a block for RayOrder::blocks.
constexpr int kBlockPx = 8;

struct PixelPlace {
  std::uint16_t x, y;
};

/// The place of a pixel in its block: the odd bits of its number are y, the even ones x.
constexpr std::array<PixelPlace, 64> kZCurve = [] {
  std::array<PixelPlace, 64> places{};
  for (unsigned i = 0; i < places.size(); ++i)
    places[i] = {static_cast<std::uint16_t>((i & 1) | (i >> 1 & 2) | (i >> 2 & 4)),
                 static_cast<std::uint16_t>((i >> 1 & 1) | (i >> 2 & 2) | (i >> 3 & 4))};
  return places;
}();

/// Whether 64 neighbours in the order below, from a multiple of 64 on, are a whole block.
inline bool is_whole_block(const PixelPlace* pixels) {
  constexpr PixelPlace last = kZCurve.back();
  return pixels[63].x == pixels[0].x + last.x && pixels[63].y == pixels[0].y + last.y && pixels[1].y == pixels[0].y &&
         pixels[2].x == pixels[0].x;
}

/// Blocks of 8 x 8 pixels, row by row. Inside a block the order is a Z curve, so that any 4, 16 or 64 neighbours
/// counted from the first are a square. Blocks that the tile's border cuts come last, so that all others start at a
/// multiple of 64.
inline void order_pixels(const Tile& tile, std::vector<PixelPlace>& pixels) {
  // There are some more places than pixels, for vectors that read past the last.
  constexpr std::size_t kPadding = 16;
  const std::size_t count = static_cast<std::size_t>(tile.x1 - tile.x0) * static_cast<std::size_t>(tile.y1 - tile.y0);
  pixels.resize(count + kPadding);
  PixelPlace* next = pixels.data();
  for (const bool whole : {true, false})
    for (int y0 = tile.y0; y0 < tile.y1; y0 += kBlockPx)
      for (int x0 = tile.x0; x0 < tile.x1; x0 += kBlockPx) {
        const int width = std::min(kBlockPx, tile.x1 - x0);
        const int height = std::min(kBlockPx, tile.y1 - y0);
        if ((width == kBlockPx && height == kBlockPx) != whole) continue;
        for (const PixelPlace& step : kZCurve)
          if (whole || (step.x < width && step.y < height))
            *next++ = {static_cast<std::uint16_t>(x0 + step.x), static_cast<std::uint16_t>(y0 + step.y)};
      }
}

}  // namespace bihive
