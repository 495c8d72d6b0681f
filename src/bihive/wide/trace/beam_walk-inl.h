// Beam traversal: a frustum is tested against sixteen boxes at a time, then against the spheres of the leaves that it
// enters.

#if defined(BIHIVE_WIDE_TRACE_BEAM_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_BEAM_WALK_INL_H_
#undef BIHIVE_WIDE_TRACE_BEAM_WALK_INL_H_
#else
#define BIHIVE_WIDE_TRACE_BEAM_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/trace/frustum-inl.h"
#include "bihive/wide/tree/radii-inl.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

namespace beam {

// A child that waits, with the least w at which a ray may enter it.
struct WaitingChild {
  std::uint32_t number;  // of a wide node, or of its first sphere
  std::uint32_t count;   // spheres; 0: a node
  float w_near;
};

HWY_INLINE WaitingChild child_of(const WideNode& node, int slot, float w_near) {
  if (!node.is_leaf(slot)) return {static_cast<std::uint32_t>(node.child_node(slot)), 0, w_near};
  return {static_cast<std::uint32_t>(node.sphere_begin(slot)), static_cast<std::uint32_t>(node.sphere_count(slot)),
          w_near};
}

}  // namespace beam

/// Traverses the tree in the order for directions of `octant`, from near to far if it is the frustum's own. Calls
/// leaf(first slot, spheres) for each leaf that the frustum meets before its w_end, which the callback may bring
/// nearer. The traversal ends when it returns true.
template <class Leaf>
HWY_INLINE void walk_beam(const WideTree& tree, const Frustum& frustum, int octant, const Leaf& leaf) {
  // Each level leaves at most fifteen children waiting.
  beam::WaitingChild waiting[kMostLevels * kWidth];
  int waiting_count = 0;
  waiting[waiting_count++] = {0, 0, frustum.w_begin};
  alignas(64) float w_near[kWidth];
  while (waiting_count > 0) {
    const beam::WaitingChild top = waiting[--waiting_count];
    if (top.w_near > frustum.w_end) continue;
    if (top.count != 0) {
      if (leaf(std::int64_t{top.number}, std::int64_t{top.count})) return;
      continue;
    }

    // Push the children that rays may enter, the next on top.
    const WideNode& node = tree.nodes[top.number];
    const std::uint32_t bits = boxes_in(node, frustum, w_near);
    if (bits == 0) continue;
    std::uint64_t order = 0;
    for (std::uint32_t places = near_to_far(node, octant, bits, order); places != 0;) {
      const int place = 31 - __builtin_clz(places);
      places ^= 1U << place;
      const int slot = static_cast<int>(order >> (4 * place) & 15);
      waiting[waiting_count++] = beam::child_of(node, slot, w_near[slot]);
    }
  }
}

/// Spheres `slot` to slot + kFloatLanes - 1 of a leaf, and which of them some ray of a frustum may hit.
struct SpheresInBeam {
  std::int64_t slot;
  Floats centre[3];
  Floats padded;  ///< r + e
  FloatMask inside;
  std::uint32_t bits;  ///< of `inside`; not 0
};

/// Calls visit(SpheresInBeam) for each vector of a leaf's spheres of which some lie in the frustum.
template <class Visit>
HWY_INLINE void spheres_of_leaf(const WideTree& tree, const Frustum& frustum, float e, std::int64_t first_slot,
                                std::int64_t count, const Visit& visit) {
  const FloatTag d;
  for (std::int64_t first = 0; first < count; first += kFloatLanes) {
    SpheresInBeam some;
    some.slot = first_slot + first;
    some.centre[0] = hn::LoadU(d, tree.spheres.x + some.slot);
    some.centre[1] = hn::LoadU(d, tree.spheres.y + some.slot);
    some.centre[2] = hn::LoadU(d, tree.spheres.z + some.slot);
    some.padded = hn::Add(load_radii(tree.spheres, some.slot), hn::Set(d, e));
    some.inside = spheres_in(frustum, some.centre, some.padded);
    if (count - first < kFloatLanes)
      some.inside = hn::And(some.inside, hn::FirstN(d, static_cast<std::size_t>(count - first)));
    some.bits = mask_bits(some.inside);
    if (some.bits != 0) visit(some);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_BEAM_WALK_INL_H_
