// Faint surfaces use fewer directions and light points: when rays pass straight through spheres, a pixel sees many
// layers, and the error of a layer counts as little as the layer.
#pragma once

#include <algorithm>

namespace bihive {

/// Levels 0 to kFaintLevels - 1. Each level traces half as many rays as the previous one.
constexpr int kFaintLevels = 6;

/// No level uses fewer than this, unless the picture does. Where no direction is in front of a surface it counts as
/// open: one time in 16 with four.
constexpr int kFewestDirections = 4;
constexpr int kFewestLightPoints = 1;

/// The level of a surface that contributes at most this share of its pixel's light: 0 above 1/2, 1 above 1/4, and so
/// on.
inline int faint_level(double share) {
  int level = 0;
  for (double limit = 0.5; level < kFaintLevels - 1 && share <= limit; limit = limit / 2) ++level;
  return level;
}

/// How many of `count` directions or points a surface of that level uses; `fewest`: kFewestDirections or
/// kFewestLightPoints.
inline int used_at_level(int count, int level, int fewest) {
  return std::min(count, std::max(fewest, count >> level));
}

}  // namespace bihive
