// How fine the next picture may be.
#include "bihive/viewer/pacing.h"

#include <gtest/gtest.h>

#include <vector>

namespace bihive {
namespace {

TEST(DivisorFor, the_finest_that_keeps_to_the_budget) {
  // 1000 x 1000 pixels at a microsecond each: a second.
  EXPECT_EQ(divisor_for(1000, 1000, 1e-3, 1000), 1);
  EXPECT_EQ(divisor_for(1000, 1000, 1e-3, 999), 2);
  EXPECT_EQ(divisor_for(1000, 1000, 1e-3, 100), 4);
  EXPECT_EQ(divisor_for(1000, 1000, 1e-3, 20), 8);
  EXPECT_EQ(divisor_for(1000, 1000, 1, 1), kCoarsestDivisor);
  EXPECT_EQ(divisor_for(1, 1, 1e-3, 20), 1);
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

TEST(PixelCost, follows_what_was_measured) {
  PixelCost cost;
  EXPECT_GT(cost.ms_per_pixel(), 0) << "a guess before the first";
  cost.measured(20, 10000);
  EXPECT_DOUBLE_EQ(cost.ms_per_pixel(), 2e-3);
  for (int i = 0; i < 20; ++i) cost.measured(10, 10000);
  EXPECT_NEAR(cost.ms_per_pixel(), 1e-3, 1e-8);
  cost.measured(1000, 0);
  EXPECT_NEAR(cost.ms_per_pixel(), 1e-3, 1e-8) << "no pixels say nothing";
}

TEST(FrameRate, of_the_last_second_that_moved) {
  FrameRate rate;
  EXPECT_EQ(rate.fps(), 0);
  rate.moved(100);
  EXPECT_EQ(rate.fps(), 0) << "one frame is no rate";
  for (int i = 1; i <= 100; ++i) rate.moved(100 + 20 * i);
  EXPECT_NEAR(rate.fps(), 50, 1e-9);
  // After a pause only what came since.
  rate.moved(60000);
  EXPECT_EQ(rate.fps(), 0);
  rate.moved(60100);
  EXPECT_NEAR(rate.fps(), 10, 1e-9);
}

}  // namespace
}  // namespace bihive
