// The periodic cell of a set of spheres, and copies of the set along it.
#pragma once

#include <array>
#include <cstdint>

#include "bihive/math/vec3.h"

namespace bihive {

/// A parallelepiped: a corner and the three edges that begin there, in world units. The edges may be skewed, and their
/// determinant may be negative. An edge of length 0: the set does not repeat along it.
struct Cell {
  Vec3d origin;
  std::array<Vec3d, 3> vectors;
  /// Along which edges distances know images (geometry/lattice.h). Edges, copies and wrapping take the whole cell.
  std::array<bool, 3> periodic{true, true, true};

  friend bool operator==(const Cell& a, const Cell& b) {
    return a.origin == b.origin && a.vectors == b.vectors && a.periodic == b.periodic;
  }
};

/// Copies of a set along the three vectors of its cell: counts[0] x counts[1] x counts[2] of them, each count from 1.
/// Copy 0 is the set itself. The last count runs fastest: copy (i, j, k) has the number (i * counts[1] + j) * counts[2]
/// + k.
struct Images {
  std::array<std::int32_t, 3> counts{1, 1, 1};
  std::array<Vec3d, 3> vectors;  ///< world units

  std::int64_t count() const { return std::int64_t{counts[0]} * counts[1] * counts[2]; }
  std::array<std::int32_t, 3> place(std::int64_t copy) const {
    const std::int64_t rest = copy / counts[2];
    return {static_cast<std::int32_t>(rest / counts[1]), static_cast<std::int32_t>(rest % counts[1]),
            static_cast<std::int32_t>(copy % counts[2])};
  }
  std::int64_t number(const std::array<std::int32_t, 3>& at) const {
    return (std::int64_t{at[0]} * counts[1] + at[1]) * counts[2] + at[2];
  }
  /// The translation of the copy: i * a + j * b + k * c in binary64, the sum from left to right. World units.
  Vec3d shift(const std::array<std::int32_t, 3>& at) const {
    return double(at[0]) * vectors[0] + double(at[1]) * vectors[1] + double(at[2]) * vectors[2];
  }
  Vec3d shift(std::int64_t copy) const { return shift(place(copy)); }

  /// The box of the shifts of copies `first` to before `end` along each vector, at least one copy.
  struct Shifts {
    Vec3d lo, hi;
  };
  Shifts shifts(const std::array<std::int32_t, 3>& first, const std::array<std::int32_t, 3>& end) const;
  Shifts shifts() const { return shifts({0, 0, 0}, counts); }
};

}  // namespace bihive
