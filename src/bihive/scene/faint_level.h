// Faint surfaces use fewer directions and light points: when rays pass straight through spheres, a pixel sees many
// layers, and the error of a layer counts as little as the layer.
#pragma once

#include <algorithm>

namespace bihive {

/// Levels 0 to kFaintLevels - 1. Each level traces half as many rays as the previous one.
constexpr int kFaintLevels = 5;

/// No level traces fewer rays than this, unless the picture does.
constexpr int kFewestOfFaint = 8;

/// The level of a surface that contributes at most this share of its pixel's light: 0 above 1/2, 1 above 1/4, and so
/// on.
inline int faint_level(double share) {
  int level = 0;
  for (double limit = 0.5; level < kFaintLevels - 1 && share <= limit; limit = limit / 2) ++level;
  return level;
}

/// How many of `count` directions or points a surface of that level uses.
inline int asked_at_level(int count, int level) {
  return std::min(count, std::max(kFewestOfFaint, count >> level));
}

}  // namespace bihive
