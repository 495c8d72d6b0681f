// The tiles of a picture that several processes share.
#include "bihive/render/picture_tiles.h"

#include <gtest/gtest.h>

#include <vector>

namespace bihive {
namespace {

RenderSettings sized(int width, int height) {
  RenderSettings settings;
  settings.width_px = width;
  settings.height_px = height;
  return settings;
}

// Each pixel of the picture lies in one tile, and rows of tiles are what they say.
void expect_cover(const RenderSettings& settings, int who_draw) {
  const PictureTiles tiles(settings, who_draw);
  const Tile all = drawn_pixels(settings);
  std::vector<int> times(static_cast<std::size_t>(all.width()) * std::size_t(all.height()), 0);
  for (std::int64_t number = 0; number < tiles.count(); ++number) {
    const Tile tile = tiles.pixels(number);
    const Tile row = tiles.pixels_of_row(static_cast<int>(number / tiles.columns()));
    EXPECT_EQ(tile.y0, row.y0);
    EXPECT_EQ(tile.y1, row.y1);
    EXPECT_LT(tile.x0, tile.x1);
    for (int y = tile.y0; y < tile.y1; ++y)
      for (int x = tile.x0; x < tile.x1; ++x)
        ++times[static_cast<std::size_t>(y - all.y0) * std::size_t(all.width()) + std::size_t(x - all.x0)];
  }
  for (const int one : times) ASSERT_EQ(one, 1);
}

TEST(PictureTiles, cover_each_pixel_once) {
  for (const int who_draw : {1, 2, 3, 7, 64, 5000})
    for (const auto& [width, height] : {std::pair{1, 1}, {640, 480}, {65, 15}, {63, 1000}, {1000, 17}}) {
      RenderSettings settings = sized(width, height);
      expect_cover(settings, who_draw);
      if (width > 20 && height > 12) {
        settings.crop = Tile{3, 5, width - 7, height - 2};
        expect_cover(settings, who_draw);
      }
    }
}

TEST(PictureTiles, there_are_some_for_each_who_draws) {
  const RenderSettings settings = sized(1920, 1080);
  for (const int who_draw : {1, 2, 8, 64}) EXPECT_GE(PictureTiles(settings, who_draw).count(), 8 * who_draw * 0.8);
  // A few who draw get whole rows, which the file takes as they are.
  EXPECT_EQ(PictureTiles(settings, 2).columns(), 1);
  EXPECT_GT(PictureTiles(settings, 64).columns(), 4);
}

}  // namespace
}  // namespace bihive
