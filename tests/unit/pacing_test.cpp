// The fineness of the next picture.
// ctest: asan-long
#include "bihive/viewer/pacing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <vector>

namespace bihive {
namespace {

constexpr double kFrameMs = 16;

std::int64_t pixels_at(int width, int height, int divisor) {
  return std::int64_t{divided(width, divisor)} * divided(height, divisor);
}

// A cost that is known from pictures of two sizes.
PictureCost cost_of(double fixed_ms, double ms_per_pixel) {
  PictureCost cost;
  for (int i = 0; i < 100; ++i)
    for (const std::int64_t pixels : {1000, 100000})
      cost.measured(fixed_ms + ms_per_pixel * static_cast<double>(pixels), pixels);
  return cost;
}

TEST(DivisorFor, the_finest_that_keeps_to_the_budget) {
  // 1000 x 1000 pixels at a microsecond each: a second. 4 and above may take twice the budget.
  const PictureCost cost = cost_of(0, 1e-3);
  EXPECT_EQ(divisor_for(1000, 1000, cost, 1010), 1);
  EXPECT_EQ(divisor_for(1000, 1000, cost, 990), 2);
  EXPECT_EQ(divisor_for(1000, 1000, cost, 115), 3);
  EXPECT_EQ(divisor_for(1000, 1000, cost, 100), 4);
  EXPECT_EQ(divisor_for(1000, 1000, cost, 32), 4);
  EXPECT_EQ(divisor_for(1000, 1000, cost, 30), 6);
  EXPECT_EQ(divisor_for(1000, 1000, cost, 0.1), kCoarsestDivisor);
  EXPECT_EQ(divisor_for(1, 1, cost, 20), 1);
}

TEST(DivisorFor, is_no_coarser_than_what_every_picture_takes_makes_sense) {
  // 60 ms for any picture: 40 x 23 pixels would be no faster than 160 x 90.
  EXPECT_LE(divisor_for(640, 360, cost_of(60, 3e-3), kFrameMs), 4);
  EXPECT_EQ(divisor_for(640, 360, cost_of(60, 1), kFrameMs), kCoarsestDivisor);
}

TEST(Divided, leaves_no_pixel_out) {
  EXPECT_EQ(divided(640, 4), 160);
  EXPECT_EQ(divided(641, 4), 161);
  EXPECT_EQ(divided(1, 16), 1);
}

TEST(FinerStep, four_two_one_and_all_samples) {
  std::vector<PictureStep> steps{{12, 1}};
  while (!(steps.back() == PictureStep{1, 9})) steps.push_back(finer_step(steps.back(), 9));
  EXPECT_EQ(steps, (std::vector<PictureStep>{{12, 1}, {4, 1}, {2, 1}, {1, 1}, {1, 9}}));
  EXPECT_EQ(finer_step({3, 1}, 4), (PictureStep{2, 1}));
  EXPECT_EQ(finer_step({1, 1}, 1), (PictureStep{1, 1}));
  EXPECT_EQ(finer_step({1, 4}, 4), (PictureStep{1, 4}));
}

TEST(ShareOfStep, grows_to_1_and_never_runs_back) {
  for (const int samples : {1, 2, 4, 64})
    for (const int first : {1, 2, 3, 4, 6, 8, 12, 16}) {
      double end = 0;
      PictureStep step{first, 1};
      const PictureStep last{1, samples};
      while (true) {
        const StepShare share = share_of_step(step, samples);
        EXPECT_GE(share.before, end - 1e-12) << first << " " << samples;
        EXPECT_GE(share.own, 0);
        end = share.before + share.own;
        if (step == last) break;
        step = finer_step(step, samples);
      }
      EXPECT_NEAR(end, 1, 1e-12);
    }
}

TEST(PictureCost, follows_what_was_measured) {
  PictureCost cost;
  EXPECT_GT(cost.ms_for(1000), 0) << "a guess before the first";
  cost.measured(20, 10000);
  EXPECT_NEAR(cost.ms_for(10000), 20, 1e-9);
  for (int i = 0; i < 10; ++i) cost.measured(5, 10000);
  EXPECT_NEAR(cost.ms_for(10000), 5, 0.1);
  cost.measured(1000, 0);
  EXPECT_NEAR(cost.ms_for(10000), 5, 0.1) << "no pixels say nothing";
  cost.measured(1000, 10000);
  EXPECT_LT(cost.ms_for(10000), 20) << "one slow picture says little";
  for (int i = 0; i < 30; ++i) cost.measured(50, 10000);
  EXPECT_NEAR(cost.ms_for(10000), 50, 2) << "many say much";
}

TEST(PictureCost, tells_what_every_picture_takes_from_what_a_pixel_takes) {
  const PictureCost cost = cost_of(12, 3e-4);
  EXPECT_NEAR(cost.fixed_ms(), 12, 0.5);
  EXPECT_NEAR(cost.ms_per_pixel(), 3e-4, 2e-5);
}

// A user turns a scene for a while, with pauses, on a machine with other work: every picture takes up to a third more
// or less, each 20th takes three times as long. Returns the divisor at the end, most of the time.
template <class TrueMs>
int divisor_after_turning(int width, int height, double budget_ms, const TrueMs& true_ms) {
  PictureCost cost;
  std::uint64_t random = 1;
  const auto between = [&](double lo, double hi) {
    random = random * 6364136223846793005U + 1442695040888963407U;
    return lo + (hi - lo) * static_cast<double>(random >> 40) / static_cast<double>(1 << 24);
  };
  std::map<int, int> times;
  const auto draw = [&](int divisor, double more_ms) {
    const std::int64_t pixels = pixels_at(width, height, divisor);
    const double slow = between(0, 1) < 0.05 ? 3 : 1;
    cost.measured(true_ms(static_cast<double>(pixels)) * between(0.75, 1.33) * slow + more_ms, pixels);
  };
  for (int frame = 0; frame < 200; ++frame) {
    const int divisor = divisor_for(width, height, cost, budget_ms);
    draw(divisor, frame == 0 ? 40 : 0);  // the driver compiles
    if (frame >= 100) ++times[divisor];
    if (frame % 40 != 20) continue;
    for (PictureStep step{divisor, 1}; step.divisor > 1; draw(step.divisor, 0)) step = finer_step(step, 1);
  }
  return std::max_element(times.begin(), times.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
}

TEST(Pacing, a_slow_start_or_small_pictures_that_are_dear_do_not_keep_it_coarse) {
  // Figures measured with drivers on the CPU: 640 x 360 in 141 ms.
  EXPECT_LE(divisor_after_turning(640, 360, kFrameMs, [](double pixels) { return 1 + 6e-4 * pixels; }), 4);
  EXPECT_LE(divisor_after_turning(640, 360, 25, [](double pixels) { return 1 + 6e-4 * pixels; }), 3);
  // Pictures of a few tiles use one thread of two.
  const auto tiles = [](double pixels) { return 1 + 6e-4 * pixels * (pixels < 8000 ? 1.8 : 1); };
  EXPECT_LE(divisor_after_turning(932, 800, kFrameMs, tiles), 6);
  // A driver in another process, behind a slow connection.
  EXPECT_LE(divisor_after_turning(640, 360, 25, [](double pixels) { return 40 + 1e-3 * pixels; }), 4);
  // If there is time for every pixel, every pixel is drawn.
  EXPECT_EQ(divisor_after_turning(640, 360, kFrameMs, [](double pixels) { return 0.3 + 3e-5 * pixels; }), 1);
  // And slow pictures stay coarse.
  EXPECT_EQ(divisor_after_turning(640, 360, kFrameMs, [](double pixels) { return 1 + 1 * pixels; }), kCoarsestDivisor);
}

TEST(FrameRate, of_the_last_second_that_moved) {
  FrameRate rate;
  EXPECT_EQ(rate.fps(), 0);
  rate.moved(100);
  EXPECT_EQ(rate.fps(), 0) << "one frame is no rate";
  for (int i = 1; i <= 100; ++i) rate.moved(100 + 20 * i);
  EXPECT_NEAR(rate.fps(), 50, 1e-9);
  // After a pause only frames since the pause count.
  rate.moved(60000);
  EXPECT_EQ(rate.fps(), 0);
  rate.moved(60100);
  EXPECT_NEAR(rate.fps(), 10, 1e-9);
}

}  // namespace
}  // namespace bihive
