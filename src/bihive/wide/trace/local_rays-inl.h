// From rays as the caller gives them to local rays of the binary32 filter (wide/trace/filter_bounds.h). One body for
// every target.

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

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Sixteen local rays as arrays.
struct alignas(64) LocalRays {
  float origin[3][16];
  float direction[3][16];
  float s_min[16], s_max[16];  ///< outside the segment by less than W / 2; s_max is -inf for a dead ray
  std::uint16_t dead;          ///< bit i: ray i hits nothing: it is not valid or certainly misses everything
  std::uint16_t far;           ///< bit i: ray i starts beyond kFarthestOrigin: not for the filter (dead here)
  float farthest_origin;       ///< largest coordinate of an origin of rays that are not dead
};

using DirectionTag = hn::CappedTag<double, 16>;
using HalfTag = hn::Rebind<float, DirectionTag>;

/// Rays first to first + 15 of `rays`, all of which must exist. `scale` is the tree's.
HWY_INLINE void set_up_16(const RaySpan& rays, std::int64_t first, double scale, LocalRays& out) {
  const DirectionTag d;
  const HalfTag h;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(DirectionTag()));
  const auto zero = hn::Zero(d);
  const auto far_limit = hn::Set(d, kFarthestOrigin);
  const auto largest_float = hn::Set(d, double(std::numeric_limits<float>::max()));
  auto farthest = zero;
  std::uint32_t dead_bits = 0;
  std::uint32_t far_bits = 0;

  for (int lane = 0; lane < 16; lane += kLanes) {
    const std::int64_t i = first + lane;
    const auto load = [&](const float* from) HWY_ATTR { return hn::PromoteTo(d, hn::LoadU(h, from + i)); };
    const auto dx = load(rays.direction[0]);
    const auto dy = load(rays.direction[1]);
    const auto dz = load(rays.direction[2]);
    const auto wx = load(rays.origin[0]);
    const auto wy = load(rays.origin[1]);
    const auto wz = load(rays.origin[2]);

    // Bring the direction to length 1. Squares of binary32 stay finite and above 0 in binary64.
    const auto squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
    const auto length = hn::Sqrt(squared);
    const auto inverse_length = hn::Div(hn::Set(d, 1.0), length);
    auto nx = hn::Mul(dx, inverse_length);
    auto ny = hn::Mul(dy, inverse_length);
    auto nz = hn::Mul(dz, inverse_length);

    // Which rays are valid? Comparisons with NaN are false.
    const auto spread = hn::Max(hn::Max(hn::Abs(wx), hn::Abs(wy)), hn::Abs(wz));
    const auto world_finite = hn::And(hn::Le(hn::Abs(wx), largest_float),
                                      hn::And(hn::Le(hn::Abs(wy), largest_float), hn::Le(hn::Abs(wz), largest_float)));
    auto alive = hn::And(hn::And(hn::Gt(squared, zero), hn::Le(squared, hn::Set(d, 1e80))), world_finite);

    // Bring the origin to stored units, and move it to the point nearest to 0 if it is far.
    const auto scaled = hn::Set(d, scale);
    auto ox = hn::Mul(wx, scaled);
    auto oy = hn::Mul(wy, scaled);
    auto oz = hn::Mul(wz, scaled);
    const auto size = hn::Mul(spread, scaled);
    const auto too_far = hn::And(alive, hn::Gt(size, far_limit));
    auto shift = zero;
    const auto moved = hn::Gt(size, hn::Set(d, kFarOrigin));
    if (HWY_UNLIKELY(!hn::AllFalse(d, moved))) {
      const auto along = hn::MulAdd(ox, nx, hn::MulAdd(oy, ny, hn::Mul(oz, nz)));
      shift = hn::IfThenElseZero(moved, hn::Neg(along));
      ox = hn::MulAdd(shift, nx, ox);
      oy = hn::MulAdd(shift, ny, oy);
      oz = hn::MulAdd(shift, nz, oz);
      // A line that stays this far away misses everything.
      const auto nearest = hn::Max(hn::Max(hn::Abs(ox), hn::Abs(oy)), hn::Abs(oz));
      alive = hn::And(alive, hn::Le(nearest, hn::Set(d, kFarOrigin)));
    }

    // The segment along the unit direction, outward by more than its roundings.
    auto s_min = hn::Neg(shift);
    auto s_max = hn::Set(d, double(kFarthestEnd));
    const auto scaled_length = hn::Mul(length, scaled);
    const auto slack = hn::Mul(hn::Abs(shift), hn::Set(d, 0x1p-46));
    const auto relative = hn::Set(d, 0x1p-22);
    if (rays.t_min != nullptr || rays.t_max != nullptr) {
      const auto t_min = rays.t_min != nullptr ? hn::LoadU(d, rays.t_min + i) : zero;
      const auto t_max =
          rays.t_max != nullptr ? hn::LoadU(d, rays.t_max + i) : hn::Set(d, std::numeric_limits<double>::infinity());
      alive = hn::And(alive, hn::Le(t_min, t_max));
      // Infinite ends become large ones, so that no infinity meets another.
      const auto large = hn::Set(d, 1e30);
      const auto cut = [&](auto s) HWY_ATTR { return hn::Min(hn::Max(s, hn::Neg(large)), large); };
      s_min = hn::Sub(cut(hn::Mul(t_min, scaled_length)), shift);
      const auto end = hn::Sub(cut(hn::Mul(t_max, scaled_length)), shift);
      s_max = hn::Min(s_max, hn::Add(end, hn::MulAdd(hn::Abs(end), relative, slack)));
      s_max = hn::Max(s_max, hn::Set(d, -double(kFarthestEnd)));
    }
    s_min = hn::Sub(s_min, hn::MulAdd(hn::Abs(s_min), relative, slack));
    s_min = hn::Min(hn::Max(s_min, hn::Set(d, -double(kFarthestEnd))), hn::Set(d, double(kFarthestEnd)));

    // Rays that are out of the filter's reach get harmless numbers.
    alive = hn::AndNot(too_far, alive);
    ox = hn::IfThenElseZero(alive, ox);
    oy = hn::IfThenElseZero(alive, oy);
    oz = hn::IfThenElseZero(alive, oz);
    const auto one = hn::Set(d, 1.0);
    nx = hn::IfThenElse(alive, nx, one);
    ny = hn::IfThenElseZero(alive, ny);
    nz = hn::IfThenElseZero(alive, nz);
    s_max = hn::IfThenElse(alive, s_max, hn::Set(d, -std::numeric_limits<double>::infinity()));
    s_min = hn::IfThenElseZero(alive, s_min);
    farthest = hn::Max(farthest, hn::Max(hn::Max(hn::Abs(ox), hn::Abs(oy)), hn::Abs(oz)));

    hn::Store(hn::DemoteTo(h, ox), h, out.origin[0] + lane);
    hn::Store(hn::DemoteTo(h, oy), h, out.origin[1] + lane);
    hn::Store(hn::DemoteTo(h, oz), h, out.origin[2] + lane);
    hn::Store(hn::DemoteTo(h, nx), h, out.direction[0] + lane);
    hn::Store(hn::DemoteTo(h, ny), h, out.direction[1] + lane);
    hn::Store(hn::DemoteTo(h, nz), h, out.direction[2] + lane);
    hn::Store(hn::DemoteTo(h, s_min), h, out.s_min + lane);
    hn::Store(hn::DemoteTo(h, s_max), h, out.s_max + lane);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hn::Not(alive), bits);
    dead_bits |= static_cast<std::uint32_t>(bits[0]) << lane;
    hn::StoreMaskBits(d, too_far, bits);
    far_bits |= static_cast<std::uint32_t>(bits[0]) << lane;
  }
  out.dead = static_cast<std::uint16_t>(dead_bits);
  out.far = static_cast<std::uint16_t>(far_bits);
  out.farthest_origin = static_cast<float>(hn::GetLane(hn::MaxOfLanes(d, farthest)));
}

/// As set_up_16() for the last `count` < 16 rays; the slots beyond are dead.
HWY_INLINE void set_up_tail(const RaySpan& rays, std::int64_t first, int count, double scale, LocalRays& out) {
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
  set_up_16(few, 0, scale, out);
}

/// Adds what box tests need and writes `count` of the sixteen rays, rounded up to a multiple of four, to to[0], to[1],
/// ..., with their outward_id. Directions within 1e-18 of an axis's plane are moved off it: over the 16 units to
/// anything in the set that is less than any padding.
HWY_INLINE void write_filter_rays(const LocalRays& rays, const std::uint32_t outward[16], FilterRay* to, int count) {
  using Tag = hn::CappedTag<float, 16>;
  const Tag d;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
  alignas(64) float inverse[3][16];
  alignas(64) float offset[3][16];
  const auto smallest = hn::Set(d, 1e-18F);
  for (int axis = 0; axis < 3; ++axis)
    for (int lane = 0; lane < 16; lane += kLanes) {
      // -0 becomes +0: a sign is what comparison with 0 says.
      const auto n = hn::Add(hn::Load(d, rays.direction[axis] + lane), hn::Zero(d));
      const auto clamped = hn::CopySign(hn::Max(hn::Abs(n), smallest), n);
      const auto inv = hn::Div(hn::Set(d, 1.0F), clamped);
      hn::Store(inv, d, inverse[axis] + lane);
      hn::Store(hn::Neg(hn::Mul(hn::Load(d, rays.origin[axis] + lane), inv)), d, offset[axis] + lane);
    }
  // Sixteen components of four rays at a time, from arrays to structures; ids as the bits that they are.
  alignas(64) float outward_id[16];
  std::memcpy(outward_id, outward, sizeof(outward_id));
  const float* const unused = rays.s_min;
  const float* const components[16] = {rays.origin[0],    rays.origin[1],    rays.origin[2], rays.direction[0],
                                       rays.direction[1], rays.direction[2], inverse[0],     inverse[1],
                                       inverse[2],        offset[0],         offset[1],      offset[2],
                                       rays.s_min,        outward_id,        unused,         unused};
  static_assert(sizeof(FilterRay) == sizeof(float) * 16);
#if HWY_TARGET == HWY_SCALAR
  for (int i = 0; i < count; ++i) {
    float row[16];
    for (int k = 0; k < 16; ++k) std::memcpy(row + k, components[k] + i, sizeof(float));
    std::memcpy(to + i, row, sizeof(row));
  }
#else
  const hn::Full128<float> quad;
  const hn::Full128<double> two;
  const auto as_two = [&](auto v) HWY_ATTR { return hn::BitCast(two, v); };
  for (int i = 0; i < count; i += 4)
    for (int k = 0; k < 16; k += 4) {
      const auto a = hn::Load(quad, components[k] + i);
      const auto b = hn::Load(quad, components[k + 1] + i);
      const auto c = hn::Load(quad, components[k + 2] + i);
      const auto e = hn::Load(quad, components[k + 3] + i);
      const auto ab_low = as_two(hn::InterleaveLower(quad, a, b));
      const auto ab_high = as_two(hn::InterleaveUpper(quad, a, b));
      const auto ce_low = as_two(hn::InterleaveLower(quad, c, e));
      const auto ce_high = as_two(hn::InterleaveUpper(quad, c, e));
      const auto store = [&](int ray, auto v) HWY_ATTR {
        hn::Store(hn::BitCast(quad, v), quad, reinterpret_cast<float*>(to + i + ray) + k);
      };
      store(0, hn::InterleaveLower(two, ab_low, ce_low));
      store(1, hn::InterleaveUpper(two, ab_low, ce_low));
      store(2, hn::InterleaveLower(two, ab_high, ce_high));
      store(3, hn::InterleaveUpper(two, ab_high, ce_high));
    }
#endif
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_LOCAL_RAYS_INL_H_
