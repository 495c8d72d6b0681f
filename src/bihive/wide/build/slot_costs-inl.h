// Costs that decide which neighbours of the binary tree become one wide node, computed from the leaves up.
//
// Let F(v, k) be the least surface of wide nodes that the subtree v needs when it may take k slots of the wide node
// above it. A leaf needs none. Any other takes one slot as a wide node itself, or is split, and its sides share the
// slots:
//   S(v, k) = min over i of F(left, i) + F(right, k - i)
//   N(v)    = area(v) + S(v, 16)
//   F(v, k) = min(N(v), S(v, k)),  F(v, 1) = N(v)
// Every sum and comparison is one of binary32 in a fixed order, so each instruction set makes the same choices.

#if defined(BIHIVE_WIDE_BUILD_SLOT_COSTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_BUILD_SLOT_COSTS_INL_H_
#undef BIHIVE_WIDE_BUILD_SLOT_COSTS_INL_H_
#else
#define BIHIVE_WIDE_BUILD_SLOT_COSTS_INL_H_
#endif

#include <hwy/highway.h>

#include "bihive/math/infinity.h"
#include "bihive/wide/build/binary_tree.h"
#include "bihive/wide/build/bounds-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Sets the box and the costs of a node from its two sides.
HWY_INLINE void close_node(BinaryNode& node) {
  const FloatTag d;
  const BinaryNode& left = node.split->side[0];
  const BinaryNode& right = node.split->side[1];
  node.box = left.box;
  node.box.add(right.box);

  // The right side's costs, after sixteen infinite ones: shifted by i they line up with the sums with i slots.
  HWY_ALIGN float shifted[2 * kWidth];
  for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
    hn::Store(hn::Set(d, kInfiniteFloat), d, shifted + lane);
    hn::Store(right.is_leaf() ? hn::Zero(d) : hn::LoadU(d, right.split->cost + lane), d, shifted + kWidth + lane);
  }
  Floats sums[kWidth / kFloatLanes];
  for (int v = 0; v < kWidth / kFloatLanes; ++v) {
    const float* const past = shifted + kWidth + v * kFloatLanes;
    sums[v] = hn::LoadU(d, past - 1);
    if (left.is_leaf()) continue;
    sums[v] = hn::Add(sums[v], hn::Set(d, left.split->cost[0]));
    for (int i = 2; i < kWidth; ++i)
      sums[v] = hn::Min(sums[v], hn::Add(hn::LoadU(d, past - i), hn::Set(d, left.split->cost[i - 1])));
  }
  HWY_ALIGN float sum[kWidth];
  for (int v = 0; v < kWidth / kFloatLanes; ++v) hn::Store(sums[v], d, sum + v * kFloatLanes);
  const Floats as_node = hn::Set(d, half_area(node.box) + sum[kWidth - 1]);
  for (int v = 0; v < kWidth / kFloatLanes; ++v)
    hn::StoreU(hn::Min(as_node, sums[v]), d, node.split->cost + v * kFloatLanes);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_BUILD_SLOT_COSTS_INL_H_
