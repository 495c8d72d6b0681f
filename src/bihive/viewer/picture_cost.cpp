#include "bihive/viewer/picture_cost.h"

#include <algorithm>

namespace bihive {
namespace {

// Relative noise: the error of a measurement, the drift of the true value between pictures, and the share of the first
// picture's time that may be constant.
constexpr double kNoise = 0.25;
constexpr double kDrift = 0.2;
constexpr double kFixedDrift = 0.05;
constexpr double kFirstFixed = 0.3;
// A measurement of more than this many times the expected value counts as this many times.
constexpr double kMostSurprise = 4;

double square(double x) {
  return x * x;
}

}  // namespace

void PictureCost::measured(double ms, std::int64_t pixels) {
  if (pixels < 1 || !(ms > 0)) return;
  const auto x = static_cast<double>(pixels);
  if (guess_) {
    guess_ = false;
    ms_per_pixel_ = ms / x;
    fixed_variance_ = square(kFirstFixed * ms);
    pixel_variance_ = square(ms_per_pixel_);
    return;
  }

  // Predict: the values may have changed since the last picture.
  const double expected = ms_for(pixels);
  fixed_variance_ += square(kDrift * fixed_ms_ + kFixedDrift * expected);
  pixel_variance_ += square(kDrift * ms_per_pixel_);

  // Divide the difference between the two values in proportion to their uncertainty.
  const double believed = std::min(ms, kMostSurprise * expected);
  const double with_fixed = fixed_variance_ + x * covariance_;
  const double with_pixel = covariance_ + x * pixel_variance_;
  const double variance = with_fixed + x * with_pixel + square(kNoise * std::max(believed, expected));
  const double gain_fixed = with_fixed / variance, gain_pixel = with_pixel / variance;
  fixed_ms_ = std::max(0.0, fixed_ms_ + gain_fixed * (believed - expected));
  ms_per_pixel_ = std::max(1e-3 * believed / x, ms_per_pixel_ + gain_pixel * (believed - expected));
  fixed_variance_ -= gain_fixed * with_fixed;
  covariance_ -= gain_fixed * with_pixel;
  pixel_variance_ -= gain_pixel * with_pixel;
}

}  // namespace bihive
