// Soft shadows: points of lights with a radius, the targets of shadow rays.
//
// The points are the same for all shading points, so neighbouring pixels trace neighbouring rays and the picture has no
// noise. The samples of a pixel use different points, so that together they cover more of them.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "bihive/math/vec3.h"
#include "bihive/scene/faint_level.h"

namespace bihive {

/// Samples beyond this many reuse the first points.
constexpr int kMostPointSets = 16;

/// Points of the ball of radius 1 around 0: sample i of every pixel takes set i % count(). Seen from any side they fill
/// the disc evenly, as a bright ball does.
class LightPointSets {
 public:
  /// `points` 1 to kMostLightPoints (settings/picture_settings.h), `samples_per_pixel` at least 1.
  LightPointSets(int points, int samples_per_pixel);

  int count() const { return static_cast<int>(sets_.size()) / kFaintLevels; }
  /// used_at_level() points.
  const std::vector<Vec3d>& of_sample(std::int64_t sample, int level = 0) const {
    return sets_[static_cast<std::size_t>(level * count() + sample % count())];
  }

 private:
  std::vector<std::vector<Vec3d>> sets_;  // level after level
};

}  // namespace bihive
