// The scalar truth of the intersection of a ray and a stick: one fixed sequence of binary64 operations.
//
// A stick is a swept sphere: all balls between two ends, whose centres and radii change evenly from one to the other.
// It is a capsule if both radii are equal, a cone with round ends if they differ. So a point of its surface lies on one
// of its balls, at the parameter s from 0 to 1 along the axis, and a ray enters the stick where it enters the first of
// them. The ball decides the hit, in the perpendicular form of geometry/sphere.h: at s = 0 and s = 1 the roots are
// those of the spheres there, bit for bit, and nothing divides the ends from the side. docs/precision.md has the
// derivation.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// Centres and radii of its ends, in stored units. If one end lies in the other, the stick is that larger ball.
struct Stick {
  Vec3d a, b;
  double radius_a, radius_b;

  friend bool operator==(const Stick& one, const Stick& other) {
    return one.a == other.a && one.b == other.b && one.radius_a == other.radius_a && one.radius_b == other.radius_b;
  }

  /// The same body: the ends may be swapped.
  bool coincides(const Stick& other) const { return *this == other || Stick{b, a, radius_b, radius_a} == other; }
};

/// The two parameters at which the whole line meets a stick, t_near <= t_far, and of the balls whose surface it meets
/// there the position along the axis; NaN in all if the line misses the stick.
struct StickRoots {
  double t_near, t_far;
  double s_near, s_far;
};

namespace stick_detail {

/// The ball at s as a line sees it: sphere_roots() before the root.
struct Chord {
  double t_closest;
  Vec3d perpendicular;
  double radius, discriminant;

  Chord(const ScaledRay& ray, const Stick& stick, double s) {
    // The ends are exact.
    Vec3d oc = (s == 1 ? stick.b : stick.a) - ray.origin;
    radius = s == 1 ? stick.radius_b : stick.radius_a;
    if (s > 0 && s < 1) {
      oc = oc + s * (stick.b - stick.a);
      radius = radius + s * (stick.radius_b - stick.radius_a);
    }
    t_closest = dot(oc, ray.direction) / ray.direction_squared;
    perpendicular = oc - t_closest * ray.direction;
    discriminant = radius * radius - dot(perpendicular, perpendicular);
  }

  /// A ball that the line must meet: rounding may have moved it a little away.
  double half(const ScaledRay& ray) const { return std::sqrt(std::max(discriminant, 0.0) / ray.direction_squared); }
};

}  // namespace stick_detail

/// `stick` in the ray's (stored) units. A stick whose radii are both 0 is never hit.
inline StickRoots stick_roots(const ScaledRay& ray, const Stick& stick) {
  using stick_detail::Chord;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();

  // Without a side the stick is its larger ball.
  const Vec3d axis = stick.b - stick.a;
  const double widening = stick.radius_b - stick.radius_a;
  const double side = dot(axis, axis) - widening * widening;
  const double larger_end = widening > 0 ? 1 : 0;
  if (!(side > 0)) {
    const SphereRoots roots =
        sphere_roots(ray, larger_end == 1 ? stick.b : stick.a, larger_end == 1 ? stick.radius_b : stick.radius_a);
    return {roots.t_near, roots.t_far, larger_end, larger_end};
  }

  // Look along the ray: the balls are discs in a plane across it. Find the one in which the line lies deepest.
  const double axis_along = dot(axis, ray.direction) / ray.direction_squared;
  const Vec3d across = axis - axis_along * ray.direction;
  const double narrowing = dot(across, across) - widening * widening;
  double deepest = larger_end;
  if (narrowing > 0) {
    const Chord end(ray, stick, 0);
    deepest = std::clamp((end.radius * widening - dot(end.perpendicular, across)) / narrowing, 0.0, 1.0);
  }
  const Chord chord(ray, stick, deepest);
  if (!(chord.discriminant >= 0) || !(chord.radius > 0)) return {nan, nan, nan, nan};

  // From there, the ball that the line enters first lies towards its origin, and the one that it leaves last away from
  // it: x lengths of the axis away, where the root of the ball changes no more. Between the ends both move; at an end
  // the other one would leave the stick. `slope` is half the derivative of the discriminant away from that end, where
  // it cannot rise.
  const auto slope_at = [&](const Chord& at) { return at.radius * widening - dot(at.perpendicular, across); };
  const double outward = deepest == 1 ? -1 : 1;
  const bool at_end = deepest == 0 || deepest == 1;
  const double slope = at_end ? std::min(outward * slope_at(chord), 0.0) : 0;
  const double length_along = std::abs(axis_along) * std::sqrt(ray.direction_squared);
  const double steep = length_along * std::sqrt(chord.discriminant);
  double x = 0;
  if (steep > -slope && narrowing >= 0) {
    const double bend = slope * slope + narrowing * chord.discriminant;
    x = (steep - slope) * (steep + slope) / (length_along * std::sqrt(side * bend) - side * slope);
  } else if (steep > -slope) {
    // The line goes along a cone: the same root as seen from the smaller end, where no almost equal numbers are
    // subtracted towards the tip.
    const Chord smaller(ray, stick, 1 - deepest);
    const double rise = -outward * slope_at(smaller);
    const double bend = std::max(rise * rise + narrowing * smaller.discriminant, 0.0);
    const double root = length_along * std::sqrt(side * bend);
    const double from_smaller =
        rise > 0 ? (rise * rise - length_along * length_along * smaller.discriminant) / (side * rise + root)
                 : (side * rise - root) / (side * narrowing);
    x = std::clamp(1 - from_smaller, 0.0, 1.0);
  }
  const double s_down = std::max(deepest - x, 0.0), s_up = std::min(deepest + x, 1.0);
  const double s_near = axis_along > 0 ? s_down : s_up, s_far = axis_along > 0 ? s_up : s_down;
  const Chord entered(ray, stick, s_near), left(ray, stick, s_far);
  return {entered.t_closest - entered.half(ray), left.t_closest + left.half(ray), s_near, s_far};
}

/// Whether the ray's line passes the drawn out axis of a stick so far away that it surely misses the stick. It spares
/// most rays near a stick the work of stick_roots(), and says nothing if it returns false.
inline bool surely_misses(const ScaledRay& ray, const Stick& stick) {
  const Vec3d axis = stick.b - stick.a, oc = stick.a - ray.origin;
  const Vec3d normal = cross(ray.direction, axis);
  const double largest = std::max(stick.radius_a, stick.radius_b);
  // Rounding: less than 2^-46 of these lengths, here and in stick_roots() (docs/precision.md, "Sticks").
  constexpr double kError = 0x1p-40;
  const double lengths = std::sqrt(ray.direction_squared * dot(axis, axis));
  const auto sum_of = [](Vec3d v) { return std::abs(v.x) + std::abs(v.y) + std::abs(v.z); };
  const double reach = sum_of(oc) + sum_of(axis) + largest;
  return std::abs(dot(oc, normal)) > largest * std::sqrt(dot(normal, normal)) + kError * lengths * reach;
}

/// The outward normal, of length 1, at a root `t` of the ray and the stick: away from the centre of the ball whose
/// surface it lies on. At the tip of a cone, which has none, it is turned against the ray.
inline Vec3d stick_normal(const ScaledRay& ray, const Stick& stick, double t) {
  const StickRoots roots = stick_roots(ray, stick);
  const double s = t == roots.t_near ? roots.s_near : roots.s_far;
  Vec3d oc = (s == 1 ? stick.b : stick.a) - ray.origin;
  if (s > 0 && s < 1) oc = oc + s * (stick.b - stick.a);
  const Vec3d outward = t * ray.direction - oc;
  return dot(outward, outward) > 0 ? normalized(outward) : -normalized(ray.direction);
}

/// A ray as sticks meet it: with the surfaces on which it starts. A stick is convex, and so are its balls. A ray that
/// exits a stick outward meets neither it nor the balls at its ends again, which may be ends of other sticks. A ray
/// that exits a sphere does not meet it again as the end of a stick.
struct StickRay {
  ScaledRay ray;
  bool leaves_stick = false;
  Stick left{};  ///< the stick that the ray exits

  bool leaves(const Stick& stick) const { return leaves_stick && stick.coincides(left); }
  /// An end of a stick.
  bool leaves(Vec3d centre, double radius) const {
    if (ray.leaves(centre, radius)) return true;
    if (!leaves_stick || ray.inside) return false;
    return (radius == left.radius_a && centre == left.a) || (radius == left.radius_b && centre == left.b);
  }
};

/// +inf: no hit. `s` is the position along the axis.
struct StickHit {
  double t = std::numeric_limits<double>::infinity();
  double s = 0;
};

/// Where the line of a ray enters and leaves a stick, and which of the two points are hits of the ray.
struct StickPassage {
  StickRoots roots;  ///< NaN: the ray does not meet the stick
  bool enters, exits;
};

/// Where roots_of_line() gives the stick's roots, which are asked for at most once. For the stick that the ray exits:
/// no end counts if the ray goes outward, the farther one only if it goes inside. An end on a ball at the stick's end
/// counts as one of that ball; and a ray that exits this ball outward, from where its surface is that of the stick,
/// exits the stick too.
template <class Roots>
StickPassage stick_passage(const StickRay& of, const Stick& stick, const Roots& roots_of_line) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr StickPassage none{{nan, nan, nan, nan}, false, false};
  const ScaledRay& ray = of.ray;
  const bool own = of.leaves(stick);
  if (own && !ray.inside) return none;
  const bool leaves_a = of.leaves(stick.a, stick.radius_a), leaves_b = of.leaves(stick.b, stick.radius_b);
  if ((leaves_a || leaves_b) && !ray.inside) {
    const Vec3d axis = stick.b - stick.a;
    const double widening = stick.radius_b - stick.radius_a;
    if (leaves_a && dot(ray.origin - stick.a, axis) + stick.radius_a * widening <= 0) return none;
    if (leaves_b && dot(ray.origin - stick.b, axis) + stick.radius_b * widening >= 0) return none;
  }
  const StickRoots roots = roots_of_line();
  const auto on_left_ball = [&](double s) { return (s == 0 && leaves_a) || (s == 1 && leaves_b); };
  return {roots, !own && !on_left_ball(roots.s_near), ray.inside || !on_left_ball(roots.s_far)};
}

inline StickPassage stick_passage(const StickRay& of, const Stick& stick) {
  return stick_passage(of, stick, [&] { return stick_roots(of.ray, stick); });
}

namespace stick_detail {

inline StickHit hit_of(const StickRay& of, const StickPassage& passage) {
  const auto& [roots, enters, exits] = passage;
  const auto in_segment = [&](double t) { return t >= of.ray.t_min && t <= of.ray.t_max; };
  if (in_segment(roots.t_near) && enters) return {roots.t_near, roots.s_near};
  if (in_segment(roots.t_far) && exits) return {roots.t_far, roots.s_far};
  return {};
}

}  // namespace stick_detail

/// The nearer end if it lies in the segment, else the farther one, as for spheres.
inline StickHit stick_hit(const StickRay& of, const Stick& stick) {
  return stick_detail::hit_of(of, stick_passage(of, stick));
}
/// The same where stick_roots() of the ray and the stick are known.
inline StickHit stick_hit(const StickRay& of, const Stick& stick, const StickRoots& roots) {
  return stick_detail::hit_of(of, stick_passage(of, stick, [&] { return roots; }));
}

}  // namespace bihive
