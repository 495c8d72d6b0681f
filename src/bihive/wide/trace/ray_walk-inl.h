// One ray against the wide tree: sixteen boxes or sixteen spheres at a time.

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
#include <limits>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/geometry/sphere.h"
#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/trace/filter_bounds.h"
#include "bihive/wide/trace/scalar_walk.h"
#include "bihive/wide/tree/left_sphere.h"
#include "bihive/wide/tree/radii-inl.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A local ray on its way, and what it has found.
struct SingleRay {
  FilterRay local;
  float near_offset[3];   ///< local.offset for planes where it enters boxes, as they are: a lower bound of the distance
  float far_offset[3];    ///< and for those where it leaves them
  float s_best;           ///< upper bound of the best hit so far; the segment's end at first
  float sure_min;         ///< roots from here on lie surely in the segment
  float e, width;         ///< FilterBounds
  std::uint32_t left_id;  ///< of the sphere that it leaves
  bool inward;            ///< into it
  std::uint32_t winner;   ///< slot of the nearest sure hit

  HWY_INLINE void pad_offsets(float box_pad) {
    for (int axis = 0; axis < 3; ++axis) {
      const float pad = box_pad * std::abs(local.inverse[axis]);
      near_offset[axis] = local.offset[axis] - pad;
      far_offset[axis] = local.offset[axis] + pad;
    }
  }
};
constexpr std::uint32_t kNoWinner = std::numeric_limits<std::uint32_t>::max();

/// The octant of a direction: bit k where it is negative along axis k.
HWY_INLINE int octant_of(const FilterRay& ray) {
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

  /// Lets the children wait that the ray may enter before s_best; the next is the nearest, or the farthest.
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
    const auto test = [&](int lane, auto& s_in) HWY_ATTR {
      s_in = hn::Set(d, ray.local.s_min);
      auto s_out = hn::Set(d, ray.s_best);
      for (int axis = 0; axis < 3; ++axis) {
        const auto inverse = hn::Set(d, ray.local.inverse[axis]);
        s_in = hn::Max(s_in, hn::MulAdd(hn::Load(d, near[axis] + lane), inverse, hn::Set(d, ray.near_offset[axis])));
        s_out = hn::Min(s_out, hn::MulAdd(hn::Load(d, far[axis] + lane), inverse, hn::Set(d, ray.far_offset[axis])));
      }
      return hn::Le(s_in, s_out);
    };
    const std::uint64_t order = node.order[octant >= 4 ? 7 - octant : octant];
    if constexpr (kFloatLanes == kWidth) {
      push_ordered(node, number, order, backwards, test);
    } else {
      // Sixteen children in several steps, then one after the other from the last to the first.
      alignas(64) float s_near[kWidth];
      std::uint32_t bits = 0;
      for (int lane = 0; lane < kWidth; lane += kFloatLanes) {
        auto s_in = hn::Zero(d);
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

/// The second look at candidates of the filter, as vectors: bounds of the root that counts.
template <class V, class M>
struct Judged {
  V start;  ///< the root lies here or beyond; if `sure`, by less than W
  M keep;   ///< may be a hit before s_best
  M sure;   ///< surely a hit in the segment
};

/// `own`: the ray leaves the sphere; `inward`: into it. dp >= 0 in all lanes that matter.
template <class V, class M>
HWY_INLINE Judged<V, M> judge(V b, V dp, V r_squared, V s_best, V s_min, V sure_min, M own, M inward, float e,
                              float width) {
  const FloatTag d;
  const auto chord = hn::Sqrt(dp);
  const auto lower = hn::Sub(hn::Sub(b, hn::Set(d, e)), chord);
  const auto upper = hn::Add(hn::Add(b, hn::Set(d, e)), chord);
  const auto clear =
      hn::Ge(dp, hn::MulAdd(hn::Set(d, 0.04F), r_squared, hn::Mul(hn::Set(d, 4 * e), hn::Sqrt(hn::Abs(r_squared)))));

  // Where the near root surely lies before the segment, or is where the ray starts, the far root counts.
  const auto far_root = hn::And(clear, hn::Or(inward, hn::Lt(hn::Add(lower, hn::Set(d, width)), s_min)));
  Judged<V, M> judged;
  judged.start = hn::IfThenElse(far_root, hn::Sub(upper, hn::Set(d, width)), lower);
  // Going outward a ray never meets the sphere that it leaves.
  judged.keep = hn::AndNot(hn::AndNot(inward, own), hn::And(hn::Le(judged.start, s_best), hn::Ge(upper, s_min)));
  judged.sure = hn::And(hn::And(clear, hn::Ge(judged.start, sure_min)), hn::Or(far_root, hn::Not(inward)));
  return judged;
}

/// Tests up to sixteen spheres. A sure hit becomes the winner; rival(slot) gets what only binary64 can decide, and
/// returns true to end the walk. Returns true if the walk is at its end.
template <bool kAnyHit, class Rival>
HWY_INLINE bool test_leaf_single(const WideTree& tree, std::int64_t slot, std::int64_t spheres, SingleRay& ray,
                                 const Rival& rival) {
  const FloatTag d;
  const WordTag words;
  for (std::int64_t lane = 0; lane < spheres; lane += kFloatLanes) {
    const auto nx = hn::Set(d, ray.local.direction[0]);
    const auto ny = hn::Set(d, ray.local.direction[1]);
    const auto nz = hn::Set(d, ray.local.direction[2]);
    const auto cx = hn::Sub(hn::LoadU(d, tree.spheres.x + slot + lane), hn::Set(d, ray.local.origin[0]));
    const auto cy = hn::Sub(hn::LoadU(d, tree.spheres.y + slot + lane), hn::Set(d, ray.local.origin[1]));
    const auto cz = hn::Sub(hn::LoadU(d, tree.spheres.z + slot + lane), hn::Set(d, ray.local.origin[2]));
    const auto b = hn::MulAdd(cz, nz, hn::MulAdd(cy, ny, hn::Mul(cx, nx)));
    const auto px = hn::NegMulAdd(b, nx, cx);
    const auto py = hn::NegMulAdd(b, ny, cy);
    const auto pz = hn::NegMulAdd(b, nz, cz);
    const auto radius = hn::Add(load_radii(tree.spheres, slot + lane), hn::Set(d, ray.e));
    const auto r_squared = hn::Mul(radius, radius);
    const auto dp = hn::NegMulAdd(px, px, hn::NegMulAdd(py, py, hn::NegMulAdd(pz, pz, r_squared)));
    const auto passes = hn::And(hn::FirstN(d, static_cast<std::size_t>(spheres - lane)), hn::Ge(dp, hn::Zero(d)));
    if (hn::AllFalse(d, passes)) continue;

    const auto none = hn::MaskFromVec(hn::Zero(d));
    auto own = none;
    if (ray.left_id != kNoSphere) {
      const auto id =
          hn::And(hn::LoadU(words, tree.spheres.word + slot + lane), hn::Set(words, tree.spheres.id_mask()));
      own = hn::RebindMask(d, hn::Eq(id, hn::Set(words, ray.left_id)));
    }
    const auto judged =
        judge(b, hn::Max(dp, hn::Zero(d)), r_squared, hn::Set(d, ray.s_best), hn::Set(d, ray.local.s_min),
              hn::Set(d, ray.sure_min), own, ray.inward ? own : none, ray.e, ray.width);
    std::uint32_t bits = mask_bits(hn::And(passes, judged.keep));
    if (bits == 0) continue;
    const std::uint32_t sure = mask_bits(judged.sure);
    alignas(64) float starts[kFloatLanes];
    hn::Store(judged.start, d, starts);
    for (; bits != 0; bits &= bits - 1) {
      const int k = __builtin_ctz(bits);
      if (starts[k] > ray.s_best) continue;
      const auto candidate = static_cast<std::uint32_t>(slot + lane + k);
      if ((sure >> k & 1) != 0 && starts[k] < ray.s_best - 2 * ray.width) {
        ray.winner = candidate;
        if (kAnyHit) return true;
        ray.s_best = starts[k] + ray.width;
      } else if (rival(candidate)) {
        return true;
      }
    }
  }
  return false;
}

/// Walks from a node on. To any hit from the far end: docs/decisions/0013-any-hit-from-the-far-end.md.
template <bool kAnyHit, class Rival>
HWY_INLINE void walk_single(const WideTree& tree, std::uint32_t number, SingleRay& ray, WaitingChildren& waiting,
                            const Rival& rival) {
  const int octant = octant_of(ray.local);
  waiting.clear();
  waiting.push_entered<kAnyHit>(tree.nodes[number], number, ray, octant);
  while (!waiting.empty()) {
    const std::uint32_t child = waiting.pop();
    const WideNode& node = tree.nodes[child / kWidth];
    const auto slot = static_cast<int>(child % kWidth);
    if (!node.is_leaf(slot)) {
      const auto next = static_cast<std::uint32_t>(node.child_node(slot));
      waiting.push_entered<kAnyHit>(tree.nodes[next], next, ray, octant);
      continue;
    }
    const float before = ray.s_best;
    if (test_leaf_single<kAnyHit>(tree, node.sphere_begin(slot), node.sphere_count(slot), ray, rival)) return;
    if (ray.s_best != before) waiting.drop_beyond(ray.s_best);
  }
}

/// Makes a ray ready. False: it certainly misses everything. s = t * length - shift.
HWY_INLINE bool set_up_single(const ScaledRay& scaled, SingleRay& ray, double& length, double& shift) {
  length = std::sqrt(scaled.direction_squared);
  const double inverse_length = 1 / length;
  const Vec3d n = scaled.direction * inverse_length;
  Vec3d o = scaled.origin;
  shift = 0;
  const auto size = [](Vec3d a) { return std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}); };
  if (size(o) > kFarOrigin) {
    shift = -dot(o, n);
    o = o + shift * n;
    if (size(o) > kFarOrigin) return false;
  }
  const FilterBounds bounds(static_cast<float>(size(o)));
  ray.e = bounds.e;
  ray.width = bounds.width;
  for (int axis = 0; axis < 3; ++axis) {
    const auto origin = static_cast<float>(o[axis]);
    const auto direction = static_cast<float>(n[axis]);
    const float inverse = 1 / std::copysign(std::max(std::abs(direction), 1e-18F), direction);
    ray.local.origin[axis] = origin;
    ray.local.direction[axis] = direction;
    ray.local.inverse[axis] = inverse;
    ray.local.offset[axis] = -(origin * inverse);
  }
  ray.pad_offsets(bounds.box_pad);
  const double start = std::clamp(scaled.t_min * length, -1e30, 1e30) - shift;
  const double lower = start - std::abs(start) * 0x1p-22 - std::abs(shift) * 0x1p-46;
  ray.local.s_min = static_cast<float>(std::clamp(lower, -double(kFarthestEnd), double(kFarthestEnd)));
  ray.sure_min = ray.local.s_min + ray.width;
  ray.s_best = upper_distance(scaled.t_max, length, shift);
  ray.left_id = kNoSphere;
  ray.inward = false;
  ray.winner = kNoWinner;
  return true;
}

/// The answer to one ray of the caller's.
template <bool kAnyHit>
HWY_INLINE Hit answer_single(const WideTree& tree, const Ray& world) {
  if (!is_valid(world) || tree.node_count == 0) return {};
  ScaledRay scaled(world, tree.scale);
  const LeftSphere left(tree, world.leaves);
  const double farthest = std::max({std::abs(scaled.origin.x), std::abs(scaled.origin.y), std::abs(scaled.origin.z)});
  if (HWY_UNLIKELY(farthest > kFarthestOrigin)) return traverse_scalar<kAnyHit>(tree, scaled, left);
  SingleRay ray;
  double length = 0;
  double shift = 0;
  if (!set_up_single(scaled, ray, length, shift)) return {};
  if (world.leaves >= 0 && world.leaves < std::int64_t{kNoSphere}) {
    ray.left_id = static_cast<std::uint32_t>(world.leaves);
    ray.inward = world.inside;
    if (left.is_repeated()) ray.sure_min = std::numeric_limits<float>::infinity();
  }

  // Rivals are settled at once, the winner at the end.
  Hit best;
  const auto settle = [&](std::uint32_t slot) {
    const Vec3d centre = tree.spheres.centre(slot);
    const double radius = tree.spheres.radius(slot);
    scaled.left_centre = centre;
    scaled.left_radius = left.is(tree, slot) ? radius : -1;
    best.keep_nearer(sphere_hit(scaled, centre, radius), tree.spheres.id(slot));
    if (!best.found()) return false;
    if (kAnyHit) return true;
    ray.s_best = std::min(ray.s_best, upper_distance(best.t, length, shift));
    return false;
  };
  WaitingChildren waiting;  // NOLINT: written before read
  walk_single<kAnyHit>(tree, 0, ray, waiting, settle);
  if (ray.winner != kNoWinner) {
    if (kAnyHit) return {0, tree.spheres.id(ray.winner)};
    settle(ray.winner);
  }
  return best;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_RAY_WALK_INL_H_
