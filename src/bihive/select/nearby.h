// Which points lie near a set of points: exact, and not each against each.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/geometry/lattice.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// Answers whether any of its points, or of their images, lies at most a given distance from another point. A tree of
/// boxes: building takes O(n log n), an answer O(log n) where points do not crowd at that very distance.
class NearbyPoints {
 public:
  /// With a lattice every image of a point counts, wherever points and images lie. The coordinates must be finite.
  explicit NearbyPoints(std::vector<Vec3d> points, const std::optional<Lattice>& lattice = std::nullopt);

  /// True if some point p has |p - centre|^2 <= distance^2 in binary64, or some image |(p - centre) + shift|^2: exactly
  /// the answer of comparing all.
  bool any_within(Vec3d centre, double distance) const;

 private:
  struct Point {
    Vec3d at;          // of a lattice: moved into the cell at the origin
    std::uint32_t of;  // its position among the given points
  };
  struct Box {
    Vec3d lo, hi;
    std::uint32_t first = 0, count = 0;  // of points_
    std::uint32_t second_child = 0;      // the first child follows its parent; 0: a leaf
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count);
  template <class IsNear>
  bool any_point(Vec3d centre, double distance_squared, const IsNear& is_near) const;

  std::vector<Point> points_;
  std::vector<Box> boxes_;
  std::optional<Lattice> lattice_;
  std::vector<Vec3d> given_;  // of a lattice alone
  Vec3d lowest_share_, highest_share_;
  double largest_ = 0;  // of all coordinates
};

}  // namespace bihive
