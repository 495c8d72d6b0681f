// Local rays of the binary32 filter, made from the caller's rays: wide/trace/filter_bounds.h says what a local ray is.
// One body serves every target.

#if defined(BIHIVE_WIDE_TRACE_LOCAL_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_LOCAL_RAYS_INL_H_
#undef BIHIVE_WIDE_TRACE_LOCAL_RAYS_INL_H_
#else
#define BIHIVE_WIDE_TRACE_LOCAL_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>
#include <limits>

#include "bihive/simd/wasm_float64-inl.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/filter_bounds.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The caller's rays, lane by lane, in binary64 and world units.
template <class D>
struct WorldLanes {
  hn::Vec<D> origin[3], direction[3];
  hn::Vec<D> t_min, t_max;
  bool has_segment;  ///< false: t_min is 0 and t_max +inf in all lanes, and neither is read
};

/// Local rays, lane by lane. A distance is s = t * length - shift, where `length` is in stored units.
template <class D>
struct LocalLanes {
  hn::Vec<D> origin[3], direction[3];
  hn::Vec<D> length, shift;
  hn::Vec<D> s_min, s_max;  ///< outside the segment by less than W / 2; s_max is -inf for a dead ray
  hn::Mask<D> alive;    ///< false: it hits nothing, since it is not valid or certainly misses everything; or too_far
  hn::Mask<D> too_far;  ///< it starts beyond kFarthestOrigin: not for the filter
};

namespace local_rays {

template <class D>
HWY_INLINE hn::Vec<D> largest_of(const hn::Vec<D> v[3]) {
  return hn::Max(hn::Max(hn::Abs(v[0]), hn::Abs(v[1])), hn::Abs(v[2]));
}

// Sets s_min and s_max: the segment along the unit direction, outward by more than its roundings.
template <class D>
HWY_INLINE void set_up_segment(D d, const WorldLanes<D>& world, LocalLanes<D>& local) {
  const auto farthest = hn::Set(d, double(kFarthestEnd));
  const auto slack = hn::Mul(hn::Abs(local.shift), hn::Set(d, 0x1p-46));
  const auto relative = hn::Set(d, 0x1p-22);
  local.s_min = hn::Neg(local.shift);
  local.s_max = farthest;
  if (world.has_segment) {
    local.alive = hn::And(local.alive, hn::Le(world.t_min, world.t_max));
    // Infinite ends become large finite ones, so that no operation sees two infinities.
    const auto large = hn::Set(d, 1e30);
    const auto cut = [&](auto s) HWY_ATTR { return hn::Min(hn::Max(s, hn::Neg(large)), large); };
    local.s_min = hn::Sub(cut(hn::Mul(world.t_min, local.length)), local.shift);
    const auto end = hn::Sub(cut(hn::Mul(world.t_max, local.length)), local.shift);
    local.s_max = hn::Min(farthest, hn::Add(end, hn::MulAdd(hn::Abs(end), relative, slack)));
    local.s_max = hn::Max(local.s_max, hn::Neg(farthest));
  }
  local.s_min = hn::Sub(local.s_min, hn::MulAdd(hn::Abs(local.s_min), relative, slack));
  local.s_min = hn::Min(hn::Max(local.s_min, hn::Neg(farthest)), farthest);
}

// Gives rays beyond the filter's range harmless numbers.
template <class D>
HWY_INLINE void calm_dead_rays(D d, LocalLanes<D>& local) {
  for (int axis = 0; axis < 3; ++axis) {
    local.origin[axis] = hn::IfThenElseZero(local.alive, local.origin[axis]);
    local.direction[axis] =
        hn::IfThenElse(local.alive, local.direction[axis], axis == 0 ? hn::Set(d, 1.0) : hn::Zero(d));
  }
  local.s_max = hn::IfThenElse(local.alive, local.s_max, hn::Set(d, -std::numeric_limits<double>::infinity()));
  local.s_min = hn::IfThenElseZero(local.alive, local.s_min);
}

}  // namespace local_rays

/// One body for vectors of rays and for a single one (a vector of one lane). Local rays are where the tree's nodes are:
/// before an image was moved away.
template <class D>
HWY_INLINE LocalLanes<D> local_lanes(D d, const WorldLanes<D>& world, const WideTree& tree) {
  const auto zero = hn::Zero(d);
  LocalLanes<D> local;

  // Bring the direction to length 1. Squares of binary32 stay finite and above 0 in binary64.
  const auto dx = world.direction[0];
  const auto dy = world.direction[1];
  const auto dz = world.direction[2];
  const auto squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
  const auto world_length = hn::Sqrt(squared);
  const auto inverse_length = hn::Div(hn::Set(d, 1.0), world_length);
  local.direction[0] = hn::Mul(dx, inverse_length);
  local.direction[1] = hn::Mul(dy, inverse_length);
  local.direction[2] = hn::Mul(dz, inverse_length);

  // Which rays are valid? Comparisons with NaN are false, and Max may drop one.
  const auto largest_float = hn::Set(d, double(std::numeric_limits<float>::max()));
  local.alive = hn::And(hn::Gt(squared, zero), hn::Le(squared, hn::Set(d, 1e80)));
  for (int axis = 0; axis < 3; ++axis)
    local.alive = hn::And(local.alive, hn::Le(hn::Abs(world.origin[axis]), largest_float));

  // Bring the origin to stored units, and move it to the point nearest to 0 if it is far.
  const auto stored = hn::Set(d, tree.scale);
  for (int axis = 0; axis < 3; ++axis) local.origin[axis] = hn::Mul(world.origin[axis], stored);
  if (HWY_UNLIKELY(tree.is_image))
    for (int axis = 0; axis < 3; ++axis) local.origin[axis] = hn::Sub(local.origin[axis], hn::Set(d, tree.shift[axis]));
  local.length = hn::Mul(world_length, stored);
  const auto size = local_rays::largest_of<D>(local.origin);
  local.too_far = hn::And(local.alive, hn::Gt(size, hn::Set(d, kFarthestOrigin)));
  local.shift = zero;
  const auto far_origin = hn::Set(d, kFarOrigin);
  const auto moved = hn::Gt(size, far_origin);
  if (HWY_UNLIKELY(!hn::AllFalse(d, moved))) {
    const auto along =
        hn::MulAdd(local.origin[0], local.direction[0],
                   hn::MulAdd(local.origin[1], local.direction[1], hn::Mul(local.origin[2], local.direction[2])));
    local.shift = hn::IfThenElseZero(moved, hn::Neg(along));
    for (int axis = 0; axis < 3; ++axis)
      local.origin[axis] = hn::MulAdd(local.shift, local.direction[axis], local.origin[axis]);
    // A line at this distance misses everything.
    local.alive = hn::And(local.alive, hn::Le(local_rays::largest_of<D>(local.origin), far_origin));
  }

  local_rays::set_up_segment(d, world, local);
  local.alive = hn::AndNot(local.too_far, local.alive);
  local_rays::calm_dead_rays(d, local);
  return local;
}

/// The factors of box tests along one axis: 1 / direction, finite, and the offset of LocalRay. Directions within
/// 1e-18 of the axis's plane are moved off it: over the 16 units to anything in the set that is less than any padding.
template <class D>
HWY_INLINE void box_factors(D d, hn::Vec<D> origin, hn::Vec<D> direction, hn::Vec<D>& inverse, hn::Vec<D>& offset) {
  // -0 becomes +0: the sign is that of a comparison with 0.
  const auto n = hn::Add(direction, hn::Zero(d));
  const auto clamped = hn::CopySign(hn::Max(hn::Abs(n), hn::Set(d, 1e-18F)), n);
  inverse = hn::Div(hn::Set(d, 1.0F), clamped);
  offset = hn::Neg(hn::Mul(origin, inverse));
}

/// Sixteen local rays as arrays.
struct alignas(64) LocalRays {
  float origin[3][16];
  float direction[3][16];
  float s_min[16], s_max[16];  ///< as of LocalLanes
  std::uint16_t dead;          ///< bit i: ray i is not alive
  std::uint16_t far;           ///< bit i: ray i is too far
  float farthest_origin;       ///< largest coordinate of an origin of rays that are not dead
};

/// Rays first to first + 15 of `rays`, all of which must exist.
HWY_INLINE void set_up_16(const RaySpan& rays, std::int64_t first, const WideTree& tree, LocalRays& out) {
  using Doubles = hn::CappedTag<double, 16>;
  using Half = hn::Rebind<float, Doubles>;
  const Doubles d;
  const Half h;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Doubles()));
  auto farthest = hn::Zero(d);
  std::uint32_t dead_bits = 0;
  std::uint32_t far_bits = 0;
  for (int lane = 0; lane < 16; lane += kLanes) {
    const std::int64_t i = first + lane;
    WorldLanes<Doubles> world;
    for (int axis = 0; axis < 3; ++axis) {
      world.origin[axis] = hn::PromoteTo(d, hn::LoadU(h, rays.origin[axis] + i));
      world.direction[axis] = hn::PromoteTo(d, hn::LoadU(h, rays.direction[axis] + i));
    }
    world.has_segment = rays.t_min != nullptr || rays.t_max != nullptr;
    world.t_min = rays.t_min != nullptr ? hn::LoadU(d, rays.t_min + i) : hn::Zero(d);
    world.t_max =
        rays.t_max != nullptr ? hn::LoadU(d, rays.t_max + i) : hn::Set(d, std::numeric_limits<double>::infinity());
    const auto local = local_lanes(d, world, tree);
    farthest = hn::Max(farthest, local_rays::largest_of<Doubles>(local.origin));
    for (int axis = 0; axis < 3; ++axis) {
      hn::Store(hn::DemoteTo(h, local.origin[axis]), h, out.origin[axis] + lane);
      hn::Store(hn::DemoteTo(h, local.direction[axis]), h, out.direction[axis] + lane);
    }
    hn::Store(hn::DemoteTo(h, local.s_min), h, out.s_min + lane);
    hn::Store(hn::DemoteTo(h, local.s_max), h, out.s_max + lane);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Not(local.alive), bits);
    dead_bits |= static_cast<std::uint32_t>(bits[0]) << lane;
    hn::StoreMaskBits(d, local.too_far, bits);
    far_bits |= static_cast<std::uint32_t>(bits[0]) << lane;
  }
  out.dead = static_cast<std::uint16_t>(dead_bits);
  out.far = static_cast<std::uint16_t>(far_bits);
  out.farthest_origin = static_cast<float>(hn::GetLane(hn::MaxOfLanes(d, farthest)));
}

/// As set_up_16() for the last `count` < 16 rays; the slots beyond are dead.
HWY_INLINE void set_up_tail(const RaySpan& rays, std::int64_t first, int count, const WideTree& tree, LocalRays& out) {
  float origin[3][16] = {};
  float direction[3][16] = {};  // zero directions are not valid
  double t_min[16] = {};
  double t_max[16] = {};
  RaySpan few = rays;
  few.count = 16;
  for (int i = 0; i < count; ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis][i] = rays.origin[axis][first + i];
      direction[axis][i] = rays.direction[axis][first + i];
    }
    if (rays.t_min != nullptr) t_min[i] = rays.t_min[first + i];
    if (rays.t_max != nullptr) t_max[i] = rays.t_max[first + i];
  }
  for (int axis = 0; axis < 3; ++axis) {
    few.origin[axis] = origin[axis];
    few.direction[axis] = direction[axis];
  }
  if (rays.t_min != nullptr) few.t_min = t_min;
  if (rays.t_max != nullptr) few.t_max = t_max;
  set_up_16(few, 0, tree, out);
}

namespace local_rays {

// Transposes four rays from number `i` on, from arrays of sixteen components to structures.
HWY_INLINE void write_four(const float* const components[16], int i, LocalRay* to) {
#if HWY_TARGET == HWY_SCALAR
  for (int ray = 0; ray < 4; ++ray) {
    float row[16];
    for (int k = 0; k < 16; ++k) std::memcpy(row + k, components[k] + i + ray, sizeof(float));
    std::memcpy(to + ray, row, sizeof(row));
  }
#else
  const hn::Full128<float> quad;
  const hn::Full128<double> two;
  const auto as_two = [&](auto v) HWY_ATTR { return hn::BitCast(two, v); };
  for (int k = 0; k < 16; k += 4) {
    const auto a = hn::Load(quad, components[k] + i);
    const auto b = hn::Load(quad, components[k + 1] + i);
    const auto c = hn::Load(quad, components[k + 2] + i);
    const auto e = hn::Load(quad, components[k + 3] + i);
    const auto ab_low = as_two(hn::InterleaveLower(quad, a, b));
    const auto ab_high = as_two(hn::InterleaveUpper(quad, a, b));
    const auto ce_low = as_two(hn::InterleaveLower(quad, c, e));
    const auto ce_high = as_two(hn::InterleaveUpper(quad, c, e));
    const auto store = [&](int ray, auto v)
                           HWY_ATTR { hn::Store(hn::BitCast(quad, v), quad, reinterpret_cast<float*>(to + ray) + k); };
    store(0, hn::InterleaveLower(two, ab_low, ce_low));
    store(1, hn::InterleaveUpper(two, ab_low, ce_low));
    store(2, hn::InterleaveLower(two, ab_high, ce_high));
    store(3, hn::InterleaveUpper(two, ab_high, ce_high));
  }
#endif
}

}  // namespace local_rays

/// Adds what box tests need and writes `count` of the sixteen rays, rounded up to a multiple of four, to to[0], to[1],
/// ..., with their outward_id.
HWY_INLINE void write_local_rays(const LocalRays& rays, const std::uint32_t outward[16], LocalRay* to, int count) {
  using Tag = hn::CappedTag<float, 16>;
  const Tag d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
  alignas(64) float inverse[3][16];
  alignas(64) float offset[3][16];
  for (int axis = 0; axis < 3; ++axis)
    for (int lane = 0; lane < 16; lane += kLanes) {
      hn::Vec<Tag> some_inverse, some_offset;
      box_factors(d, hn::Load(d, rays.origin[axis] + lane), hn::Load(d, rays.direction[axis] + lane), some_inverse,
                  some_offset);
      hn::Store(some_inverse, d, inverse[axis] + lane);
      hn::Store(some_offset, d, offset[axis] + lane);
    }
  // Ids are moved as bits.
  alignas(64) float outward_id[16];
  std::memcpy(outward_id, outward, sizeof(outward_id));
  const float* const unused = rays.s_min;
  const float* const components[16] = {rays.origin[0],    rays.origin[1],    rays.origin[2], rays.direction[0],
                                       rays.direction[1], rays.direction[2], inverse[0],     inverse[1],
                                       inverse[2],        offset[0],         offset[1],      offset[2],
                                       rays.s_min,        outward_id,        unused,         unused};
  static_assert(sizeof(LocalRay) == sizeof(float) * 16);
  for (int i = 0; i < count; i += 4) local_rays::write_four(components, i, to + i);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_LOCAL_RAYS_INL_H_
