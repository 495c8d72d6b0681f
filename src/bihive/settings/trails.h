// The paths of spheres through the frames before.
#pragma once

#include <limits>
#include <string>

namespace bihive {

constexpr int kLongestTrail = 100'000;  ///< frames

struct Trails {
  int frames = 0;      ///< before the one that is drawn, up to kLongestTrail; 0: no trails
  std::string select;  ///< a selection (docs/selections.md); empty: all spheres have trails
  double radius = std::numeric_limits<double>::infinity();  ///< world units, above 0; inf: a fifth of the sphere's

  bool any() const { return frames > 0; }
};

}  // namespace bihive
