// Ambient occlusion: the visible fraction of the surroundings of a shading point. It scales the ambient term.
//
// The directions are the same for all shading points, so neighbouring pixels trace parallel rays and the picture has no
// noise. The samples of a pixel use different sets of directions, so that together they cover more of them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "bihive/math/vec3.h"
#include "bihive/scene/faint_level.h"
#include "bihive/settings/ambient_occlusion.h"

namespace bihive {

/// Samples beyond this many reuse the first sets.
constexpr int kMostDirectionSets = 16;

/// The sets of directions of a picture: sample i of every pixel takes set i % count().
class DirectionSets {
 public:
  /// `directions` and `samples_per_pixel` at least 1.
  DirectionSets(int directions, int samples_per_pixel);

  int count() const { return static_cast<int>(sets_.size()) / kFaintLevels; }
  /// Directions of length 1 up to binary32 rounding, spread evenly over the sphere; used_at_level() of them.
  const std::vector<Vec3f>& of_sample(std::int64_t sample, int level = 0) const {
    return sets_[static_cast<std::size_t>(level * count() + sample % count())];
  }

 private:
  std::vector<std::vector<Vec3f>> sets_;  // level after level
};

/// Ambient occlusion rays of a picture, prepared once for a renderer.
struct AmbientRays {
  double distance;
  DirectionSets sets;

  AmbientRays(const AmbientOcclusion& occlusion, int samples_per_pixel)
      : distance(occlusion.distance), sets(occlusion.directions, samples_per_pixel) {}
};

}  // namespace bihive
