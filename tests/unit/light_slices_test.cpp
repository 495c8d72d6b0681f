// The slices of a sample's light have every direction and every point once.
// ctest: asan-long
#include "bihive/gl/light_slices.h"

#include <gtest/gtest.h>

namespace bihive {
namespace {

// How often is each direction asked, and each point of each light?
void expect_all_once(const LightWork& work, int most_rays) {
  SCOPED_TRACE(std::to_string(work.directions) + " directions, " + std::to_string(work.lights) + " x " +
               std::to_string(work.points) + " points, " + std::to_string(most_rays) + " rays");
  std::vector<int> directions(std::size_t(work.directions), 0);
  std::vector<int> points(std::size_t(work.lights * work.points), 0);
  for (const LightSlice& slice : light_slices(work, most_rays)) {
    for (int k = slice.direction_begin; k < slice.direction_end; ++k) ++directions[std::size_t(k)];
    for (int light = slice.light_begin; light < slice.light_end; ++light)
      for (int k = slice.point_begin; k < slice.point_end; ++k) ++points[std::size_t(light * work.points + k)];
    const int rays = (slice.direction_end - slice.direction_begin) / 2 +
                     (slice.light_end - slice.light_begin) * (slice.point_end - slice.point_begin);
    if (!work.whole_lights) {
      EXPECT_LE(rays, most_rays);
    } else if (slice.light_begin < slice.light_end) {
      EXPECT_EQ(slice.point_end - slice.point_begin, work.points);
    }
  }
  for (const int asked : directions) EXPECT_EQ(asked, 1);
  for (const int asked : points) EXPECT_EQ(asked, 1);
}

TEST(LightSlices, ask_everything_once) {
  for (const int directions : {0, 1, 64, 4096})
    for (const int lights : {0, 1, 3})
      for (const int points : {1, 8, 1024})
        for (const int most_rays : {1, 12, 64})
          for (const bool whole_lights : {false, true})
            expect_all_once({directions, lights, points, whole_lights}, most_rays);
}

TEST(LightSlices, little_light_comes_in_one_slice) {
  EXPECT_EQ(light_slices({0, 0, 1, false}, kRaysOfSlice).size(), 1u);
  EXPECT_EQ(light_slices({64, 3, 8, false}, kRaysOfSlice).size(), 1u);
  EXPECT_GT(light_slices({64, 3, 8, false}, kRaysOfLayerSlice).size(), 1u);
}

}  // namespace
}  // namespace bihive
