// The copies of a replicated set whose boxes a ray meets.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "bihive/bih/traversal.h"
#include "bihive/geometry/cell.h"
#include "bihive/geometry/scaled_ray.h"

namespace bihive {

/// Neighbouring copies: from `first` to before `end` along each vector.
struct ImageRange {
  std::array<std::int32_t, 3> first, end;

  bool is_single() const { return end[0] - first[0] == 1 && end[1] - first[1] == 1 && end[2] - first[2] == 1; }
  /// Both halves along the longest side, which is number `side`.
  std::array<ImageRange, 2> halves(std::size_t& side) const {
    side = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (end[k] - first[k] > end[side] - first[side]) side = k;
    std::array<ImageRange, 2> two{*this, *this};
    const std::int32_t middle = first[side] + (end[side] - first[side]) / 2;
    two[0].end[side] = middle;
    two[1].first[side] = middle;
    return two;
  }
};

/// Binary64, in stored units.
struct ImageBox {
  Vec3d lo, hi;
};

/// The box of the copies of one box.
inline ImageBox box_of(const ImageRange& range, const ImageBox& stored, const Images& images, double scale) {
  const Images::Shifts shifts = images.shifts(range.first, range.end);
  return {stored.lo + scale * shifts.lo, stored.hi + scale * shifts.hi};
}

/// Calls visit.visit(range) with single copies whose boxes the ray meets up to visit.limit(), the nearer half of them
/// first, until it returns true. Boxes are padded for the rounding of the stored one and of copies.
template <class Visit>
void visit_image_boxes(const Images& images, double scale, const ImageBox& stored, const ScaledRay& ray, Visit& visit) {
  // Rounding moves the centre of a copy by up to 2^-25, and the planes of the stored box by up to 2^-24.
  constexpr double kBoxPad = 0x1p-22;
  const Slabs slabs(ray, kBoxPad);
  std::vector<ImageRange> waiting{{{0, 0, 0}, images.counts}};
  while (!waiting.empty()) {
    const ImageRange range = waiting.back();
    waiting.pop_back();
    const ImageBox box = box_of(range, stored, images, scale);
    Interval part{ray.t_min, std::min(ray.t_max, visit.limit())};
    for (int axis = 0; axis < 3; ++axis) {
      part = slabs.above(part, axis, box.lo[axis]);
      part = slabs.below(part, axis, box.hi[axis]);
    }
    if (part.empty()) continue;
    if (range.is_single()) {
      if (visit.visit(range)) return;
      continue;
    }
    std::size_t side = 0;
    const std::array<ImageRange, 2> two = range.halves(side);
    const bool first_is_near = dot(images.vectors[side], ray.direction) >= 0;
    waiting.push_back(two[first_is_near ? 1 : 0]);
    waiting.push_back(two[first_is_near ? 0 : 1]);
  }
}

}  // namespace bihive
