// The resolution of the next picture: coarse enough for the budget while something moves, increasing at rest.
#pragma once

#include <deque>

#include "bihive/viewer/picture_cost.h"

namespace bihive {

/// A step towards the final picture: width and height divided by `divisor`, and `samples` per pixel.
struct PictureStep {
  int divisor = 1;
  int samples = 1;

  friend bool operator==(PictureStep a, PictureStep b) { return a.divisor == b.divisor && a.samples == b.samples; }
};

constexpr int kCoarsestDivisor = 16;

/// Pixels of a side divided by the divisor, rounded up, so that the whole picture is covered.
inline int divided(int side_px, int divisor) {
  return (side_px + divisor - 1) / divisor;
}

/// The divisor for a picture of one sample per pixel while something moves: the smallest of 1, 2, 3, 4, 6, 8, 12, 16
/// that keeps to the budget. Above 3 the picture may take twice the budget, and always twice the time of the smallest
/// picture, because coarser pictures would look worse and gain little. 16 if none keeps to the budget.
int divisor_for(int width_px, int height_px, const PictureCost& cost, double budget_ms);

/// The step after another at rest: half the divisor (to 4, 2, 1), then all samples. After the last step it returns that
/// step.
PictureStep finer_step(PictureStep step, int samples_per_pixel);

/// For a progress bar that never goes back: the share of all pixels and samples up to the final picture that was done
/// before a step, plus the step's own share, which may be 0. Both 0 to 1.
struct StepShare {
  double before, own;
};
StepShare share_of_step(PictureStep step, int samples_per_pixel);

/// Frames per second over the last second of moving frames.
class FrameRate {
 public:
  /// `now_ms`: the end of the frame on any steady clock.
  void moved(double now_ms);
  double fps() const;  ///< 0: fewer than two frames yet

 private:
  std::deque<double> times_ms_;
};

}  // namespace bihive
