#include "bihive/geometry/cell.h"

#include <algorithm>

namespace bihive {

// Rounded products and sums grow with their operands, so the extremes are at corners.
Images::Shifts Images::shifts(const std::array<std::int32_t, 3>& first, const std::array<std::int32_t, 3>& end) const {
  Shifts box;
  for (int corner = 0; corner < 8; ++corner) {
    std::array<std::int32_t, 3> at{};
    for (int k = 0; k < 3; ++k) {
      const auto i = static_cast<std::size_t>(k);
      at[i] = (corner >> k & 1) != 0 ? end[i] - 1 : first[i];
    }
    const Vec3d moved = shift(at);
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = corner == 0 ? moved[axis] : std::min(box.lo[axis], moved[axis]);
      box.hi[axis] = corner == 0 ? moved[axis] : std::max(box.hi[axis], moved[axis]);
    }
  }
  return box;
}

}  // namespace bihive
