// The number of draws in a pass, by the time that they take.
// ctest: asan-long
#include "bihive/gl/tile_walk.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace bihive {
namespace {

constexpr int kPixelsAcross = 640, kPixelsDown = 360;  // 20 x 12 blocks
constexpr double kWantedMs = 6;

struct Pass {
  int draws = 0;
  double ms = 0, longest_ms = 0;
};

// The third of three passes on a processor with this time for a draw, and this much more for each block.
Pass third_pass(double fixed_ms, double block_ms) {
  TileWalk walk;
  Pass pass;
  for (int i = 0; i < 3; ++i) {
    pass = {};
    int pixels = 0;
    for (walk.restart(kPixelsAcross, kPixelsDown); !walk.at_end();) {
      const Tile tile = walk.next(kWantedMs);
      const int area = (tile.x1 - tile.x0) * (tile.y1 - tile.y0);
      pixels += area;
      const double ms = fixed_ms + block_ms * area / (TileWalk::kBlockPx * TileWalk::kBlockPx);
      walk.took(ms);
      ++pass.draws;
      pass.ms += ms;
      pass.longest_ms = std::max(pass.longest_ms, ms);
    }
    EXPECT_EQ(pixels, kPixelsAcross * kPixelsDown) << "every pixel once";
  }
  return pass;
}

TEST(TileWalk, draws_take_about_what_is_wanted) {
  const Pass pass = third_pass(0, 1);
  EXPECT_LE(pass.longest_ms, 4 * kWantedMs);
  EXPECT_GE(pass.ms / pass.draws, 0.5 * kWantedMs);
}

TEST(TileWalk, blocks_that_take_longer_than_wanted_come_a_few_at_a_time) {
  EXPECT_LE(third_pass(0, 20).longest_ms, 40);
}

TEST(TileWalk, a_processor_that_is_far_away_is_asked_less_often) {
  // Each draw waits 8 ms: block by block that would happen 240 times.
  const Pass pass = third_pass(8, 1);
  EXPECT_LE(pass.draws, 80);
  EXPECT_LE(pass.longest_ms, 8 + 3 * kWantedMs);
}

TEST(TileWalk, a_quick_processor_draws_all_at_once) {
  EXPECT_EQ(third_pass(0.05, 0.001).draws, 1);
}

}  // namespace
}  // namespace bihive
