#include "bihive/measure/decisions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <utility>

#include "bihive/base/check.h"
#include "bihive/measure/exact_number.h"

namespace bihive::measure {
namespace {

using Number = ExactNumber;
using Id = std::int64_t;

struct Vector {
  Number x, y, z;
};

Vector between(const Balls& balls, Id from, Id to) {
  const auto difference = [](Vec3d a, Vec3d b) {
    return Vector{Number(b.x) - Number(a.x), Number(b.y) - Number(a.y), Number(b.z) - Number(a.z)};
  };
  const Vector of_centres = difference(balls.centre[from], balls.centre[to]);
  if (balls.rest.empty()) return of_centres;
  const Vector of_rests = difference(balls.rest[from], balls.rest[to]);
  return {of_centres.x + of_rests.x, of_centres.y + of_rests.y, of_centres.z + of_rests.z};
}
Number dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Number squared_radius(const Balls& balls, Id i) {
  const Number radius(balls.radius[i]);
  return radius * radius;
}

// With a point x relative to c_i, sphere i is x.x = w, and the plane of sphere j and i is 2 a.x = twice_offset, a the
// vector from c_i to c_j. Ball j is beyond the plane.
struct Plane {
  Vector a;
  Number aa;
  Number twice_offset;
};
Plane plane_of(const Balls& balls, Id i, Id j) {
  Plane plane;
  plane.a = between(balls, i, j);
  plane.aa = dot(plane.a, plane.a);
  plane.twice_offset = plane.aa + (squared_radius(balls, i) - squared_radius(balls, j));
  return plane;
}
// How twice_offset grows with the amount by which the squared radius of ball m is smaller: -1, 0 or 1.
double growth_of_offset(Id i, Id j, Id m) {
  return m == j ? 1.0 : m == i ? -1.0 : 0.0;
}

// c_0 + c_1 d + c_2 d^2 for an infinitesimal d > 0.
template <std::size_t kTerms>
int sign_of(const std::array<Number, kTerms>& polynomial) {
  for (const Number& coefficient : polynomial)
    if (coefficient.sign() != 0) return coefficient.sign();
  return 0;
}

// The sign of p + s sqrt(q) r, where q is positive for infinitesimal d; p and q are polynomials in d.
int sign_with_root(const std::array<Number, 2>& p, const std::array<Number, 3>& q, const Number& r, int s) {
  const int of_p = sign_of(p), of_r = s * r.sign();
  if (of_r == 0) return of_p;
  if (of_p == 0 || of_p == of_r) return of_r;
  const Number rr = r * r;
  // The constant terms decide nearly always.
  const Number constant = p[0] * p[0] - q[0] * rr;
  const int order =
      constant.sign() != 0
          ? constant.sign()
          : sign_of(std::array<Number, 2>{Number(2.0) * p[0] * p[1] - q[1] * rr, p[1] * p[1] - q[2] * rr});
  return order > 0 ? of_p : order < 0 ? of_r : 0;
}

// Three balls; everything is relative to c_i.
struct ThreeBalls {
  Plane j, k;
  Number ab, w;
  Number normal_squared;  // of a x b

  ThreeBalls(const Balls& balls, Id i, Id with_j, Id with_k)
      : j(plane_of(balls, i, with_j)), k(plane_of(balls, i, with_k)), ab(dot(j.a, k.a)), w(squared_radius(balls, i)) {
    normal_squared = j.aa * k.aa - ab * ab;
  }

  // Four times the squared volume, up to a factor, of the tetrahedron that the centres form with a common point: above
  // 0 where the spheres meet. The same for every order of the balls.
  Number meeting() const {
    const Number &A = j.twice_offset, &B = k.twice_offset;
    return Number(4.0) * w * normal_squared - (A * A * k.aa - Number(2.0) * A * B * ab + B * B * j.aa);
  }
  // The same as a polynomial in the amount by which ball m shrinks.
  std::array<Number, 3> meeting_of(Id i, Id with_j, Id with_k, Id m) const {
    const Number &A = j.twice_offset, &B = k.twice_offset;
    const Number A1(growth_of_offset(i, with_j, m)), B1(growth_of_offset(i, with_k, m));
    Number linear = -(Number(2.0) * (A * A1 * k.aa - (A * B1 + A1 * B) * ab + B * B1 * j.aa));
    if (m == i) linear = linear - Number(4.0) * normal_squared;
    return {meeting(), linear, -(A1 * A1 * k.aa - Number(2.0) * A1 * B1 * ab + B1 * B1 * j.aa)};
  }
  // Above 0 where the middle of the circle of i and j is beyond the plane of i and k.
  Number depth() const { return j.twice_offset * ab - k.twice_offset * j.aa; }
};

// Whether ball l is equal to one of the others: the one that shrinks more then lies in the other one.
std::optional<Id> equal_to(const Balls& balls, std::initializer_list<Id> ids, Id l) {
  for (const Id i : ids)
    if (balls.are_equal(i, l)) return i;
  return std::nullopt;
}

Id most_perturbed(const Balls& balls, std::initializer_list<Id> ids) {
  return *std::min_element(ids.begin(), ids.end(), [&](Id a, Id b) { return balls.shrinks_more(a, b); });
}

Vec3d rounded(const Vector& v) {
  return {v.x.to_double(), v.y.to_double(), v.z.to_double()};
}

}  // namespace

TwoBalls exact_relation(const Balls& balls, Id i, Id j) {
  const Number r(balls.radius[i]), s(balls.radius[j]);
  const Vector exact = between(balls, i, j);
  const Number squared = dot(exact, exact);
  // Touching balls do not cross: those that shrink more are smaller.
  const Number sum = r + s, difference = r - s;
  if ((squared - sum * sum).sign() >= 0) return TwoBalls::apart;
  if ((squared - difference * difference).sign() > 0) return TwoBalls::cross;
  return balls.shrinks_more(i, j) ? TwoBalls::first_in_second : TwoBalls::second_in_first;
}

bool circle_meets(const Balls& balls, Id i, Id j, Id k) {
  const int sign = ThreeBalls(balls, i, j, k).meeting().sign();
  if (sign != 0) return sign > 0;
  // The three touch in a point, or share a circle. The ball that shrinks most decides: the circle of the others gets
  // into it only if it touched it from within.
  const Id m = most_perturbed(balls, {i, j, k});
  if (m == i) std::swap(i, k);
  if (m == j) std::swap(j, k);
  return ThreeBalls(balls, i, j, k).depth().sign() > 0;
}

bool circle_in_ball(const Balls& balls, Id i, Id j, Id k) {
  if (const auto equal = equal_to(balls, {i, j}, k)) return balls.shrinks_more(*equal, k);
  const ThreeBalls three(balls, i, j, k);
  const int sign = three.depth().sign();
  if (sign != 0) return sign > 0;
  // All of the circle lies on sphere k, and the centres are on a line.
  const Id m = most_perturbed(balls, {i, j, k});
  if (m == k) return false;
  if (m == j) return three.ab.sign() > 0;
  return (three.j.aa - three.ab).sign() > 0;
}

bool point_in_ball(const Balls& balls, Id i, Id j, Id k, int side, Id l) {
  if (const auto equal = equal_to(balls, {i, j, k}, l)) return balls.shrinks_more(*equal, l);
  const ThreeBalls three(balls, i, j, k);
  const Plane last = plane_of(balls, i, l);
  const Number ac = dot(three.j.a, last.a), bc = dot(three.k.a, last.a);
  const Number volume = dot(cross(three.j.a, three.k.a), last.a);
  // How far the point is beyond the plane of i and l, up to a positive factor.
  const auto rational = [&](const Number& A, const Number& B, const Number& C) {
    return (A * three.k.aa - B * three.ab) * ac + (B * three.j.aa - A * three.ab) * bc - C * three.normal_squared;
  };
  const Id m = most_perturbed(balls, {i, j, k, l});
  std::array<Number, 2> p{rational(three.j.twice_offset, three.k.twice_offset, last.twice_offset), Number()};
  std::array<Number, 3> q{three.meeting(), Number(), Number()};
  // Without perturbation first.
  const int of_p = p[0].sign(), of_r = side * volume.sign();
  if (of_p != 0 && q[0].sign() > 0 && (of_r == 0 || of_p == of_r)) return of_p > 0;
  p[1] =
      rational(Number(growth_of_offset(i, j, m)), Number(growth_of_offset(i, k, m)), Number(growth_of_offset(i, l, m)));
  q = three.meeting_of(i, j, k, m);
  const int sign = sign_with_root(p, q, volume, side);
  if (sign != 0) return sign > 0;
  // Sphere l shares a circle with two of the others, and moves with it when ball m shrinks.
  const std::array<std::pair<Id, Id>, 3> pairs{{{i, j}, {i, k}, {j, k}}};
  for (const auto& [first, second] : pairs)
    if (!circle_meets(balls, first, second, l)) return circle_in_ball(balls, first, second, l);
  return false;
}

bool is_after_middle(const Balls& balls, Id i, Id j, Id k, Id l, int side) {
  // The point of i, j and l is t c + s n' beyond the axis, up to a positive factor, with n' = a x c. Its volume with
  // the axis a and b tells the side of the plane of the three centres.
  const ThreeBalls with_l(balls, i, j, l);
  const Plane of_k = plane_of(balls, i, k);
  const Number ab = dot(with_l.j.a, of_k.a), bc = dot(of_k.a, with_l.k.a);
  const Number volume = dot(cross(with_l.j.a, of_k.a), with_l.k.a);
  const Id m = most_perturbed(balls, {i, j, l});
  const auto along_c = [&](const Number& A, const Number& C) { return (C * with_l.j.aa - A * with_l.ab) * volume; };
  const std::array<Number, 2> p{along_c(with_l.j.twice_offset, with_l.k.twice_offset),
                                along_c(Number(growth_of_offset(i, j, m)), Number(growth_of_offset(i, l, m)))};
  const Number r = with_l.j.aa * bc - with_l.ab * ab;
  return sign_with_root(p, with_l.meeting_of(i, j, l, m), r, side) > 0;
}

CapAngle accurate_cap(const Balls& balls, Id i, Id j) {
  const Plane plane = plane_of(balls, i, j);
  const Number w = squared_radius(balls, i);
  const double sine2 = (Number(4.0) * plane.aa * w - plane.twice_offset * plane.twice_offset).to_double();
  const double scale = 2 * std::sqrt(plane.aa.to_double()) * balls.radius[i];
  return {plane.twice_offset.to_double() / scale, std::sqrt(std::max(sine2, 0.0)) / scale};
}

AccuratePoint accurate_point(const Balls& balls, Id i, Id j, Id k, int side) {
  const ThreeBalls three(balls, i, j, k);
  const double root = std::sqrt(std::max(three.meeting().to_double(), 0.0));
  const Vec3d normal = normalized(rounded(cross(three.j.a, three.k.a)));
  // In the plane of the circle of i and j: towards c_k, and along the normal.
  const auto on_circle = [&](const Plane& own, const Plane& other) {
    const Number depth = other.twice_offset * own.aa - own.twice_offset * three.ab;
    const Vector towards{own.aa * other.a.x - three.ab * own.a.x, own.aa * other.a.y - three.ab * own.a.y,
                         own.aa * other.a.z - three.ab * own.a.z};
    return depth.to_double() * normalized(rounded(towards)) + (side * root * std::sqrt(own.aa.to_double())) * normal;
  };
  AccuratePoint point;
  point.on_j = on_circle(three.j, three.k);
  point.on_k = on_circle(three.k, three.j);
  point.turn_cosine = (Number(4.0) * three.w * three.ab - three.j.twice_offset * three.k.twice_offset).to_double();
  point.turn_sine = 2 * balls.radius[i] * root;
  return point;
}

Vec3d accurate_towards(const Balls& balls, Id i, Id j, Id k) {
  const Vector a = between(balls, i, j), b = between(balls, i, k);
  const Number aa = dot(a, a), ab = dot(a, b);
  return normalized(rounded({aa * b.x - ab * a.x, aa * b.y - ab * a.y, aa * b.z - ab * a.z}));
}

CapAngle accurate_half_arc(const Balls& balls, Id i, Id j, Id k) {
  const ThreeBalls three(balls, i, j, k);
  const double root = std::sqrt(std::max(three.meeting().to_double(), 0.0));
  return {-three.depth().to_double(), root * std::sqrt(three.j.aa.to_double())};
}

}  // namespace bihive::measure
