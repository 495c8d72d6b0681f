// The oracle for sticks: the first and the last ball that a line meets, found by search in long double.
//
// It knows no formula of the side. The balls between the ends give a convex function of their position along the axis:
// where the line enters them. A search halves the range in which its least value lies. Errors are told by radii: a root
// of the library is right if it lies between those of a stick whose radii are all larger by e, and of one whose radii
// are all smaller, where e is the bound of docs/precision.md:
//   e = 6 u (L + r) + 130 u^2 L^2 / r,   L the farthest distance from the ray's origin to the centre of an end.
#pragma once

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#include "bihive/geometry/stick.h"

namespace bihive::test {

static_assert(LDBL_MANT_DIG >= 64, "the oracle needs a long double wider than binary64");

class StickOracle {
 public:
  using Real = long double;
  static constexpr Real kInf = std::numeric_limits<Real>::infinity();
  static constexpr Real kU = 0x1p-53L;

  struct Roots {
    Real t_near = kInf, t_far = -kInf;
    bool exist() const { return t_near <= t_far; }
  };

  StickOracle(const ScaledRay& ray, const Stick& stick) {
    for (int axis = 0; axis < 3; ++axis) {
      d_[axis] = Real(ray.direction[axis]);
      a_[axis] = Real(stick.a[axis]) - Real(ray.origin[axis]);
      b_[axis] = Real(stick.b[axis]) - Real(ray.origin[axis]);
    }
    radius_a_ = stick.radius_a;
    radius_b_ = stick.radius_b;
    dd_ = dot(d_, d_);
    distance_ = std::sqrt(std::max(dot(a_, a_), dot(b_, b_)));
    Real axis[3];
    for (int k = 0; k < 3; ++k) axis[k] = b_[k] - a_[k];
    has_side_ = dot(axis, axis) > (radius_b_ - radius_a_) * (radius_b_ - radius_a_);
  }

  /// How far a radius may be wrong, in stored units.
  Real error() const {
    const Real r = std::max(radius_a_, radius_b_);
    return 6 * kU * (distance_ + r) + 130 * kU * kU * distance_ * distance_ / r;
  }
  /// How far t may be wrong besides.
  Real error_of_t(Real t) const { return 9 * kU * distance_ / std::sqrt(dd_) + 2 * kU * std::abs(t); }

  /// Of the stick with all radii larger by `more`.
  Roots roots(Real more = 0) const {
    const Real deepest = find_deepest(more);
    Roots found;
    if (!(discriminant(deepest, more) >= 0)) return found;
    found.t_near = std::min(least(deepest, 0, more, -1), least(deepest, 1, more, -1));
    found.t_far = -std::min(least(deepest, 0, more, 1), least(deepest, 1, more, 1));
    return found;
  }

  /// Can binary64 give these roots? `share`: of the allowed errors.
  bool accepts(const StickRoots& found, Real share = 1) const {
    const Real e = share * error();
    const auto error_of_t = [&](Real t) { return share * this->error_of_t(t); };
    const Roots larger = roots(e), smaller = roots(-e);
    if (std::isnan(found.t_near)) return std::isnan(found.t_far) && !smaller.exist();
    if (!larger.exist() || !(found.t_near <= found.t_far)) return false;
    const Real latest = smaller.exist() ? smaller.t_near : larger.t_far;
    const Real earliest = smaller.exist() ? smaller.t_far : larger.t_near;
    const Real t_near = found.t_near, t_far = found.t_far;
    return t_near >= larger.t_near - error_of_t(t_near) && t_near <= latest + error_of_t(t_near) &&
           t_far <= larger.t_far + error_of_t(t_far) && t_far >= earliest - error_of_t(t_far);
  }

 private:
  Real a_[3], b_[3], d_[3];  // ends as seen from the ray's origin
  Real radius_a_, radius_b_, dd_, distance_;
  bool has_side_;

  static Real dot(const Real* v, const Real* w) { return v[0] * w[0] + v[1] * w[1] + v[2] * w[2]; }
  Real radius(Real s, Real more) const { return (1 - s) * radius_a_ + s * radius_b_ + more; }
  void centre(Real s, Real* c) const {
    for (int k = 0; k < 3; ++k) c[k] = (1 - s) * a_[k] + s * b_[k];
  }

  /// By the area of the parallelogram of centre and direction.
  Real discriminant(Real s, Real more) const {
    Real c[3];
    centre(s, c);
    const Real x = c[1] * d_[2] - c[2] * d_[1], y = c[2] * d_[0] - c[0] * d_[2], z = c[0] * d_[1] - c[1] * d_[0];
    const Real r = radius(s, more);
    return r > 0 ? r * r - (x * x + y * y + z * z) / dd_ : -kInf;
  }
  /// Of the ball at s: -1 where the line enters it, 1 minus where it leaves it; +inf without.
  Real end(Real s, Real more, int side) const {
    const Real inside = discriminant(s, more);
    if (!(inside >= 0)) return kInf;
    Real c[3];
    centre(s, c);
    return -side * dot(c, d_) / dd_ - std::sqrt(inside / dd_);
  }

  /// The ball in which the line lies deepest. Where the discs that balls are across the line shrink faster than they
  /// move, that is the larger end.
  Real find_deepest(Real more) const {
    Real best = radius_b_ > radius_a_ ? 1 : 0;
    if (!has_side_) return best;
    Real lo = 0, hi = 1;
    for (int i = 0; i < 90; ++i) {
      const Real one = lo + (hi - lo) * 0.382L, other = lo + (hi - lo) * 0.618L;
      if (discriminant(one, more) >= discriminant(other, more))
        hi = other;
      else
        lo = one;
    }
    for (const Real s : {lo, hi, Real(0), Real(1)})
      if (discriminant(s, more) > discriminant(best, more)) best = s;
    return best;
  }

  /// The least end of the balls from the deepest to the one at `last`.
  Real least(Real deepest, Real last, Real more, int side) const {
    if (!has_side_) return end(deepest, more, side);
    Real lo = deepest, hi = last;
    for (int i = 0; i < 90; ++i) {
      const Real one = lo + (hi - lo) * 0.382L, other = lo + (hi - lo) * 0.618L;
      if (end(one, more, side) <= end(other, more, side))
        hi = other;
      else
        lo = one;
    }
    return std::min({end(lo, more, side), end(hi, more, side), end(deepest, more, side)});
  }
};

}  // namespace bihive::test
