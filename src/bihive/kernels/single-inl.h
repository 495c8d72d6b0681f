// One ray against the wide tree: sixteen boxes or sixteen spheres at a time.

#if defined(BIHIVE_KERNELS_SINGLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_KERNELS_SINGLE_INL_H_
#undef BIHIVE_KERNELS_SINGLE_INL_H_
#else
#define BIHIVE_KERNELS_SINGLE_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/kernels/filter.h"
#include "bihive/kernels/lanes-inl.h"
#include "bihive/kernels/left_sphere.h"
#include "bihive/kernels/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// One ray ready for the filter, and what turns its hits into the tree's truth.
struct SingleRay {
  FilterRay local;
  float s_best;  ///< upper bound of the best hit so far; the segment's end at first
  float e;
  double length, shift;  ///< s = t length - shift

  /// A t as a distance, rounded up.
  float upper(double t) const {
    const double s = std::min(t * length, 1e30) - shift;
    return static_cast<float>(std::min(s + std::abs(s) * 0x1p-22 + std::abs(shift) * 0x1p-46, double(kFarthestEnd)));
  }
};

namespace single {

// A child that waits, with a lower bound of the distance at which the ray enters it.
struct Waiting {
  std::uint32_t node;   // number of a wide node, or of its first sphere
  std::uint32_t count;  // spheres; 0: a node
  float s_near;
};

/// The children that the ray may enter before s_best: a bit each, with lower bounds of the distances to `s_near`.
HWY_INLINE std::uint32_t hit_boxes(const WideNode& node, const SingleRay& ray, float s_near[kWidth]) {
  const FloatTag d;
  const float* planes[6];
  for (int axis = 0; axis < 3; ++axis) {
    const bool negative = std::signbit(ray.local.inverse[axis]);
    planes[2 * axis] = negative ? node.hi[axis] : node.lo[axis];
    planes[2 * axis + 1] = negative ? node.lo[axis] : node.hi[axis];
  }
  std::uint32_t bits = 0;
  for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
    auto s_in = hn::Set(d, ray.local.s_min);
    auto s_out = hn::Set(d, ray.s_best);
    for (int axis = 0; axis < 3; ++axis) {
      const auto inverse = hn::Set(d, ray.local.inverse[axis]);
      s_in = hn::Max(
          s_in, hn::MulAdd(hn::Load(d, planes[2 * axis] + lane), inverse, hn::Set(d, ray.local.near_offset[axis])));
      s_out = hn::Min(
          s_out, hn::MulAdd(hn::Load(d, planes[2 * axis + 1] + lane), inverse, hn::Set(d, ray.local.far_offset[axis])));
    }
    hn::Store(s_in, d, s_near + lane);
    bits |= mask_bits(hn::Le(s_in, s_out)) << lane;
  }
  return bits;
}

/// Lets the children in `bits` wait, the nearest on top.
HWY_INLINE void push_children(const WideNode& node, std::uint32_t bits, const float s_near[kWidth], Waiting* waiting,
                              int& count) {
  const int bottom = count;
  for (; bits != 0; bits &= bits - 1) {
    const int slot = __builtin_ctz(bits);
    int place = count++;
    while (place > bottom && waiting[place - 1].s_near < s_near[slot]) {
      waiting[place] = waiting[place - 1];
      --place;
    }
    if (node.is_leaf(slot))
      waiting[place] = {static_cast<std::uint32_t>(node.sphere_begin(slot)),
                        static_cast<std::uint32_t>(node.sphere_count(slot)), s_near[slot]};
    else
      waiting[place] = {static_cast<std::uint32_t>(node.child_node(slot)), 0, s_near[slot]};
  }
}

}  // namespace single

/// Calls candidate(slot) for every sphere of a leaf that the ray may hit before s_best, which candidate may lower.
/// Stops when it returns true, and returns that.
template <class Candidate>
HWY_INLINE bool for_each_candidate(const WideTree& tree, std::int64_t begin, std::int64_t count, const SingleRay& ray,
                                   const Candidate& candidate) {
  const FloatTag d;
  const auto ox = hn::Set(d, ray.local.origin[0]);
  const auto oy = hn::Set(d, ray.local.origin[1]);
  const auto oz = hn::Set(d, ray.local.origin[2]);
  const auto nx = hn::Set(d, ray.local.direction[0]);
  const auto ny = hn::Set(d, ray.local.direction[1]);
  const auto nz = hn::Set(d, ray.local.direction[2]);
  const auto e = hn::Set(d, ray.e);
  for (std::int64_t first = 0; first < count; first += kFloatLanes) {
    const std::int64_t slot = begin + first;
    const auto cx = hn::Sub(hn::LoadU(d, tree.spheres.x + slot), ox);
    const auto cy = hn::Sub(hn::LoadU(d, tree.spheres.y + slot), oy);
    const auto cz = hn::Sub(hn::LoadU(d, tree.spheres.z + slot), oz);
    const auto b = hn::MulAdd(cz, nz, hn::MulAdd(cy, ny, hn::Mul(cx, nx)));
    const auto px = hn::NegMulAdd(b, nx, cx);
    const auto py = hn::NegMulAdd(b, ny, cy);
    const auto pz = hn::NegMulAdd(b, nz, cz);
    const auto pp = hn::MulAdd(pz, pz, hn::MulAdd(py, py, hn::Mul(px, px)));
    const auto radius = hn::Add(load_radii(tree.spheres, slot), e);
    const auto dp = hn::NegMulAdd(hn::Set(d, 1.0F), pp, hn::Mul(radius, radius));
    const auto inside_set = hn::FirstN(d, static_cast<std::size_t>(std::min<std::int64_t>(count - first, kFloatLanes)));
    const auto passes = hn::And(inside_set, hn::Ge(dp, hn::Zero(d)));
    if (HWY_LIKELY(hn::AllFalse(d, passes))) continue;

    // Bounds of both roots: drop what lies behind the segment or beyond the best.
    const auto chord = hn::Sqrt(hn::Max(dp, hn::Zero(d)));
    const auto lower = hn::Sub(hn::Sub(b, e), chord);
    const auto upper = hn::Add(hn::Add(b, e), chord);
    std::uint32_t bits = mask_bits(
        hn::And(passes, hn::And(hn::Le(lower, hn::Set(d, ray.s_best)), hn::Ge(upper, hn::Set(d, ray.local.s_min)))));
    if (bits == 0) continue;
    alignas(64) float lowers[kFloatLanes];
    hn::Store(lower, d, lowers);
    for (; bits != 0; bits &= bits - 1) {
      const int k = __builtin_ctz(bits);
      if (lowers[k] <= ray.s_best && candidate(slot + k)) return true;
    }
  }
  return false;
}

/// The closest hit or, with kAnyHit, some hit of a valid ray that starts within kFarthestOrigin.
template <bool kAnyHit>
HWY_INLINE Hit trace_single(const WideTree& tree, const ScaledRay& exact_ray, const LeftSphere& left, SingleRay& ray) {
  Hit best;
  ScaledRay scaled = exact_ray;
  const auto candidate = [&](std::int64_t slot) {
    const Vec3d centre = tree.spheres.centre(slot);
    const double radius = tree.spheres.radius(slot);
    scaled.left_centre = centre;
    scaled.left_radius = left.is(tree, slot) ? radius : -1;
    best.keep_nearer(sphere_hit(scaled, centre, radius), tree.spheres.id(slot));
    if (!best.found()) return false;
    if (kAnyHit) return true;
    ray.s_best = std::min(ray.s_best, ray.upper(best.t));
    return false;
  };

  // Each level leaves at most fifteen children waiting.
  single::Waiting waiting[kMostLevels * kWidth];
  int waiting_count = 0;
  waiting[waiting_count++] = {0, 0, ray.local.s_min};
  alignas(64) float s_near[kWidth];
  while (waiting_count > 0) {
    const single::Waiting top = waiting[--waiting_count];
    if (top.s_near > ray.s_best) continue;
    if (top.count != 0) {
      if (for_each_candidate(tree, top.node, top.count, ray, candidate)) return best;
      continue;
    }

    const WideNode& node = tree.nodes[top.node];
    single::push_children(node, single::hit_boxes(node, ray, s_near), s_near, waiting, waiting_count);
  }
  return best;
}

/// Makes a ray ready. False: it certainly misses everything.
HWY_INLINE bool set_up_single(const ScaledRay& scaled, SingleRay& ray) {
  const double length = std::sqrt(scaled.direction_squared);
  Vec3d n = scaled.direction / length;
  Vec3d o = scaled.origin;
  double shift = 0;
  const auto size = [](Vec3d a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); };
  if (size(o) > kFarOrigin) {
    shift = -dot(o, n);
    o = o + shift * n;
    if (size(o) > kFarOrigin) return false;
  }
  const float farthest = static_cast<float>(size(o));
  const FilterBounds bounds(farthest);
  ray.e = bounds.e;
  ray.length = length;
  ray.shift = shift;
  for (int axis = 0; axis < 3; ++axis) {
    const auto origin = static_cast<float>(o[axis]);
    const auto direction = static_cast<float>(n[axis]);
    const float inverse = 1 / std::copysign(std::max(std::abs(direction), 1e-18F), direction);
    ray.local.origin[axis] = origin;
    ray.local.direction[axis] = direction;
    ray.local.inverse[axis] = inverse;
    ray.local.near_offset[axis] = -(origin * inverse + bounds.box_pad * std::abs(inverse));
    ray.local.far_offset[axis] = bounds.box_pad * std::abs(inverse) - origin * inverse;
  }
  const double start = std::clamp(scaled.t_min * length, -1e30, 1e30) - shift;
  const double lower = start - std::abs(start) * 0x1p-22 - std::abs(shift) * 0x1p-46;
  ray.local.s_min = static_cast<float>(std::clamp(lower, -double(kFarthestEnd), double(kFarthestEnd)));
  ray.s_best = std::max(ray.upper(scaled.t_max), -kFarthestEnd);
  return true;
}

/// The answer to one ray of the caller's.
template <bool kAnyHit>
HWY_INLINE Hit answer_single(const WideTree& tree, const Ray& world) {
  if (!is_valid(world) || tree.node_count == 0) return {};
  const ScaledRay scaled(world, tree.scale);
  const LeftSphere left(tree, world.leaves);
  const double farthest = std::max({std::abs(scaled.origin.x), std::abs(scaled.origin.y), std::abs(scaled.origin.z)});
  if (HWY_UNLIKELY(farthest > kFarthestOrigin)) return traverse_scalar<kAnyHit>(tree, scaled, left);
  SingleRay ray;
  if (!set_up_single(scaled, ray)) return {};
  return trace_single<kAnyHit>(tree, scaled, left, ray);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_KERNELS_SINGLE_INL_H_
