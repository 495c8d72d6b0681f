#include "bihive/measure/neighbour_grid.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>

namespace bihive::measure {
namespace {

// Cells for each ball of a level at most. Measured on proteins and on packings of 1:1 to 100:1: 1 to 4 differ little.
constexpr double kCellsPerBall = 2;
// The mean number of balls that share the cell of a ball, above which the tree is faster.
constexpr double kCrowd = 64;
// Many more than distances lose by rounding; those of periodic sets lose a part of the coordinates too.
constexpr double kAllowance = 1 + 0x1p-40, kRounding = 0x1p-50;

}  // namespace

std::int64_t NeighbourGrid::Level::cell_of(double x, int axis) const {
  const double cell = std::floor((x - lo[axis]) * cells_per_unit);
  return static_cast<std::int64_t>(std::clamp(cell, 0.0, static_cast<double>(cells[axis] - 1)));
}

std::optional<NeighbourGrid> NeighbourGrid::of(const Balls& balls) {
  if (balls.size() > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  NeighbourGrid grid;
  if (balls.is_periodic())
    for (const Vec3d centre : balls.centre)
      grid.rounding_ = std::max(grid.rounding_, kRounding * largest_coordinate(centre));
  std::map<int, std::vector<std::int64_t>, std::greater<>> octaves;
  for (std::int64_t i = 0; i < balls.size(); ++i) octaves[std::ilogb(balls.radius[i])].push_back(i);
  for (const auto& [exponent, ids] : octaves) {
    // Cells of about the largest radius, or larger so that there are not many more than balls.
    Level level;
    level.first = static_cast<std::int64_t>(grid.order_.size());
    Vec3d hi = balls.centre[ids[0]];
    level.lo = hi;
    for (const std::int64_t i : ids) {
      level.largest = std::max(level.largest, balls.radius[i]);
      for (int axis = 0; axis < 3; ++axis) {
        level.lo[axis] = std::min(level.lo[axis], balls.centre[i][axis]);
        hi[axis] = std::max(hi[axis], balls.centre[i][axis]);
      }
    }
    const Vec3d extent = hi - level.lo;
    const double most = kCellsPerBall * static_cast<double>(ids.size()) + 1;
    double side = level.largest;
    const auto number = [&] {
      double product = 1;
      for (int axis = 0; axis < 3; ++axis) product *= std::floor(extent[axis] / side) + 1;
      return product;
    };
    while (number() > most) side *= 1.25;
    level.cells_per_unit = 1 / side;
    for (int axis = 0; axis < 3; ++axis)
      level.cells[axis] = static_cast<std::int64_t>(std::floor(extent[axis] / side)) + 1;

    // Count, then place in the order of ids.
    const auto cells = static_cast<std::size_t>(level.cells[0] * level.cells[1] * level.cells[2]);
    level.begin.assign(cells + 1, 0);
    std::vector<std::uint32_t> cell_of_ball(ids.size());
    for (std::size_t n = 0; n < ids.size(); ++n) {
      const Vec3d c = balls.centre[ids[n]];
      cell_of_ball[n] = static_cast<std::uint32_t>(
          (level.cell_of(c.z, 2) * level.cells[1] + level.cell_of(c.y, 1)) * level.cells[0] + level.cell_of(c.x, 0));
      ++level.begin[cell_of_ball[n] + 1];
    }
    double shared = 0;
    for (std::size_t cell = 0; cell < cells; ++cell) {
      shared += double(level.begin[cell + 1]) * level.begin[cell + 1];
      level.begin[cell + 1] += level.begin[cell];
    }
    if (shared > kCrowd * static_cast<double>(ids.size())) return std::nullopt;
    std::vector<std::uint32_t> next(level.begin.begin(), level.begin.end() - 1);
    grid.order_.resize(grid.order_.size() + ids.size());
    grid.balls_.resize(grid.order_.size());
    for (std::size_t n = 0; n < ids.size(); ++n) {
      const auto at = static_cast<std::size_t>(level.first + next[cell_of_ball[n]]++);
      grid.order_[at] = ids[n];
      grid.balls_[at] = {balls.centre[ids[n]], balls.radius[ids[n]]};
    }
    grid.levels_.push_back(std::move(level));
  }
  return grid;
}

void NeighbourGrid::find(const Balls& balls, std::int64_t i, std::vector<std::int64_t>& found) const {
  const Vec3d centre = balls.centre[i];
  const double radius = balls.radius[i] + rounding_;
  for (const Level& level : levels_) {
    const double reach = (radius + level.largest) * kAllowance;
    std::array<std::int64_t, 3> low{}, high{};
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = level.cell_of(centre[axis] - reach, axis);
      high[axis] = level.cell_of(centre[axis] + reach, axis);
    }
    for (std::int64_t z = low[2]; z <= high[2]; ++z)
      for (std::int64_t y = low[1]; y <= high[1]; ++y) {
        // The cells of a row are neighbours in memory.
        const std::int64_t row = (z * level.cells[1] + y) * level.cells[0];
        const std::int64_t end = level.first + level.begin[row + high[0] + 1];
        for (std::int64_t at = level.first + level.begin[row + low[0]]; at < end; ++at) {
          const Ball& ball = balls_[at];
          const Vec3d between = ball.centre - centre;
          const double sum = radius + ball.radius;
          if (dot(between, between) <= sum * sum * kAllowance) found.push_back(order_[at]);
        }
      }
  }
}

}  // namespace bihive::measure
