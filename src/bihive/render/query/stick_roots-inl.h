// stick_roots() of geometry/stick.h for several rays at a time: the same operations in the same order, so the same
// bits.

#if defined(BIHIVE_RENDER_QUERY_STICK_ROOTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_RENDER_QUERY_STICK_ROOTS_INL_H_
#undef BIHIVE_RENDER_QUERY_STICK_ROOTS_INL_H_
#else
#define BIHIVE_RENDER_QUERY_STICK_ROOTS_INL_H_
#endif

#include <hwy/highway.h>

#include "bihive/geometry/stick.h"
#include "bihive/math/vec3.h"
#include "bihive/render/query/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Rays in a stick's units.
struct RayLanes {
  Lanes3 origin, direction;
  Lanes direction_squared;
};

/// StickRoots; `hits`: where they are not NaN.
struct RootLanes {
  LaneMask hits;
  Lanes t_near, t_far, s_near, s_far;
};

/// A stick with a side: neither end lies in the other.
class StickForLanes {
 public:
  HWY_INLINE explicit StickForLanes(const Stick& stick)
      : stick_(stick),
        axis_(stick.b - stick.a),
        widening_(stick.radius_b - stick.radius_a),
        side_(bihive::dot(axis_, axis_) - widening_ * widening_) {}
  HWY_INLINE bool has_side() const { return side_ > 0; }

  HWY_INLINE RootLanes roots(const RayLanes& ray) const {
    const Lanes zero = all(0), one = all(1);
    const Lanes widening = all(widening_), side = all(side_), larger_end = all(widening_ > 0 ? 1 : 0);
    const Lanes3& d = ray.direction;

    // The ball in which the line lies deepest.
    const Lanes axis_along = hn::Div(dot(all(axis_), d), ray.direction_squared);
    const Lanes3 across = subtract(all(axis_), multiply(axis_along, d));
    const Lanes narrowing = hn::Sub(dot(across, across), all(widening_ * widening_));
    const Chord end(*this, ray, zero);
    const Lanes inner = hn::Div(hn::Sub(hn::Mul(end.radius, widening), dot(end.perpendicular, across)), narrowing);
    const Lanes deepest = hn::IfThenElse(hn::Gt(narrowing, zero), clamped(inner), larger_end);
    const Chord chord(*this, ray, deepest);
    RootLanes found;
    found.hits = hn::And(hn::Ge(chord.discriminant, zero), hn::Gt(chord.radius, zero));
    if (none(found.hits)) return found;

    // The balls that it enters first and leaves last.
    const LaneMask at_b = hn::Eq(deepest, one);
    const Lanes outward = hn::IfThenElse(at_b, all(-1), one);
    const LaneMask at_end = hn::Or(hn::Eq(deepest, zero), at_b);
    const auto slope_at = [&](const Chord& at)
                              HWY_ATTR { return hn::Sub(hn::Mul(at.radius, widening), dot(at.perpendicular, across)); };
    const Lanes away = hn::Mul(outward, slope_at(chord));
    const Lanes slope = hn::IfThenElse(at_end, hn::IfThenElse(hn::Lt(zero, away), zero, away), zero);
    const Lanes length_along = hn::Mul(hn::Abs(axis_along), hn::Sqrt(ray.direction_squared));
    const Lanes steep = hn::Mul(length_along, hn::Sqrt(chord.discriminant));
    const LaneMask moves = hn::Gt(steep, hn::Sub(zero, slope));
    const LaneMask by_side = hn::And(moves, hn::Ge(narrowing, zero));
    const Lanes bend = hn::Add(hn::Mul(slope, slope), hn::Mul(narrowing, chord.discriminant));
    const Lanes divisor = hn::Sub(hn::Mul(length_along, hn::Sqrt(hn::Mul(side, bend))), hn::Mul(side, slope));
    const Lanes product = hn::Mul(hn::Sub(steep, slope), hn::Add(steep, slope));
    Lanes x = hn::IfThenElse(by_side, hn::Div(product, divisor), zero);
    const LaneMask by_cone = hn::And(found.hits, hn::AndNot(by_side, moves));
    if (HWY_UNLIKELY(!none(by_cone))) {
      const Chord smaller(*this, ray, hn::Sub(one, deepest));
      const Lanes rise = hn::Mul(hn::Sub(zero, outward), slope_at(smaller));
      const Lanes sum = hn::Add(hn::Mul(rise, rise), hn::Mul(narrowing, smaller.discriminant));
      const Lanes of_cone = hn::IfThenElse(hn::Lt(sum, zero), zero, sum);
      const Lanes root = hn::Mul(length_along, hn::Sqrt(hn::Mul(side, of_cone)));
      const Lanes rising =
          hn::Div(hn::Sub(hn::Mul(rise, rise), hn::Mul(hn::Mul(length_along, length_along), smaller.discriminant)),
                  hn::Add(hn::Mul(side, rise), root));
      const Lanes falling = hn::Div(hn::Sub(hn::Mul(side, rise), root), hn::Mul(side, narrowing));
      const Lanes from_smaller = hn::IfThenElse(hn::Gt(rise, zero), rising, falling);
      x = hn::IfThenElse(by_cone, clamped(hn::Sub(one, from_smaller)), x);
    }
    const Lanes below = hn::Sub(deepest, x), above = hn::Add(deepest, x);
    const Lanes s_down = hn::IfThenElse(hn::Lt(below, zero), zero, below);
    const Lanes s_up = hn::IfThenElse(hn::Lt(one, above), one, above);
    const LaneMask along = hn::Gt(axis_along, zero);
    found.s_near = hn::IfThenElse(along, s_down, s_up);
    found.s_far = hn::IfThenElse(along, s_up, s_down);
    const Chord entered(*this, ray, found.s_near), left(*this, ray, found.s_far);
    found.t_near = hn::Sub(entered.t_closest, entered.half(ray));
    found.t_far = hn::Add(left.t_closest, left.half(ray));
    return found;
  }

 private:
  struct Chord {
    Lanes t_closest;
    Lanes3 perpendicular;
    Lanes radius, discriminant;

    HWY_INLINE Chord(const StickForLanes& of, const RayLanes& ray, Lanes s) {
      const Lanes zero = all(0), one = all(1);
      const LaneMask at_b = hn::Eq(s, one), between = hn::And(hn::Gt(s, zero), hn::Lt(s, one));
      const Lanes3 end = subtract(choose(at_b, all(of.stick_.b), all(of.stick_.a)), ray.origin);
      const Lanes of_end = hn::IfThenElse(at_b, all(of.stick_.radius_b), all(of.stick_.radius_a));
      const Lanes3 oc = choose(between, add(end, multiply(s, all(of.axis_))), end);
      radius = hn::IfThenElse(between, hn::Add(of_end, hn::Mul(s, all(of.widening_))), of_end);
      t_closest = hn::Div(dot(oc, ray.direction), ray.direction_squared);
      perpendicular = subtract(oc, multiply(t_closest, ray.direction));
      discriminant = hn::Sub(hn::Mul(radius, radius), dot(perpendicular, perpendicular));
    }
    HWY_INLINE Lanes half(const RayLanes& ray) const {
      const Lanes zero = all(0);
      const Lanes least = hn::IfThenElse(hn::Lt(discriminant, zero), zero, discriminant);
      return hn::Sqrt(hn::Div(least, ray.direction_squared));
    }
  };

  // std::clamp(x, 0.0, 1.0)
  static HWY_INLINE Lanes clamped(Lanes x) {
    const Lanes zero = all(0), one = all(1);
    return hn::IfThenElse(hn::Lt(x, zero), zero, hn::IfThenElse(hn::Lt(one, x), one, x));
  }

  const Stick& stick_;
  Vec3d axis_;
  double widening_, side_;
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_RENDER_QUERY_STICK_ROOTS_INL_H_
