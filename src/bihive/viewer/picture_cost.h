// Predicts the time of a picture from previous ones: a constant per picture, and a time per pixel. The constant is
// large for drivers that work in another process (a browser's) or on the CPU. Without it coarse pictures would make
// every pixel look expensive, and the next picture would be coarser still.
#pragma once

#include <cstdint>

namespace bihive {

/// A Kalman filter of two numbers with noise relative to the measured value. A single slow picture moves it little; it
/// follows a lasting change within a few pictures.
class PictureCost {
 public:
  /// Records that a picture of one sample per pixel took this long. Learns nothing from a picture without pixels.
  void measured(double ms, std::int64_t pixels);

  double ms_for(std::int64_t pixels) const { return fixed_ms_ + ms_per_pixel_ * static_cast<double>(pixels); }
  double fixed_ms() const { return fixed_ms_; }
  double ms_per_pixel() const { return ms_per_pixel_; }

 private:
  static constexpr double kFirstGuess = 5e-4;

  double fixed_ms_ = 0, ms_per_pixel_ = kFirstGuess;
  bool guess_ = true;
  double fixed_variance_ = 0, pixel_variance_ = 0, covariance_ = 0;
};

}  // namespace bihive
