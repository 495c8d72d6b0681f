// Spheres along the Z-curve of their centres [Morton1966].
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "bihive/geometry/sphere_set.h"
#include "bihive/math/spread_bits.h"

namespace bihive::workbench {

struct MortonSphere {
  std::uint64_t code;  ///< 21 bits for each axis
  std::uint32_t id;
};

/// By code, then id. Cells are cubes: 2^21 along the longest side of the centres' box.
inline std::vector<MortonSphere> along_the_z_curve(const SphereSet& spheres) {
  Vec3d lo{1, 1, 1}, hi{-1, -1, -1};
  for (std::int64_t id = 0; id < spheres.size(); ++id)
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], spheres.stored_centre(id)[axis]);
      hi[axis] = std::max(hi[axis], spheres.stored_centre(id)[axis]);
    }
  const double side = std::max({hi.x - lo.x, hi.y - lo.y, hi.z - lo.z});
  constexpr double kCells = 1 << 21;
  std::vector<MortonSphere> list;
  list.reserve(static_cast<std::size_t>(spheres.size()));
  for (std::int64_t id = 0; id < spheres.size(); ++id) {
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double share = side > 0 ? (spheres.stored_centre(id)[axis] - lo[axis]) / side : 0;
      const auto cell = static_cast<std::uint64_t>(std::min(share * kCells, kCells - 1));
      code |= spread_bits(cell) << axis;
    }
    list.push_back({code, static_cast<std::uint32_t>(id)});
  }
  std::sort(list.begin(), list.end(), [](const MortonSphere& a, const MortonSphere& b) {
    return a.code != b.code ? a.code < b.code : a.id < b.id;
  });
  return list;
}

}  // namespace bihive::workbench
