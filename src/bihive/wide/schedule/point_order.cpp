#include "bihive/wide/schedule/point_order.h"

#include <algorithm>
#include <numeric>

#include "bihive/wide/schedule/counting_sort.h"
#include "bihive/wide/schedule/tuning.h"

namespace bihive::wide {
namespace {

// Bits of a cell's position along each axis.
int bits_of_cells(std::int64_t points) {
  int bits = 0;
  while (bits < kMostPointCellBits && (kPointsPerCell << (3 * (bits + 1))) <= points) ++bits;
  return bits;
}

// Two zero bits between each two of the ten lowest.
std::uint32_t spread_bits(std::uint32_t k) {
  k = (k | k << 16) & 0x030000FFU;
  k = (k | k << 8) & 0x0300F00FU;
  k = (k | k << 4) & 0x030C30C3U;
  return (k | k << 2) & 0x09249249U;
}

}  // namespace

void PointOrder::find(const WideTree& tree, const PointSpan& points, std::vector<std::uint32_t>& order) {
  const int bits = bits_of_cells(points.count);
  if (points.count < kFewestPoints || tree.size < kFewestSpheresOfPoints || bits == 0) {
    order.resize(static_cast<std::size_t>(points.count));
    std::iota(order.begin(), order.end(), 0U);
    return;
  }
  // A grid over the spheres; points beyond it belong to the cells at its border.
  const double last = double((1 << bits) - 1);
  double low[3], per_unit[3];
  for (int axis = 0; axis < 3; ++axis) {
    low[axis] = double(tree.aabb.lo[axis]) + tree.shift[axis];
    per_unit[axis] = (last + 1) / std::max(double(tree.aabb.hi[axis]) - double(tree.aabb.lo[axis]), 0x1p-100);
  }
  cells_.resize(static_cast<std::size_t>(points.count));
  for (std::int64_t i = 0; i < points.count; ++i) {
    const Vec3d at = tree.stored(points.at(i));
    std::uint32_t cell = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double place = std::clamp((at[axis] - low[axis]) * per_unit[axis], 0.0, last);
      cell |= spread_bits(static_cast<std::uint32_t>(place)) << axis;
    }
    cells_[static_cast<std::size_t>(i)] = cell;
  }
  order_by_cells(cells_.data(), cells_.size(), std::size_t{1} << (3 * bits), ends_, order);
}

}  // namespace bihive::wide
