// The box that holds most of a set's centres along each axis: for sets with a few spheres far away.
#pragma once

#include <array>

#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// Bounds of centres, in stored units.
struct CentralBox {
  std::array<float, 3> lo{}, hi{};

  bool holds(const SphereSet& spheres, std::size_t i) const {
    return lo[0] <= spheres.x()[i] && spheres.x()[i] <= hi[0] && lo[1] <= spheres.y()[i] && spheres.y()[i] <= hi[1] &&
           lo[2] <= spheres.z()[i] && spheres.z()[i] <= hi[2];
  }
};

/// Along each axis, the least and the greatest coordinate after floor((n - n share) / 2) of the n stored centres are
/// left out at either end. `share`: above 0, at most 1. The set is not empty. Images do not count.
CentralBox central_box(const SphereSet& spheres, double share);

}  // namespace bihive
