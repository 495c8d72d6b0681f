// Which points lie near a set of points: exact, and not each against each.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/math/vec3.h"

namespace bihive {

/// Answers whether any of its points lies at most so far from another point. A tree of boxes: building takes
/// O(n log n), an answer O(log n) where points do not crowd at that very distance.
class NearbyPoints {
 public:
  explicit NearbyPoints(std::vector<Vec3d> points);

  /// True if some point p has |p - centre|^2 <= distance_squared, in binary64: exactly the answer of comparing all.
  bool any_within(Vec3d centre, double distance_squared) const;

 private:
  struct Box {
    Vec3d lo, hi;
    std::uint32_t first = 0, count = 0;  // of points_
    std::uint32_t second_child = 0;      // the first child follows its parent; 0: a leaf
  };
  std::uint32_t build(std::uint32_t first, std::uint32_t count);

  std::vector<Vec3d> points_;
  std::vector<Box> boxes_;
};

}  // namespace bihive
