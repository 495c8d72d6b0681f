// An axis-aligned box in binary32, closed on all sides.
#pragma once

#include <algorithm>

#include "bihive/math/infinity.h"
#include "bihive/math/vec3.h"

namespace bihive {

struct Aabb {
  Vec3f lo{kInfiniteFloat, kInfiniteFloat, kInfiniteFloat};  ///< the empty box until something is added
  Vec3f hi{-kInfiniteFloat, -kInfiniteFloat, -kInfiniteFloat};

  bool empty() const { return !(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z); }
  void add(const Aabb& other) {
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], other.lo[axis]);
      hi[axis] = std::max(hi[axis], other.hi[axis]);
    }
  }
};

}  // namespace bihive
