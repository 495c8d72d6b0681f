// An axis-aligned box in binary32, closed on all sides.
#pragma once

#include <algorithm>
#include <limits>

#include "bihive/math/vec3.h"

namespace bihive {

struct Aabb {
  static constexpr float kNone = std::numeric_limits<float>::infinity();
  Vec3f lo{kNone, kNone, kNone};  ///< the empty box until something is added
  Vec3f hi{-kNone, -kNone, -kNone};

  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  void add(const Aabb& other) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], other.lo[axis]);
      hi[axis] = std::max(hi[axis], other.hi[axis]);
    }
  }
};

}  // namespace bihive
