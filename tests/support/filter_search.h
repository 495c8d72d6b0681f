// Hill climbing for the pair of a ray and a sphere with the largest error of binary32.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>

#include "bihive/geometry/ray.h"
#include "bihive/wide/trace/filter_bounds.h"
#include "support/effort.h"
#include "support/scenes.h"

namespace bihive::test {

using Real = long double;

/// A ray and a sphere, in stored units: no bound of the sphere is beyond 1.
struct RayAndSphere {
  Ray ray;
  Vec3f centre;
  float radius;

  float& number(int i) {
    if (i < 3) return ray.origin[i];
    if (i < 6) return ray.direction[i - 3];
    return i < 9 ? centre[i - 6] : radius;
  }
  bool allowed() const {
    bool inside = is_valid(ray) && radius > 0;
    for (int k = 0; k < 3; ++k) inside = inside && std::abs(centre[k]) + radius <= 1;
    return inside;
  }
};

/// The line and its two roots in long double, as distances from the local origin.
struct Truth {
  Real b, p, shift, length;
  bool meets;
  Real s_near, s_far;

  explicit Truth(const RayAndSphere& pair) {
    Real o[3], d[3], dd = 0;
    Real farthest = 0;
    for (int k = 0; k < 3; ++k) {
      o[k] = Real(pair.ray.origin[k]);
      d[k] = Real(pair.ray.direction[k]);
      dd += d[k] * d[k];
      farthest = std::max(farthest, std::abs(o[k]));
    }
    length = std::sqrt(dd);
    Real along = 0;
    for (int k = 0; k < 3; ++k) along += o[k] * d[k] / length;
    shift = farthest > Real(kFarOrigin) ? -along : 0;
    Real oc[3];
    b = 0;
    for (int k = 0; k < 3; ++k) {
      oc[k] = Real(pair.centre[k]) - (o[k] + shift * d[k] / length);
      b += oc[k] * d[k] / length;
    }
    Real pp = 0;
    for (int k = 0; k < 3; ++k) {
      const Real component = oc[k] - b * d[k] / length;
      pp += component * component;
    }
    p = std::sqrt(pp);
    const Real discriminant = Real(pair.radius) * Real(pair.radius) - pp;
    meets = discriminant >= 0;
    const Real half = std::sqrt(std::max(Real(0), discriminant));
    s_near = b - half;
    s_far = b + half;
  }
};

/// Starting points: from near and far, past the silhouette by little or much, with sizes of all kinds, also along axes.
inline RayAndSphere random_pair(SplitMix64& rng) {
  RayAndSphere pair;
  do {
    const double reach = rng.next_below(4) == 0 ? log_uniform(rng, 8, 1e6) : log_uniform(rng, 0.01, 8);
    const double radius = log_uniform(rng, 1e-7, 1);
    Vec3d centre, ahead, aside;
    for (int k = 0; k < 3; ++k) {
      centre[k] = uniform(rng, -1, 1) * (1 - radius) * (rng.next_below(3) == 0 ? 1e-3 : 1);
      ahead[k] = rng.next_below(8) == 0 ? 0 : uniform(rng, -1, 1);
      aside[k] = uniform(rng, -1, 1);
    }
    Vec3d origin = centre + ahead * reach;
    // A corner of the space that needs no moved origin, seen from the opposite corner: all errors are largest there.
    if (rng.next_below(3) == 0)
      for (int k = 0; k < 3; ++k) {
        const double sign = rng.next_below(2) == 0 ? 1 : -1;
        origin[k] = sign * kFarOrigin * uniform(rng, 0.9, 1);
        centre[k] = -sign * (1 - radius) * uniform(rng, 0.9, 1);
      }
    const double offset = radius * (rng.next_below(2) == 0 ? 1 : uniform(rng, 0, 1.1));
    const Vec3d target = centre + aside * (offset / std::max(1e-3, length(aside)));
    pair.ray.origin = to_float(origin);
    pair.ray.direction = to_float((target - to_double(pair.ray.origin)) * log_uniform(rng, 1e-3, 1e3));
    pair.centre = to_float(centre);
    pair.radius = static_cast<float>(radius);
  } while (!pair.allowed());
  return pair;
}

/// A neighbour: one number moved by up to 2^24 units in the last place.
inline RayAndSphere moved(RayAndSphere pair, SplitMix64& rng) {
  float& number = pair.number(static_cast<int>(rng.next_below(10)));
  const float magnitude = std::abs(number);
  const double ulp = std::nextafter(magnitude, HUGE_VALF) - magnitude;
  const double steps = std::ldexp(1, static_cast<int>(rng.next_below(24)));
  number = static_cast<float>(number + (rng.next_below(2) == 0 ? steps : -steps) * ulp);
  return pair;
}

/// The largest value of `used` found; NaN counts as -inf. BIHIVE_LONG=N in the environment starts N times as often. If
/// tests do less (effort.h) it starts less often.
inline double most_used(const std::function<double(const RayAndSphere&)>& used, std::uint64_t usual_starts = 3000) {
  const char* const number = std::getenv("BIHIVE_LONG");
  // With many starts a quarter of them suffices to come nearly as close to the bounds; with few it does not.
  const std::uint64_t share = ray_share() > 1 && usual_starts >= 1000 ? 4 : 1;
  const std::uint64_t starts = usual_starts * (number == nullptr ? 1 : std::strtoull(number, nullptr, 10)) / share;
  const auto value_of = [&](const RayAndSphere& pair) {
    const double value = pair.allowed() ? used(pair) : -HUGE_VAL;
    return std::isnan(value) ? -HUGE_VAL : value;
  };
  double most = -HUGE_VAL;
  for (std::uint64_t start = 1; start <= starts; ++start) {
    SplitMix64 rng(start);
    RayAndSphere pair = random_pair(rng);
    double best = value_of(pair);
    for (int step = 0; step < 600; ++step) {
      const RayAndSphere next = moved(pair, rng);
      const double value = value_of(next);
      if (!(value >= best)) continue;
      best = value;
      pair = next;
    }
    most = std::max(most, best);
  }
  return most;
}

/// A bound holds, and is at most 1 / `tight` times the largest value found.
inline void expect_used(const std::string& what, double most, double tight) {
  testing::Test::RecordProperty(what, std::to_string(most));
  std::printf("  %s: %.3f of the bound is used\n", what.c_str(), most);
  EXPECT_LT(most, 1) << what << ": the bound does not hold";
  EXPECT_GT(most, tight) << what << ": the bound is loose, or the search is poor";
}

}  // namespace bihive::test
