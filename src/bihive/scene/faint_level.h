// Faint surfaces use fewer directions and light points: when rays pass straight through spheres, a pixel sees many
// layers, and the error of a layer counts as little as the layer.
#pragma once

#include <algorithm>

namespace bihive {

/// Levels 0 to kFaintLevels - 1. Each level traces half as many rays as the previous one.
constexpr int kFaintLevels = 6;

/// No level uses fewer than this, unless the picture does. Two directions are opposite, so that one of them is in front
/// of every surface.
constexpr int kFewestDirections = 2;
constexpr int kFewestLightPoints = 1;

/// The level of a surface that contributes at most this share of its pixel's light: 0 around 1, 1 around 1/2, and so
/// on, with the limits between at their geometric means. For a given number of rays the error of the sum is least where
/// a layer's rays are proportional to its share.
inline int faint_level(double share) {
  int level = 0;
  for (double limit = 0.70710678118654752; level < kFaintLevels - 1 && share <= limit; limit = limit / 2) ++level;
  return level;
}

/// How many of `count` directions or points a surface of that level uses; `fewest`: kFewestDirections or
/// kFewestLightPoints.
inline int used_at_level(int count, int level, int fewest) {
  return std::min(count, std::max(fewest, count >> level));
}

}  // namespace bihive
