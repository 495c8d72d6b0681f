// Which balls are near a ball: grids of cells, one for each octave of radii.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/measure/balls.h"

namespace bihive::measure {

class NeighbourGrid {
 public:
  /// Nothing if the balls are distributed so unevenly that many would share a cell; a tree is better then.
  static std::optional<NeighbourGrid> of(const Balls& balls);

  /// Appends every ball that shares a point with ball i, itself too, and some others that nearly do. The order is
  /// fixed.
  void find(const Balls& balls, std::int64_t i, std::vector<std::int64_t>& found) const;

  /// All balls, so that those near each other are near in the list.
  const std::vector<std::int64_t>& order() const { return order_; }

 private:
  struct Ball {
    Vec3d centre;
    double radius;
  };
  // Balls whose radii have the same binary exponent. Cell (x, y, z) has the balls begin[n] to before begin[n + 1] with
  // n = (z cells[1] + y) cells[0] + x.
  struct Level {
    double largest = 0;
    Vec3d lo;
    double cells_per_unit = 0;
    std::array<std::int64_t, 3> cells{};
    std::vector<std::uint32_t> begin;
    std::int64_t first = 0;  // in balls_ and order_

    std::int64_t cell_of(double x, int axis) const;
  };

  double rounding_ = 0;        // of differences of centres
  std::vector<Level> levels_;  // from large to small radii
  std::vector<Ball> balls_;    // level by level, cell by cell
  std::vector<std::int64_t> order_;
};

}  // namespace bihive::measure
