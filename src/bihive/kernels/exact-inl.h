// The scalar truth of geometry/sphere.h on vectors of binary64: the same operations in the same order, several pairs of
// a ray and a sphere at a time. Never with fused multiply-add.

#if defined(BIHIVE_KERNELS_EXACT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_KERNELS_EXACT_INL_H_
#undef BIHIVE_KERNELS_EXACT_INL_H_
#else
#define BIHIVE_KERNELS_EXACT_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <limits>

#include "bihive/kernels/left_sphere.h"
#include "bihive/kernels/ray_batch.h"
#include "bihive/kernels/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kExactPairs = 8;

/// A ray's number in its span, and a sphere's slot.
struct Pair {
  std::uint32_t ray;
  std::uint32_t slot;
};

namespace exact {

/// Up to eight pairs, gathered. Unused entries must be finite.
struct alignas(64) Gathered {
  double origin[3][kExactPairs] = {};
  double direction[3][kExactPairs] = {};
  double centre[3][kExactPairs] = {};
  double radius[kExactPairs] = {};
  double t_min[kExactPairs] = {};
  double t_max[kExactPairs] = {};
  double own[kExactPairs] = {};     // 1: the ray leaves this sphere
  double inside[kExactPairs] = {};  // 1: into it
};

HWY_INLINE void gather(const WideTree& tree, const RaySpan& rays, const Pair& pair, int k, Gathered& to) {
  const std::int64_t i = pair.ray;
  for (int axis = 0; axis < 3; ++axis) {
    to.origin[axis][k] = double(rays.origin[axis][i]) * tree.scale;
    to.direction[axis][k] = double(rays.direction[axis][i]) * tree.scale;
  }
  const Vec3d centre = tree.spheres.centre(pair.slot);
  to.centre[0][k] = centre.x;
  to.centre[1][k] = centre.y;
  to.centre[2][k] = centre.z;
  to.radius[k] = tree.spheres.radius(pair.slot);
  to.t_min[k] = rays.t_min != nullptr ? rays.t_min[i] : 0;
  to.t_max[k] = rays.t_max != nullptr ? rays.t_max[i] : std::numeric_limits<double>::infinity();
  to.own[k] = 0;
  if (rays.leaves != nullptr && rays.leaves[i] >= 0)
    to.own[k] = LeftSphere(tree, rays.leaves[i]).is(tree, pair.slot) ? 1 : 0;
  to.inside[k] = rays.inside != nullptr && rays.inside[i] != 0 ? 1 : 0;
}

}  // namespace exact

/// sphere_hit() of up to eight pairs of valid rays and spheres: t or +inf to `t`.
HWY_INLINE void exact_hits(const WideTree& tree, const RaySpan& rays, const Pair* pairs, int count,
                           double t[kExactPairs]) {
  exact::Gathered g;
  for (int k = 0; k < count; ++k) exact::gather(tree, rays, pairs[k], k, g);
  for (int k = count; k < kExactPairs; ++k) g.direction[0][k] = 1;

  using Tag = hn::CappedTag<double, kExactPairs>;
  const Tag d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  const auto half = hn::Set(d, 0.5);
  for (int k = 0; k < kExactPairs; k += kLanes) {
    if (k >= count) break;
    const auto load = [&](const double* from) HWY_ATTR { return hn::Load(d, from + k); };
    const auto dot3 = [](auto ax, auto ay, auto az, auto bx, auto by, auto bz)
                          HWY_ATTR { return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz)); };
    const auto dx = load(g.direction[0]);
    const auto dy = load(g.direction[1]);
    const auto dz = load(g.direction[2]);
    const auto direction_squared = dot3(dx, dy, dz, dx, dy, dz);

    // Find the point of the line that is closest to the centre, and the vector from it to the centre.
    const auto cx = hn::Sub(load(g.centre[0]), load(g.origin[0]));
    const auto cy = hn::Sub(load(g.centre[1]), load(g.origin[1]));
    const auto cz = hn::Sub(load(g.centre[2]), load(g.origin[2]));
    const auto t_closest = hn::Div(dot3(cx, cy, cz, dx, dy, dz), direction_squared);
    const auto px = hn::Sub(cx, hn::Mul(t_closest, dx));
    const auto py = hn::Sub(cy, hn::Mul(t_closest, dy));
    const auto pz = hn::Sub(cz, hn::Mul(t_closest, dz));

    // Pythagoras gives half of the chord.
    const auto r = load(g.radius);
    const auto discriminant = hn::Sub(hn::Mul(r, r), dot3(px, py, pz, px, py, pz));
    const auto meets = hn::And(hn::Ge(discriminant, hn::Zero(d)), hn::Gt(r, hn::Zero(d)));
    const auto half_chord = hn::Sqrt(hn::Div(discriminant, direction_squared));
    const auto t_near = hn::Sub(t_closest, half_chord);
    const auto t_far = hn::Add(t_closest, half_chord);

    // The nearer root in the segment, else the farther; of the sphere that the ray leaves the farther or none.
    const auto t_min = load(g.t_min);
    const auto t_max = load(g.t_max);
    const auto own = hn::Gt(load(g.own), half);
    const auto inside = hn::Gt(load(g.inside), half);
    const auto take_near = hn::And(hn::AndNot(own, meets), hn::And(hn::Ge(t_near, t_min), hn::Le(t_near, t_max)));
    const auto take_far =
        hn::And(hn::AndNot(hn::AndNot(inside, own), meets), hn::And(hn::Ge(t_far, t_min), hn::Le(t_far, t_max)));
    hn::StoreU(hn::IfThenElse(take_near, t_near, hn::IfThenElse(take_far, t_far, infinity)), d, t + k);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_KERNELS_EXACT_INL_H_
