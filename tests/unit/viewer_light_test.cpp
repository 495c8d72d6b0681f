// The light of the viewer's pictures while something moves, beside that of the picture at rest.
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "bihive/viewer/viewer.h"

namespace bihive {
namespace {

constexpr int kWidthPx = 320, kHeightPx = 180;
constexpr double kAnyBudgetMs = 1e6;  // every picture has the whole size
constexpr int kBlockOfEyePx = 12;     // what eyes take for one brightness

double luminance(const Image& image, int x, int y) {
  const std::size_t at = 3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) + x);
  return 0.2126 * image.rgb[at] + 0.7152 * image.rgb[at + 1] + 0.0722 * image.rgb[at + 2];
}

// Of 255.
struct Jump {
  double mean = 0;       // of the whole picture
  double of_pixels = 0;  // mean absolute difference
  double of_blocks = 0;  // the same of blocks
};

Jump jump_between(const Image& moving, const Image& rest) {
  Jump jump;
  int blocks = 0;
  for (int y0 = 0; y0 + kBlockOfEyePx <= rest.height; y0 += kBlockOfEyePx)
    for (int x0 = 0; x0 + kBlockOfEyePx <= rest.width; x0 += kBlockOfEyePx) {
      double sum = 0;
      for (int y = y0; y < y0 + kBlockOfEyePx; ++y)
        for (int x = x0; x < x0 + kBlockOfEyePx; ++x) {
          const double difference = luminance(rest, x, y) - luminance(moving, x, y);
          sum += difference;
          jump.of_pixels += std::abs(difference);
        }
      jump.mean += sum;
      jump.of_blocks += std::abs(sum);
      ++blocks;
    }
  const double pixels = double{kBlockOfEyePx} * kBlockOfEyePx * blocks;
  jump.mean /= pixels;
  jump.of_pixels /= pixels;
  jump.of_blocks /= pixels;
  return jump;
}

// Moves, and stops.
Jump jump_at_the_end(Viewer& viewer) {
  viewer.orbit(40, 12);
  const Result<FrameReport> report = viewer.frame(kAnyBudgetMs);
  EXPECT_TRUE(report);
  EXPECT_TRUE(report->drawn);
  EXPECT_FALSE(report->settled);
  EXPECT_EQ(report->divisor, 1);
  const Image moving = viewer.image();
  for (int i = 0; i < 1000; ++i)
    if (viewer.frame(kAnyBudgetMs)->settled) break;
  return jump_between(moving, viewer.image());
}

TEST(ViewerLight, is_steady_where_a_move_ends) {
  Viewer viewer;
  viewer.resize(kWidthPx, kHeightPx);
  ASSERT_TRUE(viewer.load_built_in("demo"));
  const Jump jump = jump_at_the_end(viewer);
  RecordProperty("mean", std::to_string(jump.mean));
  RecordProperty("of_pixels", std::to_string(jump.of_pixels));
  RecordProperty("of_blocks", std::to_string(jump.of_blocks));
  EXPECT_LT(std::abs(jump.mean), 0.5);
  EXPECT_LT(jump.of_blocks, 1);
  EXPECT_LT(jump.of_pixels, 8);
}

}  // namespace
}  // namespace bihive
