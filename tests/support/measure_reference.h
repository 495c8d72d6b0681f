// Measures of a union of few balls in 384 bits, with balls that are really smaller, and its holes by another way.
//
// Every squared radius is smaller by an amount of about 2^-120, those of equal balls and of smaller ones by more: the
// rule of measure/decisions.h, with numbers. So nothing touches, no four spheres meet in a point, and every decision is
// the sign of a number that 384 bits know. Areas and volumes are those of the limit up to about 2^-60 of a sphere's.
//
// Solid angles are by Gauss and Bonnet, from arcs that are found by trying every ball at every point. Connected parts
// and cavities are Betti numbers of the balls' nerve: which two, three and four balls have a common point.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "bihive/base/check.h"
#include "bihive/math/rng.h"
#include "bihive/measure/balls.h"

namespace bihive::test {

constexpr int kMostReferenceBalls = 14;

namespace reference {

using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<384, boost::multiprecision::digit_base_2>,
                                  boost::multiprecision::et_off>;

struct Vector {
  Real x, y, z;

  friend Vector operator+(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vector operator*(const Real& s, const Vector& a) { return {s * a.x, s * a.y, s * a.z}; }
};
inline Real dot(const Vector& a, const Vector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Ball {
  Vector centre;
  Real w;  // squared radius
};

inline const Real& pi() {
  static const Real value = 4 * boost::multiprecision::atan(Real(1));
  return value;
}

inline std::vector<Ball> shrunk(const measure::Balls& balls) {
  std::vector<std::int64_t> order(static_cast<std::size_t>(balls.size()));
  std::iota(order.begin(), order.end(), std::int64_t{0});
  std::sort(order.begin(), order.end(), [&](std::int64_t i, std::int64_t j) { return balls.shrinks_more(j, i); });
  std::vector<Ball> made(order.size());
  SplitMix64 rng(41);
  for (std::size_t n = 0; n < order.size(); ++n) {
    const std::int64_t i = order[n];
    const Vec3d c = balls.centre[i];
    const Real r(balls.radius[i]);
    const Real amount =
        boost::multiprecision::ldexp(Real(1 + (double(n) + rng.next_double()) / double(order.size())), -120);
    made[static_cast<std::size_t>(i)] = {{Real(c.x), Real(c.y), Real(c.z)}, r * r - amount};
  }
  return made;
}

// --- Solid angles -------------------------------------------------------------------------------------------------

// What ball k leaves of the sphere's unit sphere: x.axis <= c.
struct Cap {
  std::size_t ball;
  Vector axis;
  Real c, s;
  Vector e1, e2;  // across the axis
};

// Where the circle of one cap begins to be exposed, or ends, at another one.
struct End {
  std::size_t other;  // cap
  Real cosine, sine;  // on the circle
  Real angle;
};

struct Part {
  Real solid_angle = 0;
  Vector outwards{0, 0, 0};
};

inline Vector any_across(const Vector& a) {
  const Real x = abs(a.x), y = abs(a.y), z = abs(a.z);
  const Vector along = x <= y && x <= z ? Vector{1, 0, 0} : y <= z ? Vector{0, 1, 0} : Vector{0, 0, 1};
  const Vector n = cross(a, along);
  return (1 / sqrt(dot(n, n))) * n;
}

// The caps of sphere i; none at all: another ball contains it.
inline std::optional<std::vector<Cap>> caps_of(const std::vector<Ball>& balls, std::size_t i) {
  std::vector<Cap> caps;
  const Real r = sqrt(balls[i].w);
  for (std::size_t j = 0; j < balls.size(); ++j) {
    if (j == i) continue;
    const Vector a = balls[j].centre - balls[i].centre;
    const Real d2 = dot(a, a);
    if (d2 == 0) {
      if (balls[j].w > balls[i].w) return std::nullopt;
      continue;
    }
    const Real p = (d2 + balls[i].w - balls[j].w) / 2;
    if (p * p >= balls[i].w * d2) {
      if (p < 0) return std::nullopt;
      continue;
    }
    const Real d = sqrt(d2);
    Cap cap{j, (1 / d) * a, p / (d * r), 0, {}, {}};
    cap.s = sqrt(1 - cap.c * cap.c);
    cap.e1 = any_across(cap.axis);
    cap.e2 = cross(cap.axis, cap.e1);
    caps.push_back(cap);
  }
  return caps;
}

// What one cap covers of another one's circle: b1 cosine + b2 sine > t.
struct Cover {
  Real b1, b2, t;

  Cover(const Cap& own, const Cap& other)
      : b1(own.s * dot(other.axis, own.e1)),
        b2(own.s * dot(other.axis, own.e2)),
        t(other.c - own.c * dot(other.axis, own.axis)) {}
  bool covers(const End& end) const { return b1 * end.cosine + b2 * end.sine > t; }
};

inline Part part_of(const std::vector<Ball>& balls, std::size_t i) {
  const std::optional<std::vector<Cap>> found = caps_of(balls, i);
  if (!found) return {};
  const std::vector<Cap>& caps = *found;
  Part part;
  if (caps.empty()) {
    part.solid_angle = 4 * pi();
    return part;
  }
  Real curvature = 0, turns = 0;
  int cycles = 0, arcs = 0;
  // An exposed arc of circle j ends where cap k begins to cover it; there an arc of circle k starts. The end of arc
  // (j, k): the start of an arc by its own caps (k, j).
  struct Arc {
    std::size_t circle, starts_at, ends_at;  // caps
  };
  std::vector<Arc> all;
  for (std::size_t j = 0; j < caps.size(); ++j) {
    const Cap& own = caps[j];
    std::vector<Cover> covers;
    std::vector<std::size_t> cap_of;
    bool all_covered = false;
    std::vector<End> starts, ends;
    for (std::size_t k = 0; k < caps.size() && !all_covered; ++k) {
      if (k == j) continue;
      const Cover cover(own, caps[k]);
      const Real r2 = cover.b1 * cover.b1 + cover.b2 * cover.b2;
      if (cover.t * cover.t >= r2) {
        all_covered = cover.t < 0;
        continue;
      }
      covers.push_back(cover);
      cap_of.push_back(k);
    }
    if (all_covered) continue;
    for (std::size_t n = 0; n < covers.size(); ++n) {
      const Cover& cover = covers[n];
      const Real r2 = cover.b1 * cover.b1 + cover.b2 * cover.b2, root = sqrt(r2 - cover.t * cover.t);
      for (const int side : {-1, 1}) {
        End end{cap_of[n], (cover.t * cover.b1 - side * root * cover.b2) / r2,
                (cover.t * cover.b2 + side * root * cover.b1) / r2, 0};
        bool covered = false;
        for (std::size_t m = 0; m < covers.size() && !covered; ++m) covered = m != n && covers[m].covers(end);
        if (covered) continue;
        end.angle = atan2(end.sine, end.cosine);
        (side > 0 ? starts : ends).push_back(end);
      }
    }
    BIHIVE_CHECK(starts.size() == ends.size());
    Real length = 0;
    Real cosines = 0, sines = 0;  // of ends less those of starts
    if (covers.empty() || starts.empty()) {
      if (!covers.empty()) continue;  // they cover it together
      length = 2 * pi();
      ++cycles;
    }
    ++arcs;
    for (const End& start : starts) {
      const End* next = nullptr;
      Real nearest = 0;
      for (const End& end : ends) {
        Real angle = end.angle - start.angle;
        if (angle < 0) angle += 2 * pi();
        if (next != nullptr && angle >= nearest) continue;
        next = &end;
        nearest = angle;
      }
      length += nearest;
      cosines += next->cosine - start.cosine;
      sines += next->sine - start.sine;
      all.push_back({j, start.other, next->other});
      // At the arc's end the boundary turns from one circle to the other.
      const Cap& other = caps[next->other];
      const Real t = dot(own.axis, other.axis) - own.c * other.c, product = own.s * other.s;
      turns += atan2(sqrt(product * product - t * t), t);
    }
    curvature += own.c * length;
    const Vector chord = cosines * own.e1 + sines * own.e2;
    part.outwards =
        part.outwards - (own.s * own.s * length / 2) * own.axis - (own.c * own.s / 2) * cross(own.axis, chord);
  }
  if (arcs == 0) return {};
  std::vector<bool> taken(all.size(), false);
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (taken[n]) continue;
    ++cycles;
    for (std::size_t at = n; !taken[at];) {
      taken[at] = true;
      const auto next = std::find_if(all.begin(), all.end(), [&](const Arc& arc) {
        return arc.circle == all[at].ends_at && arc.starts_at == all[at].circle;
      });
      BIHIVE_CHECK(next != all.end());
      at = static_cast<std::size_t>(next - all.begin());
    }
  }
  const Real known = curvature - turns - 2 * pi() * cycles;
  part.solid_angle = known - 4 * pi() * floor(known / (4 * pi()));
  return part;
}

// --- Betti numbers ------------------------------------------------------------------------------------------------

// The least, over all points, of the greatest power distance to some balls: below 0 if they have a common point.
inline bool have_common_point(const std::vector<Ball>& balls, const std::vector<int>& ids) {
  const auto count = static_cast<int>(ids.size());
  for (int subset = 1; subset < 1 << count; ++subset) {
    std::vector<int> in;
    for (int n = 0; n < count; ++n)
      if ((subset >> n & 1) != 0) in.push_back(ids[static_cast<std::size_t>(n)]);
    // The point of equal power in the span of their centres: c_0 + sum of l_n a_n, with a_m . sum = q_m.
    const Ball& first = balls[static_cast<std::size_t>(in[0])];
    const std::size_t m = in.size() - 1;
    std::array<Vector, 3> a;
    std::array<Real, 3> q, l;
    for (std::size_t n = 0; n < m; ++n) {
      const Ball& other = balls[static_cast<std::size_t>(in[n + 1])];
      a[n] = other.centre - first.centre;
      q[n] = (dot(a[n], a[n]) + first.w - other.w) / 2;
    }
    // By Cramer's rule.
    std::array<std::array<Real, 3>, 3> g;
    for (std::size_t r = 0; r < m; ++r)
      for (std::size_t c = 0; c < m; ++c) g[r][c] = dot(a[r], a[c]);
    const auto determinant = [m](const std::array<std::array<Real, 3>, 3>& of) -> Real {
      if (m == 0) return 1;
      if (m == 1) return of[0][0];
      if (m == 2) return of[0][0] * of[1][1] - of[0][1] * of[1][0];
      return of[0][0] * (of[1][1] * of[2][2] - of[1][2] * of[2][1]) -
             of[0][1] * (of[1][0] * of[2][2] - of[1][2] * of[2][0]) +
             of[0][2] * (of[1][0] * of[2][1] - of[1][1] * of[2][0]);
    };
    const Real whole = determinant(g);
    if (abs(whole) < boost::multiprecision::ldexp(Real(1), -260)) continue;  // they depend on each other
    Real rest = 1;
    bool is_convex = true;
    Vector point = first.centre;
    for (std::size_t n = 0; n < m; ++n) {
      std::array<std::array<Real, 3>, 3> replaced = g;
      for (std::size_t r = 0; r < m; ++r) replaced[r][n] = q[r];
      l[n] = determinant(replaced) / whole;
      rest -= l[n];
      is_convex = is_convex && l[n] >= 0;
      point = point + l[n] * a[n];
    }
    if (!is_convex || rest < 0) continue;
    const auto power = [&](const Ball& ball) -> Real {
      const Vector from = point - ball.centre;
      return dot(from, from) - ball.w;
    };
    const Real value = power(first);
    bool is_greatest = true;
    for (const int id : ids)
      is_greatest = is_greatest && (std::find(in.begin(), in.end(), id) != in.end() ||
                                    power(balls[static_cast<std::size_t>(id)]) <= value);
    if (is_greatest) return value < 0;
  }
  BIHIVE_CHECK(false);  // one of the subsets determines it
  return false;
}

constexpr std::size_t kMostTriples = 364;  // of 14
using Row = std::bitset<kMostTriples>;

inline int rank_of(std::vector<Row> rows) {
  int rank = 0;
  for (std::size_t column = 0; column < kMostTriples; ++column) {
    const auto pivot = std::find_if(rows.begin() + rank, rows.end(), [column](const Row& row) { return row[column]; });
    if (pivot == rows.end()) continue;
    std::swap(*pivot, rows[static_cast<std::size_t>(rank)]);
    const Row own = rows[static_cast<std::size_t>(rank)];
    for (std::size_t n = static_cast<std::size_t>(rank) + 1; n < rows.size(); ++n)
      if (rows[n][column]) rows[n] ^= own;
    ++rank;
  }
  return rank;
}

struct Holes {
  int components, cavities;
};

inline Holes holes_of(const std::vector<Ball>& balls) {
  const auto n = static_cast<int>(balls.size());
  std::vector<std::vector<int>> simplices[4];
  for (int i = 0; i < n; ++i) simplices[0].push_back({i});
  std::vector<std::vector<Row>> boundaries(4);
  for (std::size_t k = 1; k < 4; ++k)
    for (const std::vector<int>& face : simplices[k - 1])
      for (int i = face.back() + 1; i < n; ++i) {
        std::vector<int> simplex = face;
        simplex.push_back(i);
        Row row;
        bool has_faces = true;
        for (std::size_t out = 0; out <= k && has_faces; ++out) {
          std::vector<int> without = simplex;
          without.erase(without.begin() + static_cast<std::ptrdiff_t>(out));
          const auto& of_faces = simplices[k - 1];
          const auto found = std::lower_bound(of_faces.begin(), of_faces.end(), without);
          has_faces = found != of_faces.end() && *found == without;
          if (has_faces) row.set(static_cast<std::size_t>(found - of_faces.begin()));
        }
        if (!has_faces || !have_common_point(balls, simplex)) continue;
        simplices[k].push_back(std::move(simplex));
        boundaries[k].push_back(row);
      }
  const int triples = static_cast<int>(simplices[2].size());
  return {n - rank_of(boundaries[1]), triples - rank_of(boundaries[2]) - rank_of(boundaries[3])};
}

}  // namespace reference

struct ReferenceMeasures {
  std::vector<reference::Part> parts;  ///< of each ball
  reference::Real area = 0, volume = 0;
};

inline ReferenceMeasures reference_measures(const measure::Balls& balls) {
  const std::vector<reference::Ball> own = reference::shrunk(balls);
  ReferenceMeasures measures;
  for (std::size_t i = 0; i < own.size(); ++i) {
    const reference::Part part = reference::part_of(own, i);
    const reference::Real r = balls.radius[i];
    measures.area += r * r * part.solid_angle;
    measures.volume += r * r * (r * part.solid_angle + reference::dot(own[i].centre, part.outwards)) / 3;
    measures.parts.push_back(part);
  }
  return measures;
}

/// Connected parts and cavities of the union, those of volume 0 too.
inline reference::Holes reference_holes(const measure::Balls& balls) {
  BIHIVE_CHECK(balls.size() <= kMostReferenceBalls);
  return reference::holes_of(reference::shrunk(balls));
}

}  // namespace bihive::test
