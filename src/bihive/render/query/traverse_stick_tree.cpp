#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/query/traverse_stick_tree.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bihive/render/query/stick_tree.h"
#include "bihive/render/query/waiting_children.h"
#include "bihive/simd/dispatch.h"
#include "bihive/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A ray in binary32, from where it enters the box around all sticks on: it starts at s = 0, and the largest part of its
// direction is 1. So all numbers are small, whatever the units, and planes moved outward by the pad (below) are moved
// by more than binary32 rounds.
struct LocalRay {
  double t_begin;                                   // where s is 0
  double s_of_t;                                    // s per t
  float inverse[3], near_offset[3], far_offset[3];  // distance to a plane: plane * inverse + offset
  bool is_backward[3];

  float s(double t) const {
    // Rounded up by more than the distances may be wrong: four roundings.
    constexpr double kMost = 0x1p40;
    return static_cast<float>(std::min((t - t_begin) * s_of_t * (1 + 0x1p-20), kMost));
  }
};

// False: the ray misses the box up to `limit`.
HWY_INLINE bool make_local(const Aabb& box, const ScaledRay& ray, double pad, double limit, LocalRay& local) {
  double in = ray.t_min, out = std::min(ray.t_max, limit), largest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double direction = ray.direction[axis];
    largest = std::max(largest, std::abs(direction));
    const double low = box.lo[axis] - pad - ray.origin[axis], high = box.hi[axis] + pad - ray.origin[axis];
    if (direction == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    in = std::max(in, (direction > 0 ? low : high) / direction);
    out = std::min(out, (direction > 0 ? high : low) / direction);
  }
  if (!(in <= out)) return false;
  local.t_begin = in;
  local.s_of_t = largest;
  for (int axis = 0; axis < 3; ++axis) {
    // A ray that goes along a plane stays beside it: within the box it moves by less than the pad.
    constexpr double kAlongPlane = 0x1p-40;
    const double direction = ray.direction[axis] / largest;
    local.is_backward[axis] = std::signbit(direction);
    const double inverse = 1 / (std::abs(direction) < kAlongPlane ? std::copysign(kAlongPlane, direction) : direction);
    const double origin = ray.origin[axis] + in * ray.direction[axis];
    const double outward = local.is_backward[axis] ? -pad : pad;
    local.inverse[axis] = static_cast<float>(inverse);
    local.near_offset[axis] = static_cast<float>(-(origin + outward) * inverse);
    local.far_offset[axis] = static_cast<float>(-(origin - outward) * inverse);
  }
  return true;
}

void traverse_on_target(const StickTree& tree, const ScaledRay& ray, double more_pad, StickTests& tests) {
  if (tree.nodes().empty()) return;
  // Beside what the boxes need, 2^-20: boxes end at 2, where a plane, an offset and their sum are rounded by 2^-23
  // each.
  const double farthest = std::max({std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)}) + 2.0;
  const double pad = 0x1p-20 + 0x1p-44 * farthest + more_pad;
  LocalRay local;  // NOLINT: written before read
  if (!make_local(tree.box(), ray, pad, tests.limit, local)) return;
  double limit = std::min(ray.t_max, tests.limit);
  float end = local.s(limit);

  WaitingChildren<float> waiting(tree.levels());
  std::int32_t at = 0;
  for (;;) {
    // Enter the node: which of the sixteen boxes does the ray enter, and where?
    const StickNode& node = tree.nodes()[static_cast<std::size_t>(at)];
    alignas(64) float s_in[kStickWidth];
    std::uint32_t entered = 0;
    for (int lane = 0; lane < kStickWidth; lane += kFloatLanes) {
      const FloatTag d;
      Floats in = in_all(0), out = in_all(end);
      for (int axis = 0; axis < 3; ++axis) {
        const float* const lo = node.lo[axis] + lane;
        const float* const hi = node.hi[axis] + lane;
        const Floats near = hn::Load(d, local.is_backward[axis] ? hi : lo);
        const Floats far = hn::Load(d, local.is_backward[axis] ? lo : hi);
        const Floats inverse = in_all(local.inverse[axis]);
        in = hn::Max(in, hn::MulAdd(near, inverse, in_all(local.near_offset[axis])));
        out = hn::Min(out, hn::MulAdd(far, inverse, in_all(local.far_offset[axis])));
      }
      hn::Store(in, d, s_in + lane);
      entered |= mask_bits(hn::Le(in, hn::Mul(out, in_all(1 + 0x1p-20F)))) << lane;
    }

    waiting.push(node, entered, s_in);

    // Take the next one that may matter; at the limit itself it may hold a smaller id.
    for (;;) {
      if (waiting.empty()) return;
      const auto next = waiting.pop();
      if (next.entry > end) continue;
      at = next.child;
      if (at >= 0) break;
      if (tests.test(std::int64_t{~at})) return;
      if (tests.limit < limit) {
        limit = tests.limit;
        end = local.s(limit);
      }
    }
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(traverse_on_target);

void traverse(const StickTree& tree, const ScaledRay& ray, double more_pad, StickTests& tests) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(traverse_on_target)(tree, ray, more_pad, tests);
}

}  // namespace bihive
#endif
