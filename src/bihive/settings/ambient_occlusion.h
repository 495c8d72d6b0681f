// Ambient occlusion as a setting: surfaces that see little of their surroundings are darker.
#pragma once

#include <limits>

namespace bihive {

constexpr int kMostAmbientDirections = 4096;

struct AmbientOcclusion {
  double distance = std::numeric_limits<double>::infinity();  ///< world units, > 0: farther surfaces do not darken
  int directions = 64;  ///< per sample, on the whole sphere; 1 to kMostAmbientDirections
};

}  // namespace bihive
