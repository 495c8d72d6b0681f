// Searches among the caps of one sphere, in lanes of binary64.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "bihive/math/vec3.h"

namespace bihive::measure {

/// Of a unit sphere: all its points x with x.axis > c, by components. s is the sine of the angular radius.
struct CapNumbers {
  Vec3d axis;
  double c, s;
};

/// Circles of caps cross where d > 0. Each term is rounded once, so lanes and single numbers have the same bits.
struct CirclePair {
  double g, d;  ///< g: cosine between the axes

  static CirclePair of(const CapNumbers& p, const CapNumbers& q) {
    const double g = dot(p.axis, q.axis), t = g - p.c * q.c, product = p.s * q.s;
    return {g, product * product - t * t};
  }
};

/// Caps in arrays, each padded with caps of no point, which cross none.
class CapArrays {
 public:
  /// No caps, and room for `count`.
  void clear(std::size_t count);
  void push(const CapNumbers& cap);
  /// Makes cap `index` one without points.
  void erase(int index);
  int size() const { return size_; }
  const double* operator[](std::size_t k) const { return numbers_[k].data(); }  ///< x, y, z, c, s
  /// Room for `count` caps and the padding, to be written.
  double* write(std::size_t k, std::size_t count);
  /// The caps written: pads them.
  void end_at(int size);

 private:
  int size_ = 0;
  std::array<std::vector<double>, 5> numbers_;
};

/// The first cap from `from` on of which it is not sure that it has no point in common with `cap` or that their circles
/// cross. `doubt`: the least |d| that is sure. The number of caps if there is none.
int first_unclear(const CapArrays& caps, int from, const CapNumbers& cap, double doubt);

/// Of the caps whose circles surely cross that of `cap`, the one that covers the longest arc of it; of equal ones the
/// first. The number of caps if there is none. `crossing` gets all of them: axes and c.
int widest_crossing(const CapArrays& caps, const CapNumbers& cap, double doubt, CapArrays& crossing);

/// An arc of the circle of `cap` from `start` counterclockwise to `end`, with its middle: from the circle's centre.
struct ArcPoints {
  Vec3d start, middle, end;
};

/// Whether caps surely cover the arc: those in `crossing`, none of which leaves a shorter arc of the circle than this
/// one. So one that holds both ends of a section of it covers the section: what it leaves does not fit between them.
/// Sections that no cap covers are halved a few times. A point is held that is above c by more than `doubt`.
bool surely_cover(const CapArrays& crossing, const CapNumbers& cap, const ArcPoints& arc, double doubt);

/// The first cap from `from` on in which a or b lies, or may lie: x.axis - c is at least -doubt.
int first_holding(const CapArrays& caps, int from, Vec3d a, Vec3d b, double doubt);

}  // namespace bihive::measure
