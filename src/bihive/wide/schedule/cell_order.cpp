#include "bihive/wide/schedule/cell_order.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "bihive/wide/schedule/counting_sort.h"
#include "bihive/wide/schedule/tuning.h"

namespace bihive::wide {
namespace {

double largest_extent(const Aabb& box) {
  double largest = 0;
  for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, double(box.hi[axis]) - double(box.lo[axis]));
  return largest;
}

// Bits of a cell's position along each axis.
int bits_for(std::int64_t rays) {
  int bits = 0;
  while ((8 * kRaysPerCell) << (3 * (bits + 1)) <= rays) ++bits;
  return bits;
}

}  // namespace

bool scattered(const WideTree& tree, const RaySpan& rays) {
  if (rays.count < kFewestScattered || tree.size < kFewestSpheres) return false;
  const double far = largest_extent(tree.aabb) * kFarInExtents;
  int looked = 0;
  int far_apart = 0;
  const std::int64_t step = (rays.count / kCoherenceSamples) | 1;  // odd: rays may come in groups of two, four, ...
  for (std::int64_t i = 0; i + 1 < rays.count; i += step, ++looked) {
    double most = 0;
    for (int axis = 0; axis < 3; ++axis)
      most = std::max(most, std::abs(double(rays.origin[axis][i + 1]) - double(rays.origin[axis][i])));
    if (most * tree.scale > far) ++far_apart;
  }
  return far_apart >= kScatteredShare * looked;
}

void CellOrder::find(const WideTree& tree, const RaySpan& rays, std::vector<std::uint32_t>& order) {
  const int bits = bits_for(rays.count);
  number_cells(tree, rays, bits);
  order_by_cells(cells_.data(), cells_.size(), std::size_t{8} << (3 * bits), ends_, order);
}

// The octant of the direction, followed by the origin's position in a grid over the spheres, along a Z-order curve.
void CellOrder::number_cells(const WideTree& tree, const RaySpan& rays, int bits) {
  const auto side = static_cast<float>(1 << bits);
  float scale[3], shift[3];
  for (int axis = 0; axis < 3; ++axis) {
    const double low = double(tree.aabb.lo[axis]);
    const double cells = double(side) / std::max(double(tree.aabb.hi[axis]) - low, 1e-20);
    scale[axis] = static_cast<float>(std::min(tree.scale * cells, double(std::numeric_limits<float>::max())));
    shift[axis] = static_cast<float>(low * cells);
  }
  const auto place = [&](std::size_t i, int axis) {
    const float x = rays.origin[axis][i] * scale[axis] - shift[axis];
    const float above = x > 0 ? x : 0;  // 0 if it is not a number
    // The bits of the position, three apart.
    auto k = static_cast<std::uint32_t>(static_cast<std::int32_t>(above < side - 1 ? above : side - 1));
    k = (k | k << 8) & 0x0000F00FU;
    k = (k | k << 4) & 0x000C30C3U;
    k = (k | k << 2) & 0x00249249U;
    return k << axis;
  };
  cells_.resize(static_cast<std::size_t>(rays.count));
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    std::uint32_t octant = 0;
    for (int axis = 0; axis < 3; ++axis) octant |= (rays.direction[axis][i] < 0 ? 1U : 0U) << axis;
    cells_[i] = octant << (3 * bits) | place(i, 0) | place(i, 1) | place(i, 2);
  }
}

}  // namespace bihive::wide
