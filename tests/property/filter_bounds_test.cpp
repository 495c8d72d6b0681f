// The bounds of wide/trace/filter_bounds.h: hill climbing for the pair of a ray and a sphere with the largest error of
// the binary32 filter. The error must stay within the bounds, and the bounds must not be far above the largest error.
//
// The bounds are for the sequence of operations in wide/trace/filter_bounds.h. This file repeats it once with fused
// multiply-adds and once without, because targets differ in that. Truth is long double.
// ctest: inlined
// ctest: asan-long
#include "bihive/wide/trace/filter_bounds.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>

#include "bihive/geometry/sphere.h"
#include "bihive/wide/trace/local_rays-inl.h"
#include "bihive/wide/trace/ray_walk-inl.h"
#include "bihive/wide/trace/scalar_walk.h"
#include "support/edge_rays.h"
#include "support/filter_search.h"
#include "support/scenes.h"

namespace bihive {
namespace {

namespace here = HWY_NAMESPACE;
using Pair = test::RayAndSphere;
using OneRay = here::SingleRay;
using test::expect_used;
using test::Real;
using test::Truth;

// The filter's result for a pair.
struct Filtered {
  float b, dp, lower, upper;

  template <bool kFused>
  static float mul_add(float x, float y, float z) {
    return kFused ? std::fma(x, y, z) : x * y + z;
  }
  // The squares are taken from (r + e)^2 one by one, as meet() of sphere_filter-inl.h does.
  template <bool kFused>
  static Filtered of(const OneRay& ray, Vec3f centre, float radius) {
    const float* const o = ray.local.origin;
    const float* const n = ray.local.direction;
    const float c[3] = {centre.x - o[0], centre.y - o[1], centre.z - o[2]};
    Filtered f;
    f.b = mul_add<kFused>(c[2], n[2], mul_add<kFused>(c[1], n[1], c[0] * n[0]));
    float p[3];
    for (int k = 0; k < 3; ++k) p[k] = mul_add<kFused>(-f.b, n[k], c[k]);
    const float enlarged = radius + ray.e;
    f.dp = enlarged * enlarged;
    for (const int k : {2, 1, 0}) f.dp = mul_add<kFused>(-p[k], p[k], f.dp);
    const float chord = std::sqrt(std::max(f.dp, 0.0F));
    f.lower = f.b - ray.e - chord;
    f.upper = f.b + ray.e + chord;
    return f;
  }
};

// Prepares the ray for the filter; false if the library does not use the filter for it.
bool set_up(const Pair& pair, OneRay& local) {
  const ScaledRay scaled(pair.ray, 1.0);
  const double farthest = std::max({std::abs(scaled.origin.x), std::abs(scaled.origin.y), std::abs(scaled.origin.z)});
  double length = 0, shift = 0;
  return farthest <= kFarthestOrigin && here::set_up_single_ray(pair.ray, WideTree(), local, length, shift);
}

// The largest value of `used` over pairs that the filter may get.
template <class Used>
double most_used_of(const Used& used) {
  return test::most_used([&](const Pair& pair) {
    OneRay local;
    return set_up(pair, local) ? double(used(pair, local, Truth(pair))) : -HUGE_VAL;
  });
}

// All ways of rounding together.
template <class Used>
double most_used_by_filter(const Used& used) {
  return most_used_of([&](const Pair& pair, const OneRay& local, const Truth& truth) {
    return std::max(used(pair, local, truth, Filtered::of<true>(local, pair.centre, pair.radius)),
                    used(pair, local, truth, Filtered::of<false>(local, pair.centre, pair.radius)));
  });
}

TEST(FilterBounds, DistanceAlongTheRay) {
  expect_used("e against b",
              most_used_by_filter([](const Pair&, const OneRay& local, const Truth& truth, const Filtered& f) {
                return double(std::abs(Real(f.b) - truth.b) / Real(local.e));
              }),
              0.15);
}

TEST(FilterBounds, DistanceFromTheRay) {
  // dp < 0 must be a certain miss: at the silhouette the error of dp is smaller than the part that e adds to r^2.
  expect_used("e against |p|",
              most_used_by_filter([](const Pair& pair, const OneRay& local, const Truth& truth, const Filtered& f) {
                const Real r = Real(pair.radius), e = Real(local.e);
                if (truth.p > r || truth.p < r - 2 * e) return -HUGE_VAL;
                return double(((r + e) * (r + e) - truth.p * truth.p - Real(f.dp)) / (2 * r * e + e * e));
              }),
              0.15);
}

TEST(FilterBounds, RootsLieBetweenTheirBounds) {
  // Both contain the error of b and that of the chord, which is smallest if the line meets the centre: at least 2 e.
  expect_used("lower bound of the near root",
              most_used_by_filter([](const Pair&, const OneRay& local, const Truth& truth, const Filtered& f) {
                if (!truth.meets) return -HUGE_VAL;
                if (f.dp < 0) return HUGE_VAL;
                return double(1 - (truth.s_near - Real(f.lower)) / (2 * Real(local.e)));
              }),
              0.15);
  expect_used("upper bound of the far root",
              most_used_by_filter([](const Pair&, const OneRay& local, const Truth& truth, const Filtered& f) {
                if (!truth.meets) return -HUGE_VAL;
                if (f.dp < 0) return HUGE_VAL;
                return double(1 - (Real(f.upper) - truth.s_far) / (2 * Real(local.e)));
              }),
              0.15);
}

TEST(FilterBounds, ASureRootLiesInItsInterval) {
  expect_used("W",
              most_used_by_filter([](const Pair& pair, const OneRay& local, const Truth& truth, const Filtered& f) {
                const float reach = pair.radius + local.e;
                if (!(f.dp >= 0.04F * reach * reach + 4 * local.e * reach)) return -HUGE_VAL;
                if (!truth.meets) return HUGE_VAL;
                return double((truth.s_near - Real(f.lower)) / (Real(kWidthInErrors) * Real(local.e)));
              }),
              0.25);
}

// The used share of the padding of boxes, for a ray that enters or leaves a box that contains its hit. Lists move the
// planes outward, single rays move their offsets.
template <bool kNear, bool kFused, bool kPlanesMoved>
double box_padding_used(const Pair& pair, const OneRay& local, const Truth& truth) {
  const ScaledRay scaled(pair.ray, 1.0);
  const SphereRoots roots = sphere_roots(scaled, to_double(pair.centre), double(pair.radius));
  if (std::isnan(roots.t_near)) return -HUGE_VAL;
  float farthest = 0;
  for (int k = 0; k < 3; ++k) farthest = std::max(farthest, std::abs(local.local.origin[k]));
  const float box_pad = FilterBounds(farthest).box_pad;
  const Real pad = Real(box_pad);
  Real most = -HUGE_VALL;
  for (const double t : {roots.t_near, roots.t_far}) {
    const Real s = Real(t) * truth.length - truth.shift;
    for (int k = 0; k < 3; ++k) {
      const float lo = pair.centre[k] - pair.radius;
      const float hi = pair.centre[k] + pair.radius;
      const bool negative = std::signbit(local.local.inverse[k]);
      float plane = kNear != negative ? lo : hi;
      float offset = kNear ? local.near_offset[k] : local.far_offset[k];
      if (kPlanesMoved) {
        plane = kNear != negative ? plane - box_pad : plane + box_pad;
        offset = local.local.offset[k];
      }
      const Real distance = Real(Filtered::mul_add<kFused>(plane, local.local.inverse[k], offset));
      const Real room = (kNear ? s - distance : distance - s) * std::abs(1 / Real(local.local.inverse[k]));
      most = std::max(most, 1 - room / pad);
    }
  }
  return double(most);
}

TEST(FilterBounds, BoxesKeepTheirHits) {
  const auto used = [](const Pair& pair, const OneRay& local, const Truth& truth) {
    const auto either_end = [&](auto fused, auto moved) {
      return std::max(box_padding_used<true, fused, moved>(pair, local, truth),
                      box_padding_used<false, fused, moved>(pair, local, truth));
    };
    constexpr std::true_type yes;
    constexpr std::false_type no;
    return std::max({either_end(yes, yes), either_end(yes, no), either_end(no, yes), either_end(no, no)});
  };
  expect_used("padding of boxes", most_used_of(used), 0.15);
}

TEST(FilterBounds, EndsOfTheSegment) {
  // Computed ends lie outside the true ones, by less than W / 2.
  SplitMix64 rng(7);
  double most = 0;
  for (int i = 0; i < 100000; ++i) {
    Pair pair = test::random_pair(rng);
    const Truth line(pair);
    const double near = double((line.s_near + line.shift) / line.length);
    pair.ray.t_min = near * test::uniform(rng, 0.9, 1.1);
    pair.ray.t_max = pair.ray.t_min + std::abs(near) * test::log_uniform(rng, 1e-9, 10);
    OneRay local;
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
  // set_up_16() makes local rays for lists and beams: the same local ray up to roundings of binary64.
  SplitMix64 rng(8);
  for (int round = 0; round < 2000; ++round) {
    RayBatch batch;
    for (int i = 0; i < 16; ++i) {
      Ray ray = test::random_pair(rng).ray;
      ray.t_min = test::uniform(rng, -1, 1);
      ray.t_max = ray.t_min + test::log_uniform(rng, 1e-6, 1e6);
      batch.push_back(ray);
    }
    here::LocalRays many;
    here::set_up_16(batch.span(), 0, WideTree(), many);
    float farthest_origin = 0;
    for (int i = 0; i < 16; ++i) {
      const ScaledRay scaled(batch.span().at(i), 1.0);
      OneRay one;
      double length = 0, shift = 0;
      const bool alive = here::set_up_single_ray(batch.span().at(i), WideTree(), one, length, shift);
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
