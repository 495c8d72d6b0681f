// First test of a leaf: which of its spheres may a list of rays hit? Those that pass wait in the queue of candidates.
// One of three variants, by the number of spheres that a vector holds (measurements: docs/performance_findings.md).

#if defined(BIHIVE_WIDE_TRACE_LIST_LEAF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_LIST_LEAF_INL_H_
#undef BIHIVE_WIDE_TRACE_LIST_LEAF_INL_H_
#else
#define BIHIVE_WIDE_TRACE_LIST_LEAF_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/trace/filter_bounds.h"
#include "bihive/wide/trace/list_tile.h"
#include "bihive/wide/trace/sphere_filter-inl.h"
#include "bihive/wide/trace/tuning.h"
#include "bihive/wide/tree/radii-inl.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Up to sixteen spheres from `slot` on, and a list of rays of the tile.
struct LeafAndRays {
  const WideTree& tree;
  ListTile& tile;
  float e;  ///< FilterBounds
  std::uint32_t slot, spheres;
  const std::uint32_t* list;
  std::uint32_t count;

  HWY_INLINE const LocalRay& ray(std::uint32_t i) const { return tile.rays[list[i]]; }

  /// For the spheres from `lane` on: (r + e)^2, which nothing reaches past the leaf; ids; slots.
  HWY_INLINE Floats padded_squares(std::uint32_t lane) const {
    const FloatTag d;
    const auto r = hn::Add(load_radii(tree.spheres, slot + lane), in_all(e));
    return hn::IfThenElse(hn::FirstN(d, spheres - lane), hn::Mul(r, r), in_all(-1));
  }
  HWY_INLINE Words ids(std::uint32_t lane) const {
    const WordTag words;
    return hn::And(hn::LoadU(words, tree.spheres.word + slot + lane), hn::Set(words, tree.spheres.id_mask()));
  }
  HWY_INLINE Words slots(std::uint32_t lane) const { return iota_words(slot + lane); }
};

/// A ray in all lanes.
struct LeafRay {
  Floats nx, ny, nz, ox, oy, oz;
  HWY_INLINE explicit LeafRay(const LocalRay& ray)
      : nx(in_all(ray.direction[0])),
        ny(in_all(ray.direction[1])),
        nz(in_all(ray.direction[2])),
        ox(in_all(ray.origin[0])),
        oy(in_all(ray.origin[1])),
        oz(in_all(ray.origin[2])) {}
  HWY_INLINE Meeting to(Floats x, Floats y, Floats z, Floats r_squared) const {
    return meet(hn::Sub(x, ox), hn::Sub(y, oy), hn::Sub(z, oz), nx, ny, nz, r_squared);
  }
  /// The same numbers from memory. The vector from the centre is used, since the centre is then loaded by the
  /// subtraction itself; only the sign of b differs.
  HWY_INLINE Meeting to(const float* x, const float* y, const float* z, Floats r_squared) const {
    const FloatTag d;
    const Meeting met = meet(hn::Sub(ox, hn::LoadU(d, x)), hn::Sub(oy, hn::LoadU(d, y)), hn::Sub(oz, hn::LoadU(d, z)),
                             nx, ny, nz, r_squared);
    return {hn::Neg(met.b), met.dp};
  }
};

/// Going outward, a ray never meets the sphere that it exits.
HWY_INLINE FloatMask without_own(FloatMask passes, Words ids, std::uint32_t outward_id) {
  return hn::AndNot(hn::RebindMask(FloatTag(), hn::Eq(ids, hn::Set(WordTag(), outward_id))), passes);
}

/// Appends the lanes that pass to the queue; returns its new length. Branchless: whether any sphere passes is
/// unpredictable.
HWY_INLINE int queue_candidates(CandidateQueue& queue, int queued, FloatMask passes, const Meeting& met,
                                Floats r_squared, Words slots, std::uint32_t ray) {
  const FloatTag d;
  const WordTag words;
  const int passing = static_cast<int>(hn::CountTrue(d, passes));
  const auto b = compress(met.b, passes);
  const auto dp = compress(met.dp, passes);
  const auto some_r_squared = compress(r_squared, passes);
  const auto some_slots = compress(slots, hn::RebindMask(words, passes));
  const auto rays = hn::Set(words, ray);
  // More than four seldom pass, and short stores are faster.
  if (HWY_LIKELY(passing <= 4)) {
    store_four(b, queue.b + queued);
    store_four(dp, queue.dp + queued);
    store_four(some_r_squared, queue.r_squared + queued);
    store_four(some_slots, queue.slot + queued);
    store_four(rays, queue.ray + queued);
  } else {
    hn::StoreU(b, d, queue.b + queued);
    hn::StoreU(dp, d, queue.dp + queued);
    hn::StoreU(some_r_squared, d, queue.r_squared + queued);
    hn::StoreU(some_slots, words, queue.slot + queued);
    hn::StoreU(rays, words, queue.ray + queued);
  }
  return queued + passing;
}

/// Calls look(i, queued) for each ray of the list, which returns the new length of the queue; finish() empties a queue
/// that is full.
template <class Look, class Finish>
HWY_INLINE void for_each_ray(const LeafAndRays& leaf, const Finish& finish, const Look& look) {
  CandidateQueue& queue = leaf.tile.queue;
  int queued = queue.count;
  for (std::uint32_t i = 0; i < leaf.count; ++i) {
    __builtin_prefetch(&leaf.ray(std::min(i + kPrefetchDistance, leaf.count - 1)));
    queued = look(i, queued);
    if (HWY_UNLIKELY(queued >= kQueue)) {
      queue.count = queued;
      finish();
      queued = 0;
    }
  }
  queue.count = queued;
}

/// All the spheres in one vector, which stays in registers while the rays come.
template <bool kSkipOwn, class Finish>
HWY_INLINE void look_at_one_vector(const LeafAndRays& leaf, const Finish& finish) {
  const FloatTag d;
  const auto x = hn::LoadU(d, leaf.tree.spheres.x + leaf.slot);
  const auto y = hn::LoadU(d, leaf.tree.spheres.y + leaf.slot);
  const auto z = hn::LoadU(d, leaf.tree.spheres.z + leaf.slot);
  const auto r_squared = leaf.padded_squares(0);
  const auto slots = leaf.slots(0);
  const auto ids = leaf.ids(0);
  for_each_ray(leaf, finish, [&](std::uint32_t i, int queued) HWY_ATTR {
    const Meeting met = LeafRay(leaf.ray(i)).to(x, y, z, r_squared);
    auto passes = hn::Ge(met.dp, hn::Zero(d));
    if constexpr (kSkipOwn) passes = without_own(passes, ids, leaf.ray(i).outward_id);
    return queue_candidates(leaf.tile.queue, queued, passes, met, r_squared, slots, leaf.list[i]);
  });
}

/// A leaf, ready to be loaded vector by vector: loads are cheaper than broadcasting each ray once more.
struct alignas(64) LeafInMemory {
  const float *x, *y, *z;
  alignas(64) float r_squared[kWidth];
  alignas(64) std::uint32_t ids[kWidth], slots[kWidth];

  HWY_INLINE explicit LeafInMemory(const LeafAndRays& leaf)
      : x(leaf.tree.spheres.x + leaf.slot), y(leaf.tree.spheres.y + leaf.slot), z(leaf.tree.spheres.z + leaf.slot) {
    for (std::uint32_t lane = 0; lane < leaf.spheres; lane += kFloatLanes) {
      hn::Store(leaf.padded_squares(lane), FloatTag(), r_squared + lane);
      hn::Store(leaf.ids(lane), WordTag(), ids + lane);
      hn::Store(leaf.slots(lane), WordTag(), slots + lane);
    }
  }

  /// The position of a ray relative to the spheres from `lane` on, and which of them it may hit.
  template <bool kSkipOwn>
  HWY_INLINE Meeting meet_ray(const LeafRay& ray, std::uint32_t outward_id, std::uint32_t lane,
                              FloatMask& passes) const {
    const FloatTag d;
    const Meeting met = ray.to(x + lane, y + lane, z + lane, hn::Load(d, r_squared + lane));
    passes = hn::Ge(met.dp, hn::Zero(d));
    if constexpr (kSkipOwn) passes = without_own(passes, hn::Load(WordTag(), ids + lane), outward_id);
    return met;
  }
};

/// Ray after ray against one vector of spheres, or two.
template <bool kSkipOwn, std::uint32_t kVectors, class Finish>
HWY_INLINE void look_at_few_vectors(const LeafAndRays& leaf, const Finish& finish) {
  const LeafInMemory memory(leaf);
  for_each_ray(leaf, finish, [&](std::uint32_t i, int queued) HWY_ATTR {
    const LeafRay ray(leaf.ray(i));
    for (std::uint32_t lane = 0; lane < kVectors * kFloatLanes; lane += kFloatLanes) {
      FloatMask passes;
      const Meeting met = memory.meet_ray<kSkipOwn>(ray, leaf.ray(i).outward_id, lane, passes);
      queued = queue_candidates(leaf.tile.queue, queued, passes, met, hn::Load(FloatTag(), memory.r_squared + lane),
                                hn::Load(WordTag(), memory.slots + lane), leaf.list[i]);
    }
    return queued;
  });
}

/// Ray after ray against several short vectors of spheres, whose candidates are picked one by one.
template <bool kSkipOwn, class Finish>
HWY_INLINE void look_at_short_vectors(const LeafAndRays& leaf, const Finish& finish) {
  const LeafInMemory memory(leaf);
  CandidateQueue& queue = leaf.tile.queue;
  alignas(64) float b[kWidth];
  alignas(64) float dp[kWidth];
  for_each_ray(leaf, finish, [&](std::uint32_t i, int queued) HWY_ATTR {
    const LeafRay ray(leaf.ray(i));
    std::uint32_t bits = 0;
    for (std::uint32_t lane = 0; lane < leaf.spheres; lane += kFloatLanes) {
      FloatMask passes;
      const Meeting met = memory.meet_ray<kSkipOwn>(ray, leaf.ray(i).outward_id, lane, passes);
      bits |= mask_bits(passes) << lane;
      hn::Store(met.b, FloatTag(), b + lane);
      hn::Store(met.dp, FloatTag(), dp + lane);
    }
    for (; bits != 0; bits &= bits - 1) {
      const int k = __builtin_ctz(bits);
      queue.b[queued] = b[k];
      queue.dp[queued] = dp[k];
      queue.r_squared[queued] = memory.r_squared[k];
      queue.slot[queued] = memory.slots[k];
      queue.ray[queued] = leaf.list[i];
      ++queued;
    }
    return queued;
  });
}

/// One ray. The queue must have room for sixteen more.
template <bool kSkipOwn>
HWY_INLINE void look_at_pair(const LeafAndRays& leaf) {
  const FloatTag d;
  const WideSpheres& spheres = leaf.tree.spheres;
  const LeafRay ray(leaf.ray(0));
  CandidateQueue& queue = leaf.tile.queue;
  int queued = queue.count;
  for (std::uint32_t lane = 0; lane < leaf.spheres; lane += kFloatLanes) {
    const std::uint32_t slot = leaf.slot + lane;
    const auto r_squared = leaf.padded_squares(lane);
    const Meeting met = ray.to(spheres.x + slot, spheres.y + slot, spheres.z + slot, r_squared);
    auto passes = hn::Ge(met.dp, hn::Zero(d));
    if constexpr (kSkipOwn) passes = without_own(passes, leaf.ids(lane), leaf.ray(0).outward_id);
    queued = queue_candidates(queue, queued, passes, met, r_squared, leaf.slots(lane), leaf.list[0]);
  }
  queue.count = queued;
}

/// The rays against the spheres; finish() empties the queue of the tile. With kSkipOwn some ray may start on a sphere.
template <bool kSkipOwn, class Finish>
HWY_INLINE void look_at_leaf(const LeafAndRays& leaf, const Finish& finish) {
  if constexpr (kFloatLanes == kWidth) {
    look_at_one_vector<kSkipOwn>(leaf, finish);
  } else if constexpr (2 * kFloatLanes == kWidth) {
    if (leaf.spheres <= kFloatLanes)
      look_at_few_vectors<kSkipOwn, 1>(leaf, finish);
    else
      look_at_few_vectors<kSkipOwn, 2>(leaf, finish);
  } else {
    look_at_short_vectors<kSkipOwn>(leaf, finish);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_LIST_LEAF_INL_H_
