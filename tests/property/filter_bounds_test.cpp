// The bounds of kernels/filter.h: hill climbing for the pair of a ray and a sphere on which the binary32 filter is most
// wrong. It must stay within its bounds, and the bounds must not be far beyond what it can be wrong by.
//
// What is bounded is the sequence of operations in kernels/filter.h; here it stands once with fused multiply-adds and
// once without, because targets differ in that. Truth is long double.
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>

#include "bihive/geometry/sphere.h"
#include "bihive/kernels/filter.h"
#include "bihive/kernels/ray_setup-inl.h"
#include "bihive/kernels/scalar_traversal.h"
#include "bihive/kernels/single-inl.h"
#include "support/edge_rays.h"
#include "support/scenes.h"

namespace bihive {
namespace {

namespace here = HWY_NAMESPACE;
using Real = long double;

// A ray and a sphere, in stored units: no bound of the sphere is beyond 1.
struct Pair {
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

// The line and its two roots in long double, as distances from the local origin.
struct Truth {
  Real b, p, shift, length;
  bool meets;
  Real s_near, s_far;

  explicit Truth(const Pair& pair) {
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

// What the filter makes of a pair.
struct Filtered {
  float b, pp, enlarged_squared, dp, lower, upper;

  template <bool kFused>
  static float mul_add(float x, float y, float z) {
    return kFused ? std::fma(x, y, z) : x * y + z;
  }
  template <bool kFused>
  static Filtered of(const here::SingleRay& ray, Vec3f centre, float radius) {
    const float* const o = ray.local.origin;
    const float* const n = ray.local.direction;
    const float c[3] = {centre.x - o[0], centre.y - o[1], centre.z - o[2]};
    Filtered f;
    f.b = mul_add<kFused>(c[2], n[2], mul_add<kFused>(c[1], n[1], c[0] * n[0]));
    float p[3];
    for (int k = 0; k < 3; ++k) p[k] = mul_add<kFused>(-f.b, n[k], c[k]);
    f.pp = mul_add<kFused>(p[2], p[2], mul_add<kFused>(p[1], p[1], p[0] * p[0]));
    const float enlarged = radius + ray.e;
    f.enlarged_squared = enlarged * enlarged;
    f.dp = f.enlarged_squared - f.pp;
    const float chord = std::sqrt(std::max(f.dp, 0.0F));
    f.lower = f.b - ray.e - chord;
    f.upper = f.b + ray.e + chord;
    return f;
  }
};

// Ready for the filter; false where the library does not use it.
bool set_up(const Pair& pair, here::SingleRay& local) {
  const ScaledRay scaled(pair.ray, 1.0);
  const double farthest = std::max({std::abs(scaled.origin.x), std::abs(scaled.origin.y), std::abs(scaled.origin.z)});
  return farthest <= kFarthestOrigin && here::set_up_single(scaled, local);
}

// Starting points: from near and far, past the silhouette by little or much, sizes of all kinds, axes among them.
Pair random_pair(SplitMix64& rng) {
  Pair pair;
  do {
    const double reach = rng.next_below(4) == 0 ? test::log_uniform(rng, 8, 1e6) : test::log_uniform(rng, 0.01, 8);
    const double radius = test::log_uniform(rng, 1e-7, 1);
    Vec3d centre, ahead, aside;
    for (int k = 0; k < 3; ++k) {
      centre[k] = test::uniform(rng, -1, 1) * (1 - radius) * (rng.next_below(3) == 0 ? 1e-3 : 1);
      ahead[k] = rng.next_below(8) == 0 ? 0 : test::uniform(rng, -1, 1);
      aside[k] = test::uniform(rng, -1, 1);
    }
    Vec3d origin = centre + ahead * reach;
    // A corner of what needs no moving, seen from the opposite one: the errors are largest where all is.
    if (rng.next_below(3) == 0)
      for (int k = 0; k < 3; ++k) {
        const double sign = rng.next_below(2) == 0 ? 1 : -1;
        origin[k] = sign * kFarOrigin * test::uniform(rng, 0.9, 1);
        centre[k] = -sign * (1 - radius) * test::uniform(rng, 0.9, 1);
      }
    const double offset = radius * (rng.next_below(2) == 0 ? 1 : test::uniform(rng, 0, 1.1));
    const Vec3d target = centre + aside * (offset / std::max(1e-3, length(aside)));
    pair.ray.origin = to_float(origin);
    pair.ray.direction = to_float((target - to_double(pair.ray.origin)) * test::log_uniform(rng, 1e-3, 1e3));
    pair.centre = to_float(centre);
    pair.radius = static_cast<float>(radius);
  } while (!pair.allowed());
  return pair;
}

Pair moved(Pair pair, SplitMix64& rng) {
  float& number = pair.number(static_cast<int>(rng.next_below(10)));
  const float magnitude = std::abs(number);
  const double ulp = std::nextafter(magnitude, HUGE_VALF) - magnitude;
  const double steps = std::ldexp(1, static_cast<int>(rng.next_below(24)));
  number = static_cast<float>(number + (rng.next_below(2) == 0 ? steps : -steps) * ulp);
  return pair;
}

// The largest value of `used` found; NaN and pairs that the filter does not see count as -inf.
double most_used(const std::function<double(const Pair&, const here::SingleRay&, const Truth&)>& used) {
  const char* const number = std::getenv("BIHIVE_LONG");
  const std::uint64_t starts = 3000 * (number == nullptr ? 1 : std::strtoull(number, nullptr, 10));
  const auto value_of = [&](const Pair& pair) {
    here::SingleRay local;
    if (!pair.allowed() || !set_up(pair, local)) return -HUGE_VAL;
    const double value = used(pair, local, Truth(pair));
    return std::isnan(value) ? -HUGE_VAL : value;
  };
  double most = -HUGE_VAL;
  for (std::uint64_t start = 1; start <= starts; ++start) {
    SplitMix64 rng(start);
    Pair pair = random_pair(rng);
    double best = value_of(pair);
    for (int step = 0; step < 600; ++step) {
      const Pair next = moved(pair, rng);
      const double value = value_of(next);
      if (!(value >= best)) continue;
      best = value;
      pair = next;
    }
    most = std::max(most, best);
  }
  return most;
}

// Both ways of rounding at once.
template <class Used>
double most_used_by_filter(const Used& used) {
  return most_used([&](const Pair& pair, const here::SingleRay& local, const Truth& truth) {
    return std::max<double>(used(pair, local, truth, Filtered::of<true>(local, pair.centre, pair.radius)),
                            used(pair, local, truth, Filtered::of<false>(local, pair.centre, pair.radius)));
  });
}

// A bound holds, and is at most 1 / `tight` times what was found.
void expect_used(const std::string& what, double most, double tight) {
  testing::Test::RecordProperty(what, std::to_string(most));
  std::printf("  %s: %.3f of the bound is used\n", what.c_str(), most);
  EXPECT_LT(most, 1) << what << ": the bound does not hold";
  EXPECT_GT(most, tight) << what << ": the bound is loose, or the search is poor";
}

TEST(FilterBounds, DistanceAlongTheRay) {
  expect_used("e against b",
              most_used_by_filter([](const Pair&, const here::SingleRay& local, const Truth& truth, const Filtered& f) {
                return double(std::abs(Real(f.b) - truth.b) / Real(local.e));
              }),
              0.15);
}

TEST(FilterBounds, DistanceFromTheRay) {
  // dp < 0 must be a certain miss: the line is at most so much nearer than the filter says.
  expect_used("e against |p|",
              most_used_by_filter([](const Pair& pair, const here::SingleRay&, const Truth& truth, const Filtered& f) {
                const Real slack = std::sqrt(Real(f.enlarged_squared)) - Real(pair.radius);
                return double((std::sqrt(Real(f.pp)) - truth.p) / slack);
              }),
              0.15);
}

TEST(FilterBounds, RootsLieBetweenTheirBounds) {
  // Both hold the error of b and that of the chord, which is smallest where the line meets the centre: 2 e at least.
  expect_used("lower bound of the near root",
              most_used_by_filter([](const Pair&, const here::SingleRay& local, const Truth& truth, const Filtered& f) {
                if (!truth.meets) return -HUGE_VAL;
                if (f.dp < 0) return HUGE_VAL;
                return double(1 - (truth.s_near - Real(f.lower)) / (2 * Real(local.e)));
              }),
              0.15);
  expect_used("upper bound of the far root",
              most_used_by_filter([](const Pair&, const here::SingleRay& local, const Truth& truth, const Filtered& f) {
                if (!truth.meets) return -HUGE_VAL;
                if (f.dp < 0) return HUGE_VAL;
                return double(1 - (Real(f.upper) - truth.s_far) / (2 * Real(local.e)));
              }),
              0.15);
}

TEST(FilterBounds, ASureRootLiesInItsInterval) {
  expect_used(
      "W",
      most_used_by_filter([](const Pair& pair, const here::SingleRay& local, const Truth& truth, const Filtered& f) {
        const float reach = pair.radius + local.e;
        if (!(f.dp >= 0.04F * reach * reach + 4 * local.e * reach)) return -HUGE_VAL;
        if (!truth.meets) return HUGE_VAL;
        return double((truth.s_near - Real(f.lower)) / (Real(kWidthInErrors) * Real(local.e)));
      }),
      0.25);
}

// How much of the padding of boxes is used where a ray enters a box, or leaves it, that its hit lies in.
template <bool kNear, bool kFused>
double box_padding_used(const Pair& pair, const here::SingleRay& local, const Truth& truth) {
  const ScaledRay scaled(pair.ray, 1.0);
  const SphereRoots roots = sphere_roots(scaled, to_double(pair.centre), double(pair.radius));
  if (std::isnan(roots.t_near)) return -HUGE_VAL;
  float farthest = 0;
  for (int k = 0; k < 3; ++k) farthest = std::max(farthest, std::abs(local.local.origin[k]));
  const Real pad = Real(FilterBounds(farthest).box_pad);
  Real most = -HUGE_VALL;
  for (const double t : {roots.t_near, roots.t_far}) {
    const Real s = Real(t) * truth.length - truth.shift;
    for (int k = 0; k < 3; ++k) {
      const float lo = pair.centre[k] - pair.radius;
      const float hi = pair.centre[k] + pair.radius;
      const bool negative = std::signbit(local.local.inverse[k]);
      const float plane = kNear != negative ? lo : hi;
      const float offset = kNear ? local.local.near_offset[k] : local.local.far_offset[k];
      const Real distance = Real(Filtered::mul_add<kFused>(plane, local.local.inverse[k], offset));
      const Real room = (kNear ? s - distance : distance - s) * std::abs(1 / Real(local.local.inverse[k]));
      most = std::max(most, 1 - room / pad);
    }
  }
  return double(most);
}

TEST(FilterBounds, BoxesKeepTheirHits) {
  const auto used = [](const Pair& pair, const here::SingleRay& local, const Truth& truth) {
    return std::max(
        {box_padding_used<true, true>(pair, local, truth), box_padding_used<true, false>(pair, local, truth),
         box_padding_used<false, true>(pair, local, truth), box_padding_used<false, false>(pair, local, truth)});
  };
  expect_used("padding of boxes", most_used(used), 0.15);
}

TEST(FilterBounds, EndsOfTheSegment) {
  // Ends lie outside the true ones, by less than W / 2.
  SplitMix64 rng(7);
  double most = 0;
  for (int i = 0; i < 100000; ++i) {
    Pair pair = random_pair(rng);
    const Truth line(pair);
    const double near = double((line.s_near + line.shift) / line.length);
    pair.ray.t_min = near * test::uniform(rng, 0.9, 1.1);
    pair.ray.t_max = pair.ray.t_min + std::abs(near) * test::log_uniform(rng, 1e-9, 10);
    here::SingleRay local;
    if (!set_up(pair, local)) continue;
    const Real start = Real(pair.ray.t_min) * line.length - line.shift;
    const Real end = Real(pair.ray.t_max) * line.length - line.shift;
    const Real half_width = Real(kWidthInErrors) * Real(local.e) / 2;
    if (std::abs(start) < Real(kFarthestEnd)) {
      ASSERT_LE(Real(local.local.s_min), start) << i;
      ASSERT_GT(Real(local.local.s_min), start - half_width) << i;
      most = std::max(most, double((start - Real(local.local.s_min)) / half_width));
    }
    if (std::abs(end) < Real(kFarthestEnd)) {
      ASSERT_GE(Real(local.s_best), end) << i;
      ASSERT_LT(Real(local.s_best), end + half_width) << i;
      most = std::max(most, double((Real(local.s_best) - end) / half_width));
    }
  }
  std::printf("  ends of the segment: %.3f of W / 2 is used\n", most);
}

TEST(FilterBounds, ManyRaysAreSetUpAsOne) {
  // set_up_16() is what lists and beams use: the same local ray up to roundings of binary64.
  SplitMix64 rng(8);
  for (int round = 0; round < 2000; ++round) {
    RayBatch batch;
    for (int i = 0; i < 16; ++i) {
      Ray ray = random_pair(rng).ray;
      ray.t_min = test::uniform(rng, -1, 1);
      ray.t_max = ray.t_min + test::log_uniform(rng, 1e-6, 1e6);
      batch.push_back(ray);
    }
    here::LocalRays many;
    here::set_up_16(batch.span(), 0, 1.0, many);
    float farthest_origin = 0;
    for (int i = 0; i < 16; ++i) {
      const ScaledRay scaled(batch.span().at(i), 1.0);
      here::SingleRay one;
      const bool alive = here::set_up_single(scaled, one);
      const double size = std::max({std::abs(scaled.origin.x), std::abs(scaled.origin.y), std::abs(scaled.origin.z)});
      ASSERT_EQ((many.far >> i & 1) != 0, size > kFarthestOrigin) << test::text_of(batch.span().at(i));
      if ((many.dead >> i & 1) != 0) {
        ASSERT_TRUE(!alive || size > kFarthestOrigin) << test::text_of(batch.span().at(i));
        continue;
      }
      ASSERT_TRUE(alive);
      const float tolerance = 0x1p-23F * 9;
      for (int k = 0; k < 3; ++k) {
        ASSERT_NEAR(many.origin[k][i], one.local.origin[k], tolerance);
        ASSERT_NEAR(many.direction[k][i], one.local.direction[k], 0x1p-23F);
        farthest_origin = std::max(farthest_origin, std::abs(many.origin[k][i]));
      }
      ASSERT_NEAR(many.s_min[i], one.local.s_min, tolerance * 4);
      ASSERT_NEAR(many.s_max[i], one.s_best, tolerance * 4);
    }
    ASSERT_GE(many.farthest_origin, farthest_origin * (1 - 0x1p-22F));
  }
}

}  // namespace
}  // namespace bihive
