#include "bihive/select/nearby.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include "bihive/base/check.h"

namespace bihive {
namespace {

constexpr std::uint32_t kMostPointsInLeaf = 8;
// Halves of 2^32 points end after 32 levels. A walk keeps at most one box a level.
constexpr std::size_t kMostLevels = 64;

double squared_distance(Vec3d a, Vec3d b) {
  const Vec3d d = a - b;
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

// Never more than the squared distance to any point of the box: subtraction, squares and sums of binary64 round
// monotonically, and the terms are added in the same order.
double squared_distance_to_box(Vec3d p, Vec3d lo, Vec3d hi) {
  Vec3d d;
  for (int axis = 0; axis < 3; ++axis) d[axis] = std::max({lo[axis] - p[axis], 0.0, p[axis] - hi[axis]});
  return d.x * d.x + d.y * d.y + d.z * d.z;
}

}  // namespace

NearbyPoints::NearbyPoints(std::vector<Vec3d> points) : points_(std::move(points)) {
  BIHIVE_CHECK(points_.size() < std::numeric_limits<std::uint32_t>::max());
  if (!points_.empty()) build(0, static_cast<std::uint32_t>(points_.size()));
}

std::uint32_t NearbyPoints::build(std::uint32_t first, std::uint32_t count) {
  const auto place = static_cast<std::uint32_t>(boxes_.size());
  const auto begin = points_.begin() + first;
  Box box{*begin, *begin, first, count, 0};
  for (auto p = begin; p != begin + count; ++p)
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], (*p)[axis]);
      box.hi[axis] = std::max(box.hi[axis], (*p)[axis]);
    }
  boxes_.push_back(box);
  if (count <= kMostPointsInLeaf) return place;

  // Halve the points along the longest side.
  const Vec3d side = box.hi - box.lo;
  const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count,
                   [axis](const Vec3d& a, const Vec3d& b) { return a[axis] < b[axis]; });
  build(first, half);
  boxes_[place].second_child = build(first + half, count - half);
  return place;
}

bool NearbyPoints::any_within(Vec3d centre, double distance_squared) const {
  if (boxes_.empty()) return false;
  std::array<std::uint32_t, kMostLevels> waiting;
  std::size_t waiting_count = 0;
  waiting[waiting_count++] = 0;
  while (waiting_count > 0) {
    const std::uint32_t place = waiting[--waiting_count];
    const Box& box = boxes_[place];
    if (!(squared_distance_to_box(centre, box.lo, box.hi) <= distance_squared)) continue;
    if (box.second_child == 0) {
      for (std::uint32_t i = box.first; i < box.first + box.count; ++i)
        if (squared_distance(points_[i], centre) <= distance_squared) return true;
      continue;
    }
    // Look into the nearer child first: it is put on top.
    std::uint32_t near = place + 1, far = box.second_child;
    const auto to_box = [&](std::uint32_t i) { return squared_distance_to_box(centre, boxes_[i].lo, boxes_[i].hi); };
    if (to_box(far) < to_box(near)) std::swap(near, far);
    waiting[waiting_count++] = far;
    waiting[waiting_count++] = near;
  }
  return false;
}

}  // namespace bihive
