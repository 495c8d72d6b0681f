// The colours of the tree's drawing (tree_picture.h). Display values.
#pragma once

#include <cstdint>

#include "bihive/math/vec3.h"

namespace bihive::tree_colours {

constexpr Vec3d kGap{0.10, 0.80, 0.25};
constexpr Vec3d kOverlap{0.95, 0.15, 0.10};
constexpr Vec3d kClip{1.00, 0.85, 0.10};
constexpr Vec3d kEmpty{1.00, 0.20, 0.85};   // the part that a one-sided node cuts off
constexpr Vec3d kForced{1.00, 0.50, 0.05};  // a leaf in which no split made progress
constexpr Vec3d kPaper{0.07, 0.07, 0.09};   // behind the bars

/// White at depth 1, blue half way, violet at the deepest.
inline Vec3d of_depth(std::int64_t depth, std::int64_t deepest) {
  constexpr Vec3d kTop{0.95, 0.97, 1.00};
  constexpr Vec3d kMiddle{0.25, 0.62, 1.00};
  constexpr Vec3d kBottom{0.55, 0.30, 0.95};
  const double share = deepest > 1 ? static_cast<double>(depth - 1) / static_cast<double>(deepest - 1) : 0;
  if (share < 0.5) return kTop + (kMiddle - kTop) * (2 * share);
  return kMiddle + (kBottom - kMiddle) * (2 * share - 1);
}

}  // namespace bihive::tree_colours
