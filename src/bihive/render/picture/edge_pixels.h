// Which pixels of a picture get more samples (RenderSettings::adaptive_samples).
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/image/film.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// Differences are measured on the square root of light cut off at 1, which is close to what a screen shows: 1/16 of it
/// is some 16 of 255 steps. The samples of a pixel may differ by less than two neighbouring pixels, because a smooth
/// surface changes from pixel to pixel. docs/pictures.md has the measurement that set both.
constexpr double kSampleContrast = 1.0 / 16;
constexpr double kNeighbourContrast = 1.0 / 8;

/// The range of the samples of one pixel, channel by channel.
class SampleRange {
 public:
  void add(Vec3d light);
  /// Whether a channel's least and largest value differ by more than kSampleContrast.
  bool differs() const;

 private:
  Vec3d least_{1, 1, 1}, most_{0, 0, 0};
};

/// The pixels of a film that lie on an edge. Pixel after pixel is noted, by any threads; then find() looks at them.
class EdgePixels {
 public:
  /// Forgets all pixels.
  void resize(int width_px, int height_px);

  /// The samples of this pixel differ, or not.
  void note(int x, int y, bool samples_differ) { found_[number_of(x, y)] = samples_differ ? 1 : 0; }

  /// A pixel whose samples differ lies on an edge, and so does a pixel that differs from one of its eight neighbours by
  /// more than kNeighbourContrast in a channel or in the coverage.
  void find(const Film& film, int threads);

  /// After find().
  bool at(int x, int y) const { return found_[number_of(x, y)] != 0; }

 private:
  std::size_t number_of(int x, int y) const {
    return static_cast<std::size_t>(y) * std::size_t(width_) + std::size_t(x);
  }

  int width_ = 0, height_ = 0;
  std::vector<std::uint8_t> found_;
};

}  // namespace bihive
