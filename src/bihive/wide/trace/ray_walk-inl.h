// Single-ray traversal: sixteen boxes or sixteen spheres per step.

#if defined(BIHIVE_WIDE_TRACE_RAY_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_RAY_WALK_INL_H_
#undef BIHIVE_WIDE_TRACE_RAY_WALK_INL_H_
#else
#define BIHIVE_WIDE_TRACE_RAY_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/trace/box_test-inl.h"
#include "bihive/wide/trace/filter_bounds.h"
#include "bihive/wide/trace/local_rays-inl.h"
#include "bihive/wide/trace/sphere_filter-inl.h"
#include "bihive/wide/tree/left_sphere.h"
#include "bihive/wide/tree/radii-inl.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The state of a ray: its local form, and what it has found.
struct SingleRay {
  LocalRay local;
  float near_offset[3];   ///< local.offset for planes where it enters boxes, as they are: a lower bound of the distance
  float far_offset[3];    ///< and for those where it exits them
  float s_best;           ///< upper bound of the current best hit; the segment's end at first
  float sure_min;         ///< roots from here on lie surely in the segment
  float e, width;         ///< FilterBounds
  std::uint32_t left_id;  ///< of the sphere that it exits
  bool inward;            ///< into it
  bool careful;           ///< it has equals, around left_centre: nothing is sure of them
  float left_centre[3];
  std::uint32_t winner;  ///< slot of the nearest sure hit, or kNoSlot

  HWY_INLINE void pad_offsets(float box_pad) {
    for (int axis = 0; axis < 3; ++axis) {
      const float pad = box_pad * std::abs(local.inverse[axis]);
      near_offset[axis] = local.offset[axis] - pad;
      far_offset[axis] = local.offset[axis] + pad;
    }
  }
};
/// The octant of a direction: bit k where it is negative along axis k.
HWY_INLINE int octant_of(const LocalRay& ray) {
  return (std::signbit(ray.inverse[0]) ? 1 : 0) | (std::signbit(ray.inverse[1]) ? 2 : 0) |
         (std::signbit(ray.inverse[2]) ? 4 : 0);
}

/// Children that a ray still has to enter, the next on top. Each is the number of its node times sixteen plus its
/// slot, and has a lower bound of the distance at which the ray enters it.
class WaitingChildren {
 public:
  bool empty() const { return count_ == 0; }
  void clear() { count_ = 0; }
  std::uint32_t pop() { return child_[--count_]; }

  /// Pushes the children that the ray may enter before s_best; the top is the nearest, or the farthest.
  template <bool kFarthestFirst>
  HWY_INLINE void push_entered(const WideNode& node, std::uint32_t number, const SingleRay& ray, int octant) {
    const FloatTag d;
    const bool backwards = (octant >= 4) != kFarthestFirst;
    const float* near[3];
    const float* far[3];
    for (int axis = 0; axis < 3; ++axis) {
      const bool negative = (octant >> axis & 1) != 0;
      near[axis] = negative ? node.hi[axis] : node.lo[axis];
      far[axis] = negative ? node.lo[axis] : node.hi[axis];
    }
    const BoxRay in_lanes(ray.local, ray.near_offset, ray.far_offset, ray.s_best);
    const auto test = [&](int lane, Floats& s_in) HWY_ATTR {
      const BoxLanes boxes(near, far, lane);
      s_in = in_lanes.entry(boxes);
      return hn::Le(s_in, in_lanes.exit(boxes));
    };
    const std::uint64_t order = node.order[octant >= 4 ? 7 - octant : octant];
    if constexpr (kFloatLanes == kWidth) {
      push_ordered(node, number, order, backwards, test);
    } else {
      // Sixteen children in several steps, then one after the other from the last to the first.
      alignas(64) float s_near[kWidth];
      std::uint32_t bits = 0;
      for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
        Floats s_in;
        bits |= mask_bits(test(lane, s_in)) << lane;
        hn::Store(s_in, d, s_near + lane);
      }
      if (bits == 0) return;
      for (int k = node.child_count - 1; k >= 0; --k) {
        const int place = backwards ? node.child_count - 1 - k : k;
        const auto slot = static_cast<std::uint32_t>(order >> (4 * place) & 15);
        child_[count_] = number * kWidth + slot;
        s_near_[count_] = s_near[slot];
        count_ += static_cast<int>(bits >> slot & 1);
      }
    }
  }

  /// Drops the children that start beyond s_best.
  HWY_INLINE void drop_beyond(float s_best) {
    const FloatTag d;
    const WordTag words;
    int kept = 0;
    for (int first = 0; first < count_; first += kFloatLanes) {
      const auto s_near = hn::LoadU(d, s_near_ + first);
      const auto child = hn::LoadU(words, child_ + first);
      const auto stays = hn::And(hn::Le(s_near, hn::Set(d, s_best)),
                                 hn::FirstN(d, static_cast<std::size_t>(std::min(count_ - first, kFloatLanes))));
      store_compressed(d, s_near, stays, s_near_ + kept);
      kept += static_cast<int>(store_compressed(words, child, hn::RebindMask(words, stays), child_ + kept));
    }
    count_ = kept;
  }

 private:
  // All sixteen at once: lanes from the last to the first, those that are entered moved to the front.
  template <class Test>
  HWY_INLINE void push_ordered(const WideNode& node, std::uint32_t number, std::uint64_t order, bool backwards,
                               const Test& test) {
    const FloatTag d;
    const WordTag words;
    alignas(64) static constexpr std::uint32_t kShiftsUp[kWidth] = {0, 4, 8, 12, 16, 20, 24, 28,
                                                                    0, 4, 8, 12, 16, 20, 24, 28};
    alignas(64) static constexpr std::uint32_t kShiftsDown[kWidth] = {28, 24, 20, 16, 12, 8, 4, 0,
                                                                      28, 24, 20, 16, 12, 8, 4, 0};
    auto s_in = hn::Zero(d);
    const std::uint32_t entered = mask_bits(test(0, s_in));
    const auto low = hn::Set(words, static_cast<std::uint32_t>(order));
    const auto high = hn::Set(words, static_cast<std::uint32_t>(order >> 32));
    const auto first_half = hn::FirstN(words, kWidth / 2);
    const auto count = static_cast<std::size_t>(node.child_count);
    const auto slot =
        hn::And(hn::Shr(backwards ? hn::IfThenElse(first_half, low, high) : hn::IfThenElse(first_half, high, low),
                        hn::Load(words, backwards ? kShiftsUp : kShiftsDown)),
                hn::Set(words, 15));
    const auto exists = backwards ? hn::FirstN(words, count) : hn::Not(hn::FirstN(words, kWidth - count));
    const auto stays =
        hn::And(exists, hn::Ne(hn::And(hn::Shr(hn::Set(words, entered), slot), hn::Set(words, 1)), hn::Zero(words)));
    const auto s_near = hn::TableLookupLanes(s_in, hn::IndicesFromVec(d, slot));
    store_compressed(d, s_near, hn::RebindMask(d, stays), s_near_ + count_);
    count_ += static_cast<int>(
        store_compressed(words, hn::Add(slot, hn::Set(words, number * kWidth)), stays, child_ + count_));
  }

  // Each level leaves at most fifteen waiting; vectors are stored whole.
  static constexpr int kRoom = kMostLevels * kWidth + 2 * kWidth;
  float s_near_[kRoom];
  std::uint32_t child_[kRoom];
  int count_ = 0;
};

/// Whether the sphere of this slot coincides with a ray's nearest sure hit so far, or kNoSlot. The ray meets both at
/// the same t, so the one with the smaller id becomes the winner, or stays it, and nothing is left to decide.
HWY_INLINE bool equals_winner(const WideTree& tree, std::uint32_t slot, std::uint32_t& winner) {
  if (winner == kNoSlot || !coincide(tree, slot, winner)) return false;
  if (tree.spheres.id(slot) < tree.spheres.id(winner)) winner = slot;
  return true;
}

/// Tests the spheres of a leaf. A sure hit becomes the winner; undecided(slot) gets each sphere that only binary64 can
/// decide, and returns true to end the traversal. Returns true if the traversal has ended.
template <bool kAnyHit, class Undecided>
HWY_INLINE bool test_leaf(const WideTree& tree, std::int64_t slot, std::int64_t spheres, SingleRay& ray,
                          const Undecided& undecided) {
  const FloatTag d;
  const WordTag words;
  const float* const n = ray.local.direction;
  const float* const o = ray.local.origin;
  for (std::int64_t lane = 0; lane < spheres; lane += kFloatLanes) {
    const std::int64_t first = slot + lane;
    const auto radius = hn::Add(load_radii(tree.spheres, first), in_all(ray.e));
    const auto r_squared = hn::Mul(radius, radius);
    Meeting met = meet(hn::Sub(hn::LoadU(d, tree.spheres.x + first), in_all(o[0])),
                       hn::Sub(hn::LoadU(d, tree.spheres.y + first), in_all(o[1])),
                       hn::Sub(hn::LoadU(d, tree.spheres.z + first), in_all(o[2])), in_all(n[0]), in_all(n[1]),
                       in_all(n[2]), r_squared);
    const auto passes = hn::And(hn::FirstN(d, static_cast<std::size_t>(spheres - lane)), hn::Ge(met.dp, hn::Zero(d)));
    if (hn::AllFalse(d, passes)) continue;

    // Which of them may be hit, and which surely are?
    met.dp = hn::Max(met.dp, hn::Zero(d));
    const auto none = hn::MaskFromVec(hn::Zero(d));
    auto own = none;
    if (ray.left_id != kNoSphere) {
      const auto id = hn::And(hn::LoadU(words, tree.spheres.word + first), hn::Set(words, tree.spheres.id_mask()));
      own = hn::RebindMask(d, hn::Eq(id, hn::Set(words, ray.left_id)));
    }
    auto judged = judge(met, r_squared, in_all(ray.s_best), in_all(ray.local.s_min), in_all(ray.sure_min), own,
                        ray.inward ? own : none, ray.e, ray.width);
    if (HWY_UNLIKELY(ray.careful)) {
      const auto equal = hn::And(hn::And(hn::Eq(hn::LoadU(d, tree.spheres.x + first), in_all(ray.left_centre[0])),
                                         hn::Eq(hn::LoadU(d, tree.spheres.y + first), in_all(ray.left_centre[1]))),
                                 hn::Eq(hn::LoadU(d, tree.spheres.z + first), in_all(ray.left_centre[2])));
      judged.sure = hn::AndNot(equal, judged.sure);
    }
    std::uint32_t bits = mask_bits(hn::And(passes, judged.keep));
    if (bits == 0) continue;
    const std::uint32_t sure = mask_bits(judged.sure);
    alignas(64) float starts[kFloatLanes];
    hn::Store(judged.start, d, starts);
    for (; bits != 0; bits &= bits - 1) {
      const int k = __builtin_ctz(bits);
      if (starts[k] > ray.s_best) continue;
      const auto candidate = static_cast<std::uint32_t>(first + k);
      if ((sure >> k & 1) != 0 && starts[k] < ray.s_best - 2 * ray.width) {
        ray.winner = candidate;
        if (kAnyHit) return true;
        ray.s_best = starts[k] + ray.width;
      } else if (!kAnyHit && (sure >> k & 1) != 0 && HWY_UNLIKELY(!tree.repeated.empty()) &&
                 equals_winner(tree, candidate, ray.winner)) {
        continue;
      } else if (undecided(candidate)) {
        return true;
      }
    }
  }
  return false;
}

/// A traversal in progress; the next node or leaf is prefetched. For any hit it starts at the far end:
/// docs/decisions/0013-any-hit-from-the-far-end.md.
class RayWalk {
 public:
  SingleRay ray;

  /// Starts at a node, once `ray` is ready.
  HWY_INLINE void begin(std::int64_t node) {
    octant_ = octant_of(ray.local);
    waiting_.clear();
    next_ = node;
    next_spheres_ = 0;
  }

  /// Visits one node or leaf; undecided() as for test_leaf(). False: the traversal has ended.
  template <bool kAnyHit, class Undecided>
  HWY_INLINE bool step(const WideTree& tree, const Undecided& undecided) {
    if (next_spheres_ == 0) {
      waiting_.push_entered<kAnyHit>(tree.nodes[next_], static_cast<std::uint32_t>(next_), ray, octant_);
    } else {
      const float before = ray.s_best;
      if (test_leaf<kAnyHit>(tree, next_, next_spheres_, ray, undecided)) return false;
      if (ray.s_best != before) waiting_.drop_beyond(ray.s_best);
    }
    return fetch_next(tree);
  }

 private:
  // Chooses the next node or leaf. False: none.
  HWY_INLINE bool fetch_next(const WideTree& tree) {
    if (waiting_.empty()) return false;
    const std::uint32_t child = waiting_.pop();
    const WideNode& node = tree.nodes[child / kWidth];
    const auto slot = static_cast<int>(child % kWidth);
    if (node.is_leaf(slot)) {
      next_ = node.sphere_begin(slot);
      next_spheres_ = static_cast<std::uint32_t>(node.sphere_count(slot));
      const auto fetch = [&](const auto* from) HWY_ATTR {
        __builtin_prefetch(from + next_);
        __builtin_prefetch(from + next_ + next_spheres_ - 1);
      };
      fetch(tree.spheres.x);
      fetch(tree.spheres.y);
      fetch(tree.spheres.z);
      fetch(tree.spheres.word);
      if (tree.spheres.r != nullptr) fetch(tree.spheres.r);
    } else {
      next_ = node.child_node(slot);
      next_spheres_ = 0;
      const char* const bytes = reinterpret_cast<const char*>(tree.nodes + next_);
      for (std::size_t line = 0; line < sizeof(WideNode); line += 64) __builtin_prefetch(bytes + line);
    }
    return true;
  }

  WaitingChildren waiting_;
  int octant_;
  std::int64_t next_;           // a node, or the slot of the first of some spheres
  std::uint32_t next_spheres_;  // 0: a node
};

/// Makes a valid ray ready. False: it certainly misses everything, or it starts beyond kFarthestOrigin. s = t * length
/// - shift.
HWY_INLINE bool set_up_single_ray(const Ray& world, const WideTree& tree, SingleRay& ray, double& length,
                                  double& shift) {
  using One = hn::CappedTag<double, 1>;
  const One d;
  WorldLanes<One> lanes;
  for (int axis = 0; axis < 3; ++axis) {
    lanes.origin[axis] = hn::Set(d, double(world.origin[axis]));
    lanes.direction[axis] = hn::Set(d, double(world.direction[axis]));
  }
  lanes.has_segment = true;
  lanes.t_min = hn::Set(d, world.t_min);
  lanes.t_max = hn::Set(d, world.t_max);
  const auto local = local_lanes(d, lanes, tree);
  if (hn::AllFalse(d, local.alive)) return false;

  length = hn::GetLane(local.length);
  shift = hn::GetLane(local.shift);
  const FilterBounds bounds(static_cast<float>(hn::GetLane(local_rays::largest_of<One>(local.origin))), tree.is_image);
  ray.e = bounds.e;
  ray.width = bounds.width;
  const hn::CappedTag<float, 1> f;
  for (int axis = 0; axis < 3; ++axis) {
    ray.local.origin[axis] = static_cast<float>(hn::GetLane(local.origin[axis]));
    ray.local.direction[axis] = static_cast<float>(hn::GetLane(local.direction[axis]));
    hn::Vec<decltype(f)> inverse, offset;
    box_factors(f, hn::Set(f, ray.local.origin[axis]), hn::Set(f, ray.local.direction[axis]), inverse, offset);
    ray.local.inverse[axis] = hn::GetLane(inverse);
    ray.local.offset[axis] = hn::GetLane(offset);
  }
  ray.pad_offsets(bounds.box_pad);
  ray.local.s_min = static_cast<float>(hn::GetLane(local.s_min));
  ray.sure_min = ray.local.s_min + ray.width;
  ray.s_best = static_cast<float>(hn::GetLane(local.s_max));
  ray.left_id = kNoSphere;
  ray.inward = false;
  ray.careful = false;
  ray.winner = kNoSlot;
  return true;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_RAY_WALK_INL_H_
