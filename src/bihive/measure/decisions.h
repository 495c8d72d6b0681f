// Exact decisions about balls, and quantities that are accurate where binary64 would cancel.
//
// Degenerate sets are decided by simulation of simplicity [EdelsbrunnerMuecke1990]: every decision is the one for balls
// whose squared radii are smaller by infinitesimal amounts, d_0 >> d_1 >> ..., where d_0 belongs to the ball that
// Balls::shrinks_more() puts first. So balls that touch from outside are apart, a ball that touches a larger one from
// inside lies in it, of equal balls the first contains the others, and no four spheres meet in a point. Areas and
// volumes are the limits for amounts that go to 0.
//
// Three spheres that meet have two common points. Seen from the tip of the normal (c_j - c_i) x (c_k - c_i), balls i, j
// and k follow each other counterclockwise; the point on that side is `side` +1, the other -1. An even permutation of
// i, j and k leaves the side, an odd one changes its sign.
#pragma once

#include <cstdint>

#include "bihive/measure/balls.h"

namespace bihive::measure {

enum class TwoBalls { apart, cross, first_in_second, second_in_first };
TwoBalls exact_relation(const Balls& balls, std::int64_t i, std::int64_t j);

/// The same, where the squared distance of the centres is known: dot() of Balls::between().
inline TwoBalls relation(const Balls& balls, std::int64_t i, std::int64_t j, double distance2) {
  const double r = balls.radius[i], s = balls.radius[j];
  // A relative error of 2^-50 at most in each of the three.
  const double reach2 = (r + s) * (r + s), inner2 = (r - s) * (r - s);
  constexpr double kDoubt = 0x1p-48;
  if (distance2 < reach2 * (1 - kDoubt) && distance2 > inner2 * (1 + kDoubt)) return TwoBalls::cross;
  if (distance2 > reach2 * (1 + kDoubt)) return TwoBalls::apart;
  if (distance2 < inner2 * (1 - kDoubt))
    return balls.shrinks_more(i, j) ? TwoBalls::first_in_second : TwoBalls::second_in_first;
  return exact_relation(balls, i, j);
}
inline TwoBalls relation(const Balls& balls, std::int64_t i, std::int64_t j) {
  const Vec3d a = balls.between(i, j);
  return relation(balls, i, j, dot(a, a));
}

/// i and j cross: whether their circle meets sphere k.
bool circle_meets(const Balls& balls, std::int64_t i, std::int64_t j, std::int64_t k);

/// The same, and the circle does not meet sphere k: whether it lies in ball k.
bool circle_in_ball(const Balls& balls, std::int64_t i, std::int64_t j, std::int64_t k);

/// Spheres i, j and k meet: whether their common point on this side lies in ball l.
bool point_in_ball(const Balls& balls, std::int64_t i, std::int64_t j, std::int64_t k, int side, std::int64_t l);

/// Spheres i, j, k and spheres i, j, l meet: whether the point of i, j, l on this side is counterclockwise, as seen
/// from c_j, of the middle of the arc that ball k covers on the circle of i and j (less than half a turn from it).
bool is_after_middle(const Balls& balls, std::int64_t i, std::int64_t j, std::int64_t k, std::int64_t l, int side);

/// The circle of spheres i and j, as seen from c_i: cosine and sine of the angular radius of the cap that ball j cuts
/// off. Relative errors below 2^-49.
struct CapAngle {
  double cosine, sine;
};
CapAngle accurate_cap(const Balls& balls, std::int64_t i, std::int64_t j);

/// A common point of spheres i, j and k, as seen from c_i. Directions have no unit length; their errors are below 2^-49
/// of it.
struct AccuratePoint {
  Vec3d on_j, on_k;               ///< from the centres of the circles of j and k
  double turn_sine, turn_cosine;  ///< of the angle between the circles, up to a common positive factor
};
AccuratePoint accurate_point(const Balls& balls, std::int64_t i, std::int64_t j, std::int64_t k, int side);

/// On the circle of spheres i and j: sine and cosine of half the arc that ball k covers, up to a common positive
/// factor.
CapAngle accurate_half_arc(const Balls& balls, std::int64_t i, std::int64_t j, std::int64_t k);

/// The unit vector across c_j - c_i that leans towards c_k. The centres must not lie on a line.
Vec3d accurate_towards(const Balls& balls, std::int64_t i, std::int64_t j, std::int64_t k);

}  // namespace bihive::measure
