#include "bihive/geometry/lattice.h"

#include <algorithm>
#include <cmath>

namespace bihive {
namespace {

// Cells that are flatter than this are no cells: the shares of their points would be lost in rounding.
constexpr double kWorstCondition = 256;

// Nor are cells that are longer than this: a distance that is short along them may reach over as many images across.
constexpr double kMostAspect = 0x1p14;

// Beyond this no count is exact.
constexpr double kMostCells = 0x1p50;

// A vector of length 1 that is at right angles to the given ones.
Vec3d normal_to(Vec3d a) {
  const Vec3d magnitude{std::abs(a.x), std::abs(a.y), std::abs(a.z)};
  const Vec3d other = magnitude.x <= magnitude.y && magnitude.x <= magnitude.z ? Vec3d{1, 0, 0}
                      : magnitude.y <= magnitude.z                             ? Vec3d{0, 1, 0}
                                                                               : Vec3d{0, 0, 1};
  const Vec3d made = cross(a, other);
  return made / length(made);
}

}  // namespace

std::optional<Lattice> Lattice::of(const Cell& cell) {
  Lattice lattice;
  double largest = 0;
  int periodic = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!cell.periodic[k] || cell.vectors[k] == Vec3d{}) continue;
    if (!is_finite(cell.vectors[k])) return std::nullopt;
    lattice.vectors_[k] = cell.vectors[k];
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(cell.vectors[k][axis]));
    ++periodic;
  }
  if (periodic == 0) return std::nullopt;

  // Lengths near 1, so that no product is too large or too small. Directions in which the lattice does not extend get
  // unit vectors at right angles to it.
  const double scale = std::ldexp(1, -std::ilogb(largest));
  std::array<Vec3d, 3> full;
  for (std::size_t k = 0; k < 3; ++k) full[k] = lattice.vectors_[k] * scale;
  for (std::size_t k = 0; k < 3; ++k) {
    if (full[k] != Vec3d{}) continue;
    const Vec3d &next = full[(k + 1) % 3], &after = full[(k + 2) % 3];
    if (next == Vec3d{} || after == Vec3d{}) {
      full[k] = normal_to(next == Vec3d{} ? after : next);
    } else {
      const Vec3d normal = cross(next, after);
      if (normal == Vec3d{}) return std::nullopt;
      full[k] = normal / length(normal);
    }
  }
  const auto& [a, b, c] = full;
  const double volume = dot(a, cross(b, c));
  lattice.condition_ = length(a) * length(b) * length(c) / std::abs(volume);
  if (!(lattice.condition_ <= kWorstCondition)) return std::nullopt;
  const std::array<Vec3d, 3> rows{cross(b, c) / volume, cross(c, a) / volume, cross(a, b) / volume};
  for (std::size_t k = 0; k < 3; ++k) {
    if (lattice.vectors_[k] == Vec3d{}) continue;
    lattice.rows_[k] = rows[k] * scale;
    lattice.row_lengths_[k] = length(rows[k]) * scale;
    if (!is_finite(lattice.rows_[k])) return std::nullopt;
    const double edge = length(full[k]) / scale;
    lattice.covering_ += 0.5 * edge * (1 + 0x1p-20);
    lattice.longest_ = std::max(lattice.longest_, edge);
    lattice.shortest_ = lattice.shortest_ == 0 ? edge : std::min(lattice.shortest_, edge);
  }
  if (!(lattice.longest_ <= kMostAspect * lattice.shortest_)) return std::nullopt;
  return lattice;
}

std::optional<Lattice> Lattice::of(const std::optional<Cell>& cell) {
  return cell ? of(*cell) : std::nullopt;
}

std::string Lattice::why_none(const Cell& cell) {
  bool repeats = false;
  for (std::size_t k = 0; k < 3; ++k) repeats = repeats || (cell.periodic[k] && cell.vectors[k] != Vec3d{});
  if (!repeats || of(cell)) return "";
  return "the cell gives no periodic images: its vectors lie in a plane or on a line, or one is more than 16,384 times "
         "as long as another";
}

Lattice Lattice::times(double factor) const {
  Lattice made = *this;
  for (std::size_t k = 0; k < 3; ++k) {
    made.vectors_[k] = vectors_[k] * factor;
    made.rows_[k] = rows_[k] / factor;
    made.row_lengths_[k] = row_lengths_[k] / factor;
  }
  made.covering_ = covering_ * factor;
  made.longest_ = longest_ * factor;
  made.shortest_ = shortest_ * factor;
  return made;
}

ImageCounts Lattice::cell_of(Vec3d point) const {
  const Vec3d share = shares(point);
  ImageCounts counts{};
  for (int k = 0; k < 3; ++k)
    counts[static_cast<std::size_t>(k)] =
        static_cast<std::int64_t>(std::clamp(std::floor(share[k]), -kMostCells, kMostCells));
  return counts;
}

double Lattice::Range::count() const {
  double all = 1;
  for (std::size_t k = 0; k < 3; ++k) all *= double(last[k] - first[k] + 1);
  return all;
}

// A share is a dot product: it is wrong by some roundings of length(vector) * row_length * condition.
Lattice::Range Lattice::images_within(double distance, Vec3d from, Vec3d to, Vec3d lo, Vec3d hi, double largest) const {
  const Vec3d one = shares(from), other = shares(to);
  Range range;
  for (std::size_t k = 0; k < 3; ++k) {
    if (row_lengths_[k] == 0) continue;
    const auto axis = static_cast<int>(k);
    const double reach = distance * row_lengths_[k];
    // Of points so far away that rounding hides their place in a cell, more images would tell no more.
    const double pad = std::min(0.5, 0x1p-46 * condition_ * (1 + reach + 4 * largest * row_lengths_[k]));
    const auto whole = [](double number) {
      return static_cast<std::int64_t>(std::clamp(number, -kMostCells, kMostCells));
    };
    range.first[k] = whole(std::ceil(std::min(one[axis], other[axis]) - reach - hi[axis] - pad));
    range.last[k] = whole(std::floor(std::max(one[axis], other[axis]) + reach - lo[axis] + pad));
  }
  return range;
}

ImageCounts nearest_image(Vec3d from, Vec3d to, const Lattice& lattice) {
  const Vec3d apart = to - from;
  ImageCounts best{};
  double least = dot(apart, apart);
  // Any shift moves a point by at least the distance between planes of the lattice.
  double narrowest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < 3; ++k)
    if (lattice.share_of_length(k) > 0) narrowest = std::min(narrowest, 1 / lattice.share_of_length(k));
  if (4.004 * least <= narrowest * narrowest || !lattice.holds(from) || !lattice.holds(to)) return best;

  // Begin with an image that is surely near.
  const Vec3d share = lattice.shares(apart);
  for (int k = 0; k < 3; ++k)
    best[static_cast<std::size_t>(k)] = -static_cast<std::int64_t>(std::floor(share[k] + 0.5));
  const Vec3d begun = apart + lattice.shift(best);
  if (dot(begun, begun) < least)
    least = dot(begun, begun);
  else
    best = {};
  const Vec3d place = lattice.shares(to);
  const double largest = std::max(largest_coordinate(from), largest_coordinate(to));
  any_image(lattice.images_within(std::sqrt(least), from, place, place, largest), [&](const ImageCounts& by) {
    const Vec3d other = apart + lattice.shift(by);
    if (dot(other, other) < least) {
      least = dot(other, other);
      best = by;
    }
    return false;
  });
  return best;
}

}  // namespace bihive
