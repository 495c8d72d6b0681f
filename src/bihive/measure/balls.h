// The balls of a union: what decisions and measures are about.
#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "bihive/geometry/lattice.h"
#include "bihive/math/vec3.h"

namespace bihive::measure {

/// Ball `ball` of the cell, moved by counts of the cell's vectors. Their order does not change with a common move.
struct Image {
  std::int64_t ball = 0;
  std::int32_t a = 0, b = 0, c = 0;

  ImageCounts counts() const { return {a, b, c}; }
  friend auto operator<=>(const Image&, const Image&) = default;
};

/// Centres and radii in one unit. Coordinates are below 2^42 in magnitude, radii above 0 and below 2^41, and all are
/// multiples of 2^-160.
///
/// A periodic set has the balls of one cell first, and after them every image that shares a point with one of these
/// (measure/periodic_balls.h). Ball i is at centre[i] + rest[i], exactly.
struct Balls {
  std::vector<Vec3d> centre;
  std::vector<double> radius;
  std::vector<Vec3d> rest;   ///< of periodic sets: below a rounding of the centre
  std::vector<Image> image;  ///< of periodic sets: for every ball, counts 0 for those of the cell

  std::int64_t size() const { return static_cast<std::int64_t>(radius.size()); }
  bool is_periodic() const { return !image.empty(); }

  /// From the centre of ball i to that of ball j, rounded once.
  Vec3d between(std::int64_t i, std::int64_t j) const {
    const Vec3d a = centre[i], b = centre[j], d = b - a;
    if (rest.empty()) return d;
    // What a difference loses by rounding is a number of binary64 too, and it and the rests have so few bits that
    // their sum is exact.
    const auto lost = [](double from, double to, double difference) {
      const double to_again = difference + from, from_again = to_again - difference;
      return (to - to_again) - (from - from_again);
    };
    const Vec3d lost_bits{lost(a.x, b.x, d.x), lost(a.y, b.y, d.y), lost(a.z, b.z, d.z)};
    return d + (lost_bits + (rest[j] - rest[i]));
  }

  bool are_equal(std::int64_t i, std::int64_t j) const {
    return radius[i] == radius[j] && centre[i] == centre[j] && (rest.empty() || rest[i] == rest[j]);
  }

  /// An order of all balls; of a periodic set, the same for balls that are moved together.
  bool comes_before(std::int64_t i, std::int64_t j) const { return image.empty() ? i < j : image[i] < image[j]; }

  /// Whether the symbolic perturbation shrinks ball i more than ball j (measure/decisions.h): the smaller one, of equal
  /// ones the later.
  bool shrinks_more(std::int64_t i, std::int64_t j) const {
    return radius[i] != radius[j] ? radius[i] < radius[j] : comes_before(j, i);
  }
};

}  // namespace bihive::measure
