// Area and volume of a union of few balls by another way than the library's: integrals over latitudes, in long double.
//
// On each sphere, dA = r dphi dz [Archimedes]; at each z, what other balls cover of the circle of latitude are
// intervals of phi. The exposed angle is smooth between the heights at which balls begin and end, circles of two
// spheres have their lowest and highest points, or three spheres meet; at these, it has roots, and near them others may
// lie. So the nodes of the quadrature crowd at both ends of each interval.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "bihive/measure/balls.h"

namespace bihive::test {

struct OracleMeasures {
  long double area = 0, volume = 0;
};

namespace oracle {

using Real = long double;
constexpr Real kPi = std::numbers::pi_v<Real>;

struct Ball {
  Real x, y, z, r;
};

// Nodes and weights on [-1, 1] that crowd at both ends (tanh-sinh quadrature): x = tanh(pi / 2 sinh t).
inline const std::vector<std::pair<Real, Real>>& quadrature() {
  static const std::vector<std::pair<Real, Real>> rule = [] {
    constexpr int kEachSide = 56;
    constexpr Real kStep = 1 / 16.0L;
    std::vector<std::pair<Real, Real>> made;
    for (int i = -kEachSide; i <= kEachSide; ++i) {
      const Real t = kStep * i, u = kPi / 2 * std::sinh(t);
      made.push_back({std::tanh(u), kStep * kPi / 2 * std::cosh(t) / (std::cosh(u) * std::cosh(u))});
    }
    return made;
  }();
  return rule;
}

// The heights between which the exposed angles are smooth.
inline std::vector<Real> heights_of(const std::vector<Ball>& balls) {
  std::vector<Real> heights;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Ball& a = balls[i];
    heights.push_back(a.z - a.r);
    heights.push_back(a.z + a.r);
    for (std::size_t j = i + 1; j < balls.size(); ++j) {
      const Ball& b = balls[j];
      const Real x = b.x - a.x, y = b.y - a.y, z = b.z - a.z, d2 = x * x + y * y + z * z;
      if (d2 == 0) continue;
      const Real along = (d2 + a.r * a.r - b.r * b.r) / (2 * d2), s2 = a.r * a.r - along * along * d2;
      if (s2 < 0) continue;
      const Real up = std::sqrt(s2 * (x * x + y * y) / d2);
      heights.push_back(a.z + along * z - up);
      heights.push_back(a.z + along * z + up);
      for (std::size_t k = j + 1; k < balls.size(); ++k) {
        // Relative to a: p.n = (n.n + a.r^2 - r^2) / 2 for both others.
        const Ball& c = balls[k];
        const Real u = c.x - a.x, v = c.y - a.y, w = c.z - a.z, e2 = u * u + v * v + w * w, g = x * u + y * v + z * w;
        const Real normal2 = d2 * e2 - g * g;
        if (!(normal2 > 1e-14L * d2 * e2)) continue;
        const Real p = (d2 + a.r * a.r - b.r * b.r) / 2, q = (e2 + a.r * a.r - c.r * c.r) / 2;
        const Real of_b = (p * e2 - q * g) / normal2, of_c = (q * d2 - p * g) / normal2;
        const Real fx = of_b * x + of_c * u, fy = of_b * y + of_c * v, fz = of_b * z + of_c * w;
        const Real rest = a.r * a.r - (fx * fx + fy * fy + fz * fz);
        if (rest < 0) continue;
        const Real rise = (x * v - y * u) * std::sqrt(rest / normal2);
        heights.push_back(a.z + fz - rise);
        heights.push_back(a.z + fz + rise);
      }
    }
  }
  std::sort(heights.begin(), heights.end());
  return heights;
}

// Adds what the sphere's circle at this height, of the weight dz, has exposed.
inline void add_circle(const std::vector<Ball>& balls, std::size_t i, Real z, Real weight, OracleMeasures& sums) {
  const Ball& a = balls[i];
  const Real own2 = a.r * a.r - (z - a.z) * (z - a.z);
  if (own2 <= 0) return;
  const Real own = std::sqrt(own2);
  std::vector<std::pair<Real, Real>> covered;
  const auto cover = [&](Real from, Real to) {
    if (from < -kPi) {
      covered.push_back({from + 2 * kPi, kPi});
      from = -kPi;
    }
    if (to > kPi) {
      covered.push_back({-kPi, to - 2 * kPi});
      to = kPi;
    }
    covered.push_back({from, to});
  };
  for (std::size_t j = 0; j < balls.size(); ++j) {
    const Ball& b = balls[j];
    const Real other2 = b.r * b.r - (z - b.z) * (z - b.z);
    if (j == i || other2 <= 0) continue;
    const Real x = b.x - a.x, y = b.y - a.y, d2 = x * x + y * y, d = std::sqrt(d2);
    if (d2 == 0) {
      if (other2 > own2) return;
      continue;
    }
    const Real cosine = (d2 + own2 - other2) / (2 * d * own);
    if (cosine <= -1) return;
    if (cosine >= 1) continue;
    const Real half = std::acos(cosine), middle = std::atan2(y, x);
    cover(middle - half, middle + half);
  }
  std::sort(covered.begin(), covered.end());
  Real angle = 0, cosines = 0, sines = 0, at = -kPi;  // integrals over what is exposed
  const auto expose = [&](Real from, Real to) {
    if (to <= from) return;
    angle += to - from;
    cosines += std::sin(to) - std::sin(from);
    sines += std::cos(from) - std::cos(to);
  };
  for (const auto& [from, to] : covered) {
    expose(at, from);
    at = std::max(at, to);
  }
  expose(at, kPi);
  // x.n r = a.n r + r^2 over the exposed part.
  sums.area += weight * a.r * angle;
  sums.volume += weight / 3 * (own * (a.x * cosines + a.y * sines) + (a.z * (z - a.z) + a.r * a.r) * angle);
}

}  // namespace oracle

/// Equal balls count once.
inline OracleMeasures oracle_measures(const measure::Balls& balls) {
  std::vector<oracle::Ball> own;
  for (std::int64_t i = 0; i < balls.size(); ++i) {
    bool is_new = true;
    for (std::int64_t j = 0; j < i; ++j) is_new = is_new && !balls.are_equal(i, j);
    const Vec3d c = balls.centre[i];
    if (is_new) own.push_back({c.x, c.y, c.z, balls.radius[i]});
  }
  OracleMeasures sums;
  const std::vector<oracle::Real> heights = oracle::heights_of(own);
  for (std::size_t n = 1; n < heights.size(); ++n) {
    const oracle::Real middle = (heights[n] + heights[n - 1]) / 2, half = (heights[n] - heights[n - 1]) / 2;
    if (half < 1e-17L) continue;
    for (const auto& [node, weight] : oracle::quadrature())
      for (std::size_t i = 0; i < own.size(); ++i)
        oracle::add_circle(own, i, middle + half * node, half * weight, sums);
  }
  return sums;
}

}  // namespace bihive::test
