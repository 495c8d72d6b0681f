// The translations of a periodic cell: which images of a point may lie near another one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "bihive/geometry/cell.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// How many times a point is moved along each vector of a cell. 0 along those that the set does not repeat along.
using ImageCounts = std::array<std::int64_t, 3>;

inline ImageCounts operator+(const ImageCounts& a, const ImageCounts& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline ImageCounts operator-(const ImageCounts& a, const ImageCounts& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double largest_coordinate(Vec3d p) {
  return std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
}

/// All sums of whole multiples of the periodic vectors of a cell, one to three of them, skewed or not.
class Lattice {
 public:
  /// Nothing if the cell is periodic along no vector, if its periodic vectors lie (nearly) in a plane or on a line, as
  /// those of a placeholder may, or if one of them is more than 2^14 times as long as another.
  static std::optional<Lattice> of(const Cell& cell);
  static std::optional<Lattice> of(const std::optional<Cell>& cell);

  /// Why a cell whose periodic vectors are not all 0 has no lattice; empty: it has one, or no such vectors.
  static std::string why_none(const Cell& cell);

  /// The same in other units; exact for a power of two.
  Lattice times(double factor) const;

  /// counts[0] * a + counts[1] * b + counts[2] * c, the sum from left to right.
  Vec3d shift(const ImageCounts& counts) const {
    return double(counts[0]) * vectors_[0] + double(counts[1]) * vectors_[1] + double(counts[2]) * vectors_[2];
  }
  /// The vector as multiples of the cell's; 0 along those that are not periodic. Rounded.
  Vec3d shares(Vec3d vector) const { return {dot(vector, rows_[0]), dot(vector, rows_[1]), dot(vector, rows_[2])}; }
  /// Whether binary64 tells the point's place in a cell well: it is at most 2^40 cells away. Farther points know no
  /// images.
  bool holds(Vec3d point) const {
    constexpr double kMost = 0x1p40;
    const Vec3d share = shares(point);
    return std::abs(share.x) <= kMost && std::abs(share.y) <= kMost && std::abs(share.z) <= kMost;
  }
  /// The counts that bring the cell at the origin to the point.
  ImageCounts cell_of(Vec3d point) const;

  /// Half the sum of the vectors' lengths, a little enlarged: from every point, some image of any other one is at most
  /// this far away along the directions in which the lattice extends.
  double covering() const { return covering_; }
  /// The greatest and the least length of a vector.
  double longest() const { return longest_; }
  double shortest() const { return shortest_; }
  /// How many times the rounding of a sum or product may be in a share, and in a shift.
  double condition() const { return condition_; }
  /// How far a share along vector k moves, at most, with a point that moves by 1. 0 along those that are not periodic.
  double share_of_length(std::size_t k) const { return row_lengths_[k]; }

  /// The counts n for which images p + shift(n) may lie at most `distance` from a point between `from` and `to`, where
  /// the shares of all points p lie from `lo` to `hi`. `largest`: of all coordinates of both. The distance is not too
  /// large: at most some thousand cells.
  struct Range {
    ImageCounts first{}, last{};
    bool empty() const { return first[0] > last[0] || first[1] > last[1] || first[2] > last[2]; }
    double count() const;
  };
  Range images_within(double distance, Vec3d from, Vec3d to, Vec3d lo, Vec3d hi, double largest) const;
  Range images_within(double distance, Vec3d from, Vec3d lo, Vec3d hi, double largest) const {
    return images_within(distance, from, from, lo, hi, largest);
  }

 private:
  Lattice() = default;

  std::array<Vec3d, 3> vectors_;         // (0, 0, 0) along those that are not periodic
  std::array<Vec3d, 3> rows_;            // the inverse of the matrix of vectors, row by row; (0, 0, 0) likewise
  std::array<double, 3> row_lengths_{};  // 1 / the distance between neighbouring planes of the lattice
  double covering_ = 0, longest_ = 0, shortest_ = 0, condition_ = 1;
};

/// From one position to the nearest image of another; of equally near ones that of the fewest shifts. Positions that
/// the lattice does not hold know no images.
ImageCounts nearest_image(Vec3d from, Vec3d to, const Lattice& lattice);

/// Calls visit(n) for the counts of the range, those near 0 first along each vector, until it returns true. Returns
/// whether it did.
template <class Visit>
bool any_image(const Lattice::Range& range, const Visit& visit) {
  if (range.empty()) return false;
  // The k-th number of 0, 1, -1, 2, -2 ...; those outside the range are passed over.
  const auto axis = [&](std::size_t i, const auto& inner) {
    const std::int64_t low = range.first[i], high = range.last[i];
    const std::int64_t middle = low > 0 ? low : high < 0 ? high : 0;
    const std::int64_t most = (high - middle > middle - low ? high - middle : middle - low);
    for (std::int64_t k = 0; k <= most; ++k) {
      if (middle + k <= high && inner(middle + k)) return true;
      if (k > 0 && middle - k >= low && inner(middle - k)) return true;
    }
    return false;
  };
  return axis(0, [&](std::int64_t i) {
    return axis(1, [&](std::int64_t j) {
      return axis(2, [&](std::int64_t k) { return visit(ImageCounts{i, j, k}); });
    });
  });
}

}  // namespace bihive
