// The bounds of wide/trace/beam_bounds.h: hill climbing for the pair of a ray and a sphere with the largest error of a
// beam of that one ray. See filter_bounds_test.cpp.
// ctest: inlined
// ctest: asan-long
#include "bihive/wide/trace/beam_bounds.h"

#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/math/infinity.h"
#include "bihive/wide/trace/beam_rays-inl.h"
#include "bihive/wide/trace/frustum-inl.h"
#include "support/filter_search.h"

namespace bihive {
namespace {

namespace here = HWY_NAMESPACE;
using Pair = test::RayAndSphere;
using test::expect_used;
using test::Real;
using test::Truth;

// A beam is slow to set up for one ray, and each evaluation makes a frustum a dozen times.
constexpr std::uint64_t kStarts = 1000, kFewStarts = 200;

// A tree without spheres, of the largest possible size.
const WideTree& empty_tree() {
  static const WideTree tree = [] {
    WideTree made;
    made.aabb = {{-1, -1, -1}, {1, 1, 1}};
    return made;
  }();
  return tree;
}

// A beam of one ray; false if the library makes none.
bool set_up(const Pair& pair, here::BeamRays& rays) {
  RayBatch batch;
  for (int axis = 0; axis < 3; ++axis) {
    batch.origin[axis].push_back(pair.ray.origin[axis]);
    batch.direction[axis].push_back(pair.ray.direction[axis]);
  }
  const RaySpan span = batch.span();
  return here::set_up_beam(empty_tree(), span, 0, 1, rays);
}

// The beam's result for a sphere.
struct Meeting {
  float b, dp, lower, upper;
  bool sure;

  template <bool kFused>
  static Meeting of(const here::BeamRays& rays, Vec3f centre, float radius) {
    const auto mul_add = [](float x, float y, float z) { return kFused ? std::fma(x, y, z) : x * y + z; };
    float c[3], n[3], p[3];
    for (int k = 0; k < 3; ++k) {
      c[k] = centre[k] - rays.origin[k][0];
      n[k] = rays.direction[k][0];
    }
    Meeting m;
    m.b = mul_add(c[2], n[2], mul_add(c[1], n[1], c[0] * n[0]));
    for (int k = 0; k < 3; ++k) p[k] = mul_add(-m.b, n[k], c[k]);
    const float padded = radius + rays.e;
    // meet() of sphere_filter-inl.h takes the squares one by one.
    m.dp = padded * padded;
    for (const int k : {2, 1, 0}) m.dp = mul_add(-p[k], p[k], m.dp);
    const float chord = std::sqrt(std::max(m.dp, 0.0F));
    m.lower = m.b - rays.e - chord;
    // The smallest possible value of an approximate reciprocal root.
    const float reciprocal = (1 - 2e-3F) / std::max(chord, 1e-30F);
    m.upper = m.lower + mul_add(kWidthShare * rays.e * padded, reciprocal, rays.e + rays.e);
    m.sure = m.dp > kSureShare * rays.e * padded;
    return m;
  }
};

template <class Used>
double most_used_by_beams(const Used& used) {
  return test::most_used(
      [&](const Pair& pair) {
        here::BeamRays rays;
        if (!set_up(pair, rays)) return -HUGE_VAL;
        const Truth truth(pair);
        return std::max<double>(used(pair, rays, truth, Meeting::of<true>(rays, pair.centre, pair.radius)),
                                used(pair, rays, truth, Meeting::of<false>(rays, pair.centre, pair.radius)));
      },
      kStarts);
}

TEST(BeamBounds, DistanceAlongTheRay) {
  expect_used("e against b",
              most_used_by_beams([](const Pair&, const here::BeamRays& rays, const Truth& truth, const Meeting& m) {
                return double(std::abs(Real(m.b) - truth.b) / Real(rays.e));
              }),
              0.1);
}

TEST(BeamBounds, DistanceFromTheRay) {
  expect_used(
      "e against |p|",
      most_used_by_beams([](const Pair& pair, const here::BeamRays& rays, const Truth& truth, const Meeting& m) {
        const Real r = Real(pair.radius), e = Real(rays.e);
        if (truth.p > r || truth.p < r - 2 * e) return -HUGE_VAL;
        return double(((r + e) * (r + e) - truth.p * truth.p - Real(m.dp)) / (2 * r * e + e * e));
      }),
      0.1);
}

TEST(BeamBounds, RootsLieBetweenTheirBounds) {
  expect_used("lower bound of the near root",
              most_used_by_beams([](const Pair&, const here::BeamRays& rays, const Truth& truth, const Meeting& m) {
                if (!truth.meets) return -HUGE_VAL;
                if (m.dp < 0) return HUGE_VAL;
                return double(1 - (truth.s_near - Real(m.lower)) / (2 * Real(rays.e)));
              }),
              0.1);
}

TEST(BeamBounds, ASureRootLiesInItsInterval) {
  expect_used("hi - lo",
              most_used_by_beams([](const Pair&, const here::BeamRays&, const Truth& truth, const Meeting& m) {
                if (!m.sure) return -HUGE_VAL;
                if (!truth.meets) return HUGE_VAL;
                return double((truth.s_near - Real(m.lower)) / (Real(m.upper) - Real(m.lower)));
              }),
              0.25);
}

// The smallest share of the padding with which the frustum of one ray still contains the ray's hit.
template <class Kept>
double least_padding(const Pair& pair, const Kept& kept) {
  const ScaledRay scaled(pair.ray, 1.0);
  const SphereRoots roots = sphere_roots(scaled, to_double(pair.centre), double(pair.radius));
  here::BeamRays rays;
  if (std::isnan(roots.t_near) || roots.t_far < 0 || !set_up(pair, rays)) return -HUGE_VAL;
  const float pad = rays.pad;
  const auto kept_with = [&](float share) {
    rays.pad = share * pad;
    here::Frustum frustum;
    return here::make_frustum<wide::kBeamRays>(empty_tree(), rays, 0, frustum) && kept(frustum, rays);
  };
  if (!kept_with(1)) return HUGE_VAL;
  float lo = -1, hi = 1;
  for (int i = 0; i < 12; ++i) {
    const float middle = 0.5F * (lo + hi);
    (kept_with(middle) ? hi : lo) = middle;
  }
  return double(hi);
}

TEST(BeamBounds, FrustumsKeepBoxes) {
  const auto used = [](const Pair& pair) {
    WideNode node = {};
    for (int axis = 0; axis < 3; ++axis)
      for (int slot = 0; slot < kWidth; ++slot) {
        node.lo[axis][slot] = slot == 0 ? pair.centre[axis] - pair.radius : kInfiniteFloat;
        node.hi[axis][slot] = slot == 0 ? pair.centre[axis] + pair.radius : -kInfiniteFloat;
      }
    node.child_count = 1;
    return least_padding(pair, [&](const here::Frustum& frustum, const here::BeamRays&) {
      alignas(64) float w_near[kWidth];
      return (here::boxes_in(node, frustum, w_near) & 1) != 0 && w_near[0] <= frustum.w_end;
    });
  };
  // The bound adds the largest effects of slopes of 5 and of places of 13 F; no pair of the search comes near that sum.
  expect_used("padding of frustums, boxes", test::most_used(used, kFewStarts), 0.01);
}

TEST(BeamBounds, FrustumsKeepSpheres) {
  const auto used = [](const Pair& pair) {
    return least_padding(pair, [&](const here::Frustum& frustum, const here::BeamRays& rays) {
      namespace hn = hwy::HWY_NAMESPACE;
      const here::FloatTag d;
      const hn::VFromD<here::FloatTag> centre[3] = {hn::Set(d, pair.centre.x), hn::Set(d, pair.centre.y),
                                                    hn::Set(d, pair.centre.z)};
      const auto inside = here::spheres_in(frustum, centre, hn::Set(d, pair.radius + rays.e));
      return (here::mask_bits(inside) & 1) != 0;
    });
  };
  // Radii are enlarged by e besides, so the needed share of the padding may be negative.
  expect_used("padding of frustums, spheres", test::most_used(used, kFewStarts), -1);
}

}  // namespace
}  // namespace bihive
