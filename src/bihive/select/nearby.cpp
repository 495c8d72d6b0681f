#include "bihive/select/nearby.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "bihive/base/check.h"

namespace bihive {
namespace {

constexpr std::uint32_t kMostPointsInLeaf = 8;
// Halves of 2^32 points end after 32 levels. A walk keeps at most one box a level.
constexpr std::size_t kMostLevelsOfPoints = 64;

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

NearbyPoints::NearbyPoints(std::vector<Vec3d> points, const std::optional<Lattice>& lattice) : lattice_(lattice) {
  BIHIVE_CHECK(points.size() < std::numeric_limits<std::uint32_t>::max());
  points_.reserve(points.size());
  for (const Vec3d& point : points) {
    Vec3d at = point;
    if (lattice_) {
      at = point - lattice_->shift(lattice_->cell_of(point));
      const Vec3d share = lattice_->shares(at);
      const bool is_first = points_.empty();
      for (int axis = 0; axis < 3; ++axis) {
        lowest_share_[axis] = is_first ? share[axis] : std::min(lowest_share_[axis], share[axis]);
        highest_share_[axis] = is_first ? share[axis] : std::max(highest_share_[axis], share[axis]);
      }
      largest_ = std::max(largest_, largest_coordinate(point));
    }
    points_.push_back({at, static_cast<std::uint32_t>(points_.size())});
  }
  if (lattice_) given_ = std::move(points);
  if (!points_.empty()) build(0, static_cast<std::uint32_t>(points_.size()));
}

std::uint32_t NearbyPoints::build(std::uint32_t first, std::uint32_t count) {
  const auto place = static_cast<std::uint32_t>(boxes_.size());
  const auto begin = points_.begin() + first;
  Box box{begin->at, begin->at, first, count, 0};
  for (auto p = begin; p != begin + count; ++p)
    for (int axis = 0; axis < 3; ++axis) {
      box.lo[axis] = std::min(box.lo[axis], p->at[axis]);
      box.hi[axis] = std::max(box.hi[axis], p->at[axis]);
    }
  boxes_.push_back(box);
  if (count <= kMostPointsInLeaf) return place;

  // Halve the points along the longest side.
  const Vec3d side = box.hi - box.lo;
  const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
  const std::uint32_t half = count / 2;
  std::nth_element(begin, begin + half, begin + count,
                   [axis](const Point& a, const Point& b) { return a.at[axis] < b.at[axis]; });
  build(first, half);
  boxes_[place].second_child = build(first + half, count - half);
  return place;
}

bool NearbyPoints::any_within(Vec3d centre, double distance) const {
  if (boxes_.empty()) return false;
  const double distance_squared = distance * distance;
  if (!lattice_)
    return any_point(centre, distance_squared,
                     [&](const Point& point) { return squared_distance(point.at, centre) <= distance_squared; });

  // An image that is near along the lattice is nearer than all farther ones of its point.
  const double searched = std::min(distance, lattice_->covering());
  const ImageCounts own = lattice_->cell_of(centre);
  const Vec3d at = centre - lattice_->shift(own);
  const double largest = std::max(largest_, largest_coordinate(centre));
  const auto range = lattice_->images_within(searched, at, lowest_share_, highest_share_, largest);
  // Moving into the cell and back rounds coordinates and shifts, each some times; a share of a skewed cell may be
  // condition() times as long as the sum of all.
  const double pad = 0x1p-46 * lattice_->condition() * (largest + searched + lattice_->longest());
  const double kept = (distance + pad) * (distance + pad);
  const double sure = distance > pad ? (distance - pad) * (distance - pad) * (1 - 0x1p-50) : -1;
  return any_image(range, [&](const ImageCounts& counts) {
    const Vec3d moved = at - lattice_->shift(counts);
    return any_point(moved, kept, [&](const Point& point) {
      const double squared = squared_distance(point.at, moved);
      if (squared <= sure) return true;
      if (!(squared <= kept)) return false;
      const Vec3d given = given_[point.of];
      const Vec3d between = (given - centre) + lattice_->shift(counts + own - lattice_->cell_of(given));
      return dot(between, between) <= distance_squared;
    });
  });
}

// Calls is_near(point) for points, among them every one within the distance, until it returns true.
template <class IsNear>
bool NearbyPoints::any_point(Vec3d centre, double distance_squared, const IsNear& is_near) const {
  std::array<std::uint32_t, kMostLevelsOfPoints> waiting;
  std::size_t waiting_count = 0;
  waiting[waiting_count++] = 0;
  while (waiting_count > 0) {
    const std::uint32_t place = waiting[--waiting_count];
    const Box& box = boxes_[place];
    if (!(squared_distance_to_box(centre, box.lo, box.hi) <= distance_squared)) continue;
    if (box.second_child == 0) {
      for (std::uint32_t i = box.first; i < box.first + box.count; ++i)
        if (is_near(points_[i])) return true;
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
