// How long a picture will take, learnt from those before: a part that every picture takes, however small, and a part
// for each pixel. Drivers that work far away (a browser's) or on the CPU take so long for the first that without it
// coarse pictures would make every pixel look dear, and the next one coarser still.
#pragma once

#include <cstdint>

namespace bihive {

/// A Kalman filter of two numbers whose noise is a share of what is measured. A slow picture once in a while moves it
/// little; what has really changed it follows within a few pictures.
class PictureCost {
 public:
  /// A picture of one sample a pixel took so long. Nothing to learn where there are no pixels.
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
