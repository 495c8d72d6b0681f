// The scalar truth of geometry/sphere.h on vectors of binary64: the same operations in the same order, several pairs of
// a ray and a sphere at a time. Never with fused multiply-add.

#if defined(BIHIVE_WIDE_TRACE_EXACT_DECISION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_EXACT_DECISION_INL_H_
#undef BIHIVE_WIDE_TRACE_EXACT_DECISION_INL_H_
#else
#define BIHIVE_WIDE_TRACE_EXACT_DECISION_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "bihive/simd/wasm_float64-inl.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/undecided_pairs.h"
#include "bihive/wide/tree/left_sphere.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

constexpr int kExactPairs = 8;

namespace exact {

/// Up to eight pairs, gathered. Unused entries must be finite.
struct alignas(64) Gathered {
  double origin[3][kExactPairs] = {};
  double direction[3][kExactPairs] = {};
  double centre[3][kExactPairs] = {};
  double radius[kExactPairs] = {};
  double t_min[kExactPairs] = {};
  double t_max[kExactPairs] = {};
  double own[kExactPairs] = {};     // 1: the ray exits this sphere
  double inside[kExactPairs] = {};  // 1: into it
};

HWY_INLINE void gather(const WideTree& tree, const RaySpan& rays, const Pair& pair, int k, Gathered& to) {
  const std::int64_t i = pair.ray;
  for (int axis = 0; axis < 3; ++axis) {
    to.origin[axis][k] = double(rays.origin[axis][i]) * tree.scale;
    to.direction[axis][k] = double(rays.direction[axis][i]) * tree.scale;
  }
  const Vec3d centre = tree.centre(pair.slot);
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

/// Rays and spheres in binary64, stored units.
template <class D>
struct ExactLanes {
  hn::Vec<D> origin[3], direction[3], centre[3], radius, t_min, t_max;
  hn::Mask<D> own, inside;  // the ray exits this sphere; into it
};

/// Both roots of lines and spheres; valid where the discriminant is not negative.
template <class D>
struct RootLanes {
  hn::Vec<D> discriminant, t_near, t_far;
};

/// sphere_roots() of geometry/sphere.h lane by lane.
template <class D>
HWY_INLINE RootLanes<D> sphere_roots_lanes(const hn::Vec<D> origin[3], const hn::Vec<D> direction[3],
                                           const hn::Vec<D> centre[3], hn::Vec<D> radius) {
  const auto dot3 = [](auto ax, auto ay, auto az, auto bx, auto by, auto bz)
                        HWY_ATTR { return hn::Add(hn::Add(hn::Mul(ax, bx), hn::Mul(ay, by)), hn::Mul(az, bz)); };
  const auto dx = direction[0];
  const auto dy = direction[1];
  const auto dz = direction[2];
  const auto direction_squared = dot3(dx, dy, dz, dx, dy, dz);

  // Find the point of the line that is closest to the centre, and the vector from it to the centre.
  const auto cx = hn::Sub(centre[0], origin[0]);
  const auto cy = hn::Sub(centre[1], origin[1]);
  const auto cz = hn::Sub(centre[2], origin[2]);
  const auto t_closest = hn::Div(dot3(cx, cy, cz, dx, dy, dz), direction_squared);
  const auto px = hn::Sub(cx, hn::Mul(t_closest, dx));
  const auto py = hn::Sub(cy, hn::Mul(t_closest, dy));
  const auto pz = hn::Sub(cz, hn::Mul(t_closest, dz));

  // Pythagoras gives half of the chord.
  RootLanes<D> roots;
  roots.discriminant = hn::Sub(hn::Mul(radius, radius), dot3(px, py, pz, px, py, pz));
  const auto half_chord = hn::Sqrt(hn::Div(roots.discriminant, direction_squared));
  roots.t_near = hn::Sub(t_closest, half_chord);
  roots.t_far = hn::Add(t_closest, half_chord);
  return roots;
}

/// sphere_hit() lane by lane: t, or +inf.
template <class D>
HWY_INLINE hn::Vec<D> sphere_hit_lanes(D d, const ExactLanes<D>& lanes) {
  const auto roots = sphere_roots_lanes<D>(lanes.origin, lanes.direction, lanes.centre, lanes.radius);
  const auto meets = hn::And(hn::Ge(roots.discriminant, hn::Zero(d)), hn::Gt(lanes.radius, hn::Zero(d)));

  // The nearer root counts if it lies in the segment, else the farther. For the sphere on which the ray starts, only
  // the farther root counts (going into it) or none.
  const auto in_segment = [&](auto t) HWY_ATTR { return hn::And(hn::Ge(t, lanes.t_min), hn::Le(t, lanes.t_max)); };
  const auto take_near = hn::And(hn::AndNot(lanes.own, meets), in_segment(roots.t_near));
  const auto take_far = hn::And(hn::AndNot(hn::AndNot(lanes.inside, lanes.own), meets), in_segment(roots.t_far));
  const auto infinity = hn::Set(d, std::numeric_limits<double>::infinity());
  return hn::IfThenElse(take_near, roots.t_near, hn::IfThenElse(take_far, roots.t_far, infinity));
}

/// sphere_hit() of up to eight pairs of valid rays and spheres: t or +inf to `t`.
HWY_INLINE void exact_hits(const WideTree& tree, const RaySpan& rays, const Pair* pairs, int count,
                           double t[kExactPairs]) {
  exact::Gathered g;
  for (int k = 0; k < count; ++k) exact::gather(tree, rays, pairs[k], k, g);
  for (int k = count; k < kExactPairs; ++k) g.direction[0][k] = 1;

  using Tag = hn::CappedTag<double, kExactPairs>;
  const Tag d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
  const auto half = hn::Set(d, 0.5);
  for (int k = 0; k < count; k += kLanes) {
    ExactLanes<Tag> lanes;
    for (int axis = 0; axis < 3; ++axis) {
      lanes.origin[axis] = hn::Load(d, g.origin[axis] + k);
      lanes.direction[axis] = hn::Load(d, g.direction[axis] + k);
      lanes.centre[axis] = hn::Load(d, g.centre[axis] + k);
    }
    lanes.radius = hn::Load(d, g.radius + k);
    lanes.t_min = hn::Load(d, g.t_min + k);
    lanes.t_max = hn::Load(d, g.t_max + k);
    lanes.own = hn::Gt(hn::Load(d, g.own + k), half);
    lanes.inside = hn::Gt(hn::Load(d, g.inside + k), half);
    hn::StoreU(sphere_hit_lanes(d, lanes), d, t + k);
  }
}

/// Decides all pairs, and empties the store: on_hit(ray, t, slot) for each ray that hits its sphere, in the order of
/// add().
template <class Pairs, class OnHit>
HWY_INLINE void decide_pairs(const WideTree& tree, const RaySpan& rays, Pairs& pairs, const OnHit& on_hit) {
  double t[kExactPairs];
  for (int first = 0; first < pairs.count(); first += kExactPairs) {
    const Pair* const some = pairs.data() + first;
    const int n = std::min(kExactPairs, pairs.count() - first);
    exact_hits(tree, rays, some, n, t);
    for (int k = 0; k < n; ++k)
      if (t[k] < std::numeric_limits<double>::infinity()) on_hit(some[k].ray, t[k], some[k].slot);
  }
  pairs.clear();
}

/// Makes `t` and `id` the hit of a ray if they are nearer than what it has.
HWY_INLINE void keep_nearer(const HitSpan& hits, std::int64_t ray, double t, std::int64_t id) {
  Hit best{hits.t[ray], hits.sphere_id[ray]};
  best.keep_nearer(t, id);
  hits.t[ray] = best.t;
  hits.sphere_id[ray] = best.sphere_id;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_EXACT_DECISION_INL_H_
