// How fine the next picture may be: coarse enough for the budget while something moves, finer and finer at rest.
#pragma once

#include <deque>

#include "bihive/viewer/picture_cost.h"

namespace bihive {

/// One picture on the way to the final one: width and height divided by `divisor`, so many samples a pixel.
struct PictureStep {
  int divisor = 1;
  int samples = 1;

  friend bool operator==(PictureStep a, PictureStep b) { return a.divisor == b.divisor && a.samples == b.samples; }
};

constexpr int kCoarsestDivisor = 16;

/// Pixels of a side divided by the divisor: rounded up, so that nothing is missing.
inline int divided(int side_px, int divisor) {
  return (side_px + divisor - 1) / divisor;
}

/// How coarse a picture of one sample a pixel has to be while something moves: the smallest of the divisors 1, 2, 3, 4,
/// 6, 8, 12, 16 that keeps to the budget. Above 3 it may take twice the budget, and always twice what the smallest
/// picture takes: coarser ones would be seen more than gained. The last where none is small enough.
int divisor_for(int width_px, int height_px, const PictureCost& cost, double budget_ms);

/// The step after one at rest: half the divisor (to 4, 2, 1), then all samples. The last one is followed by itself.
PictureStep finer_step(PictureStep step, int samples_per_pixel);

/// For a bar of progress that never runs back: of all pixels and samples up to the final picture the share that was
/// done before a step, and the step's own, which may be 0. Both 0 to 1.
struct StepShare {
  double before, own;
};
StepShare share_of_step(PictureStep step, int samples_per_pixel);

/// Frames a second over the last second of frames that moved.
class FrameRate {
 public:
  /// `now_ms`: on any steady clock, when the frame was done.
  void moved(double now_ms);
  double fps() const;  ///< 0: fewer than two frames yet

 private:
  std::deque<double> times_ms_;
};

}  // namespace bihive
