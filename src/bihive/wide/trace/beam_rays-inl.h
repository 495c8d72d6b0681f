// The rays of a beam: up to 64 neighbours in local form (wide/trace/beam_bounds.h), as arrays. One body for every
// target.

#if defined(BIHIVE_WIDE_TRACE_BEAM_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_BEAM_RAYS_INL_H_
#undef BIHIVE_WIDE_TRACE_BEAM_RAYS_INL_H_
#else
#define BIHIVE_WIDE_TRACE_BEAM_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/ray_batch.h"
#include "bihive/wide/trace/beam_bounds.h"
#include "bihive/wide/trace/beams.h"
#include "bihive/wide/tree/left_sphere.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using wide::kBeamRays;
/// In a lane whose ray has no winner.
constexpr std::uint32_t kNoWinner = ~std::uint32_t{0};

/// The rays of a block. Lanes beyond the last ray repeat it.
struct alignas(64) BeamRays {
  float origin[3][kBeamRays];
  float direction[3][kBeamRays];
  float s_sure[kBeamRays];  ///< hits before this are surely in the segment and nearer than the winner
  float s_best[kBeamRays];  ///< hits beyond this are surely not the answer
  std::uint32_t
      winner_number[kBeamRays];  ///< of the nearest sure hit among the Winners (beam_winners-inl.h), or kNoWinner
  /// Of the sphere that the ray exits, or kNoSphere: its id, or if others coincide with it, the id of one of them. Not
  /// written unless the span says on which spheres rays start.
  std::uint32_t left_id[kBeamRays];
  /// The spheres that rays exit and others coincide with, each surface once, and the left_id of their rays.
  std::uint32_t left_slot[kBeamRays];
  std::uint32_t id_of_repeated[kBeamRays];
  int repeated_count;
  float e, pad;
  int count;   ///< rays in the block
  int major;   ///< axis along which all rays go, by at least kLeastMajor of their length
  float sign;  ///< +1 or -1: their direction along it
  bool common_origin;
};

namespace beam_rays {

// The arrays of a block's rays: slices of the span's, or copies padded to 64 rays.
struct Block {
  const float* origin[3];
  const float* direction[3];
  const double* t_max;
  const std::int64_t* leaves;
};

struct alignas(64) FilledUp {
  float origin[3][kBeamRays];
  float direction[3][kBeamRays];
  double t_max[kBeamRays];
  std::int64_t leaves[kBeamRays];

  void repeat_last(const RaySpan& rays, std::int64_t first, int count, Block& block) {
    for (int i = 0; i < kBeamRays; ++i) {
      const std::int64_t from = first + std::min(i, count - 1);
      for (int axis = 0; axis < 3; ++axis) {
        origin[axis][i] = rays.origin[axis][from];
        direction[axis][i] = rays.direction[axis][from];
      }
      if (rays.t_max != nullptr) t_max[i] = rays.t_max[from];
      if (rays.leaves != nullptr) leaves[i] = rays.leaves[from];
    }
    for (int axis = 0; axis < 3; ++axis) {
      block.origin[axis] = origin[axis];
      block.direction[axis] = direction[axis];
    }
    if (rays.t_max != nullptr) block.t_max = t_max;
    if (rays.leaves != nullptr) block.leaves = leaves;
  }
};

// Segments that start at t = 0, outward from any sphere: all others are not for beams.
HWY_INLINE bool plain_segments(const RaySpan& rays, std::int64_t first, int count) {
  if (rays.t_min != nullptr)
    for (int i = 0; i < count; ++i)
      if (rays.t_min[first + i] != 0) return false;
  if (rays.inside != nullptr) {
    unsigned any = 0;
    for (int i = 0; i < count; ++i) any |= rays.inside[first + i];
    if (any != 0) return false;
  }
  return true;
}

// The first ray determines the block's main axis.
HWY_INLINE void choose_major_axis(const Block& block, BeamRays& out) {
  const float size[3] = {std::abs(block.direction[0][0]), std::abs(block.direction[1][0]),
                         std::abs(block.direction[2][0])};
  out.major = size[0] > size[1] ? (size[0] > size[2] ? 0 : 2) : (size[1] > size[2] ? 1 : 2);
  out.sign = block.direction[out.major][0] < 0 ? -1.0F : 1.0F;
}

// Origins in the space of the tree's nodes: rounded to binary32 only after an image was moved back.
HWY_INLINE Floats before_image(Floats world, double scale, double shift) {
  using Doubles = hn::CappedTag<double, 16>;
  using Half = hn::Rebind<float, Doubles>;
  const Doubles w;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Doubles()));
  alignas(64) float values[kFloatLanes];
  hn::Store(world, FloatTag(), values);
  for (int i = 0; i < kFloatLanes; i += kLanes) {
    const auto stored = hn::Mul(hn::PromoteTo(w, hn::Load(Half(), values + i)), hn::Set(w, scale));
    hn::Store(hn::DemoteTo(Half(), hn::Sub(stored, hn::Set(w, shift))), Half(), values + i);
  }
  return hn::Load(FloatTag(), values);
}

// Origins in stored units; whether all rays start at one point. `farthest` becomes the largest coordinate. Returns the
// lanes whose origins are near enough.
HWY_INLINE FloatMask set_up_origins(const Block& block, const WideTree& tree, BeamRays& out, Floats& farthest) {
  const FloatTag d;
  const auto scales = hn::Set(d, static_cast<float>(tree.scale));
  farthest = hn::Zero(d);
  auto near = hn::Eq(scales, scales);
  auto common = near;
  for (int axis = 0; axis < 3; ++axis) {
    const auto first = hn::Set(d, block.origin[axis][0]);
    for (int lane = 0; lane < kBeamRays; lane += kFloatLanes) {
      const auto world = hn::LoadU(d, block.origin[axis] + lane);
      common = hn::And(common, hn::Eq(world, first));
      auto o = hn::Mul(world, scales);
      if (HWY_UNLIKELY(tree.is_image)) o = before_image(world, tree.scale, tree.shift[axis]);
      near = hn::And(near, hn::Le(hn::Abs(o), hn::Set(d, static_cast<float>(kFarOrigin))));
      farthest = hn::Max(farthest, hn::Abs(o));
      hn::Store(o, d, out.origin[axis] + lane);
    }
  }
  out.common_origin = hn::AllTrue(d, common);
  return near;
}

// Copies directions. Returns whether all have length 1 already.
HWY_INLINE bool copy_directions(const Block& block, BeamRays& out) {
  const FloatTag d;
  auto unit = hn::Eq(hn::Zero(d), hn::Zero(d));
  for (int lane = 0; lane < kBeamRays; lane += kFloatLanes) {
    const auto dx = hn::LoadU(d, block.direction[0] + lane);
    const auto dy = hn::LoadU(d, block.direction[1] + lane);
    const auto dz = hn::LoadU(d, block.direction[2] + lane);
    const auto beyond = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::MulAdd(dz, dz, hn::Set(d, -1.0F))));
    unit = hn::And(unit, hn::Le(hn::Abs(beyond), hn::Set(d, 3 * kUnit)));
    hn::Store(dx, d, out.direction[0] + lane);
    hn::Store(dy, d, out.direction[1] + lane);
    hn::Store(dz, d, out.direction[2] + lane);
  }
  return hn::AllTrue(d, unit);
}

// Normalizes the directions from `lane` on; `length` gets their former lengths. Returns the lanes whose length is
// neither extreme nor NaN.
HWY_INLINE FloatMask normalize_directions(BeamRays& out, int lane, Floats& length) {
  const FloatTag d;
  const auto dx = hn::Load(d, out.direction[0] + lane);
  const auto dy = hn::Load(d, out.direction[1] + lane);
  const auto dz = hn::Load(d, out.direction[2] + lane);
  const auto squared = hn::MulAdd(dx, dx, hn::MulAdd(dy, dy, hn::Mul(dz, dz)));
  length = hn::Sqrt(squared);
  const auto inverse = hn::Div(hn::Set(d, 1.0F), length);
  hn::Store(hn::Mul(dx, inverse), d, out.direction[0] + lane);
  hn::Store(hn::Mul(dy, inverse), d, out.direction[1] + lane);
  hn::Store(hn::Mul(dz, inverse), d, out.direction[2] + lane);
  return hn::And(hn::Ge(squared, hn::Set(d, 1e-20F)), hn::Le(squared, hn::Set(d, 1e20F)));
}

// The segments' ends from `lane` on, from both sides. Returns the lanes that have one.
HWY_INLINE FloatMask set_up_ends(const double* t_max, double scale, Floats length, BeamRays& out, int lane) {
  const FloatTag d;
  if (t_max == nullptr) {
    const auto no_end = hn::Set(d, kFarthestEnd);
    hn::Store(no_end, d, out.s_sure + lane);
    hn::Store(no_end, d, out.s_best + lane);
    return hn::Eq(no_end, no_end);
  }
  using Doubles = hn::CappedTag<double, 16>;
  using Half = hn::Rebind<float, Doubles>;
  const Doubles w;
  constexpr int kLanes = static_cast<int>(hn::MaxLanes(Doubles()));
  alignas(64) float lengths[kFloatLanes];
  hn::Store(length, d, lengths);
  for (int i = 0; i < kFloatLanes; i += kLanes) {
    const auto t = hn::LoadU(w, t_max + lane + i);
    const auto ends_late = hn::Ge(t, hn::Zero(w));  // false for NaN
    const auto s = hn::Mul(hn::Mul(t, hn::Set(w, scale)), hn::PromoteTo(w, hn::Load(Half(), lengths + i)));
    const auto end = hn::IfThenElse(ends_late, hn::Min(s, hn::Set(w, double(kFarthestEnd))), hn::Set(w, -1.0));
    hn::Store(hn::DemoteTo(Half(), end), Half(), out.s_best + lane + i);
  }
  const auto end = hn::Load(d, out.s_best + lane);
  hn::Store(hn::Mul(end, hn::Set(d, 1 - 0x1p-20F)), d, out.s_sure + lane);
  hn::Store(hn::Mul(end, hn::Set(d, 1 + 0x1p-20F)), d, out.s_best + lane);
  return hn::Ge(end, hn::Zero(d));
}

// The same id for all rays that exit one surface.
HWY_INLINE void unite_repeated(const std::int64_t* leaves, const WideTree& tree, BeamRays& out) {
  for (int i = 0; i < kBeamRays; ++i) {
    if (i > 0 && leaves[i] == leaves[i - 1]) {
      out.left_id[i] = out.left_id[i - 1];
      continue;
    }
    const RepeatedSphere* const sphere = LeftSphere(tree, leaves[i]).repeated();
    if (sphere == nullptr) continue;
    int k = 0;
    while (k < out.repeated_count && out.left_slot[k] != sphere->slot) ++k;
    if (k == out.repeated_count) {
      out.left_slot[k] = sphere->slot;
      out.id_of_repeated[k] = out.left_id[i];
      ++out.repeated_count;
    }
    out.left_id[i] = out.id_of_repeated[k];
  }
}

HWY_INLINE void set_up_left_spheres(const std::int64_t* leaves, const WideTree& tree, BeamRays& out) {
  for (int i = 0; i < kBeamRays; ++i) {
    const std::int64_t id = leaves[i];
    out.left_id[i] = id >= 0 && id < tree.size ? static_cast<std::uint32_t>(id) : kNoSphere;
  }
  if (HWY_UNLIKELY(!tree.repeated.empty())) unite_repeated(leaves, tree, out);
}

}  // namespace beam_rays

/// What BeamRays::left_id has for rays that exit the sphere of this slot.
HWY_INLINE std::uint32_t left_id_of(const WideTree& tree, const BeamRays& rays, std::uint32_t slot) {
  for (int i = 0; i < rays.repeated_count; ++i)
    if (coincide(tree, slot, rays.left_slot[i])) return rays.id_of_repeated[i];
  return static_cast<std::uint32_t>(tree.spheres.id(slot));
}

/// Prepares rays `first` to first + count - 1 (1 to 64) of a span. False: not suitable for a beam (not valid, far away,
/// of extreme length, not all along one axis, with segments that do not start at t = 0, or going into a sphere).
HWY_INLINE bool set_up_beam(const WideTree& tree, const RaySpan& rays, std::int64_t first, int count, BeamRays& out) {
  const FloatTag d;
  if (!beam_rays::plain_segments(rays, first, count)) return false;
  beam_rays::Block block{{rays.origin[0] + first, rays.origin[1] + first, rays.origin[2] + first},
                         {rays.direction[0] + first, rays.direction[1] + first, rays.direction[2] + first},
                         rays.t_max == nullptr ? nullptr : rays.t_max + first,
                         rays.leaves == nullptr ? nullptr : rays.leaves + first};
  beam_rays::FilledUp filled_up;
  if (HWY_UNLIKELY(count < kBeamRays)) filled_up.repeat_last(rays, first, count, block);
  out.count = count;

  // Origins, directions and ends.
  beam_rays::choose_major_axis(block, out);
  Floats farthest;
  auto valid = beam_rays::set_up_origins(block, tree, out, farthest);
  const bool unit = beam_rays::copy_directions(block, out);
  const auto least = hn::Set(d, kLeastMajor);
  const auto along = hn::Set(d, out.sign);
  for (int lane = 0; lane < kBeamRays; lane += kFloatLanes) {
    auto length = hn::Set(d, 1.0F);
    if (!unit) valid = hn::And(valid, beam_rays::normalize_directions(out, lane, length));
    valid = hn::And(valid, hn::Ge(hn::Mul(hn::Load(d, out.direction[out.major] + lane), along), least));
    valid = hn::And(valid, beam_rays::set_up_ends(block.t_max, tree.scale, length, out, lane));
  }
  if (HWY_UNLIKELY(!hn::AllTrue(d, valid))) return false;

  const BeamBounds bounds(hn::GetLane(hn::MaxOfLanes(d, farthest)), tree.is_image);
  out.e = bounds.e;
  out.pad = bounds.pad;
  out.repeated_count = 0;
  if (block.leaves != nullptr) beam_rays::set_up_left_spheres(block.leaves, tree, out);
  return true;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_BEAM_RAYS_INL_H_
