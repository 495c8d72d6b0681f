#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/query/traverse_stick_tree.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/render/query/stick_tree.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// A ray's distances to planes across an axis: plane * inverse + offset. Planes are moved outward by the pad of Slabs
// (bih/traversal.h), which is many times the rounding here.
struct SlabOfRay {
  double inverse, near_offset, far_offset;
  bool is_backward;

  SlabOfRay(double origin, double direction, double pad) : is_backward(std::signbit(direction)) {
    // Along a plane: so long that all planes but those within the pad are beyond any segment's end.
    constexpr double kAlongPlane = 0x1p500;
    inverse = direction == 0 ? std::copysign(kAlongPlane, direction) : 1 / direction;
    const double outward = is_backward ? -pad : pad;
    near_offset = -(origin + outward) * inverse;
    far_offset = -(origin - outward) * inverse;
  }
};

void traverse_on_target(const StickTree& tree, const ScaledRay& ray, double more_pad, StickTests& tests) {
  if (tree.nodes().empty()) return;
  const double farthest = std::max({std::abs(ray.origin.x), std::abs(ray.origin.y), std::abs(ray.origin.z)}) + 2.0;
  const double pad = 0x1p-24 + 0x1p-46 * farthest + more_pad;
  const SlabOfRay slabs[3] = {
      {ray.origin.x, ray.direction.x, pad}, {ray.origin.y, ray.direction.y, pad}, {ray.origin.z, ray.direction.z, pad}};

  // Each level leaves at most fifteen children waiting. Deep trees are rare.
  constexpr int kFewLevels = 48;
  struct Waiting {
    double t;
    std::int32_t child;
  };
  Waiting of_few[kFewLevels * kStickWidth];  // NOLINT: written before read
  std::vector<Waiting> of_many;
  if (tree.levels() > kFewLevels) of_many.resize(static_cast<std::size_t>(tree.levels()) * kStickWidth);
  Waiting* const waiting = of_many.empty() ? of_few : of_many.data();
  int count = 0;
  std::int32_t at = 0;
  for (;;) {
    // Enter the node: which of the sixteen boxes does the ray enter, and where?
    const StickNode& node = tree.nodes()[static_cast<std::size_t>(at)];
    alignas(64) double t_in[kStickWidth];
    std::uint32_t entered = 0;
    for (int lane = 0; lane < kStickWidth; lane += kLanes) {
      Lanes in = all(ray.t_min), out = all(std::min(ray.t_max, tests.limit));
      for (int axis = 0; axis < 3; ++axis) {
        const SlabOfRay& slab = slabs[axis];
        const float* const lo = node.lo[axis] + lane;
        const float* const hi = node.hi[axis] + lane;
        const Lanes near = hn::PromoteTo(Tag(), hn::LoadU(FloatHalf(), slab.is_backward ? hi : lo));
        const Lanes far = hn::PromoteTo(Tag(), hn::LoadU(FloatHalf(), slab.is_backward ? lo : hi));
        in = hn::Max(in, hn::MulAdd(near, all(slab.inverse), all(slab.near_offset)));
        out = hn::Min(out, hn::MulAdd(far, all(slab.inverse), all(slab.far_offset)));
      }
      hn::StoreU(in, Tag(), t_in + lane);
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(Tag(), hn::Le(in, out), bits);
      entered |= static_cast<std::uint32_t>(bits[0]) << lane;
    }

    // They wait, the nearest on top.
    const int first = count;
    for (; entered != 0; entered &= entered - 1) {
      const int slot = __builtin_ctz(entered);
      int place = count++;
      for (; place > first && waiting[place - 1].t < t_in[slot]; --place) waiting[place] = waiting[place - 1];
      waiting[place] = {t_in[slot], node.child[slot]};
    }

    // Take the next one that may matter; at the limit itself it may hold a smaller id.
    for (;;) {
      if (count == 0) return;
      const Waiting next = waiting[--count];
      if (next.t > tests.limit) continue;
      at = next.child;
      if (at >= 0) break;
      if (tests.test(std::int64_t{~at})) return;
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
