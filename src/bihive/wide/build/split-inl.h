// Builds a binary tree of a range of spheres: splits and leaves.

#if defined(BIHIVE_WIDE_BUILD_SPLIT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_BUILD_SPLIT_INL_H_
#undef BIHIVE_WIDE_BUILD_SPLIT_INL_H_
#else
#define BIHIVE_WIDE_BUILD_SPLIT_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <new>
#include <vector>

#include "bihive/wide/build/bounds-inl.h"
#include "bihive/wide/build/repeated.h"
#include "bihive/wide/build/slot_costs-inl.h"
#include "bihive/wide/build/split.h"
#include "bihive/wide/build/split_plane-inl.h"
#include "bihive/wide/build/tuning.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Half of the spheres, in whole subtrees of full leaves.
HWY_INLINE std::int64_t half_in_full_leaves(std::int64_t count, std::int64_t full_leaf) {
  std::int64_t unit = full_leaf;
  while (unit * kWidth <= count / 2) unit *= kWidth;
  return std::max(unit, (count / 2 + unit / 2) / unit * unit);
}

template <bool kPlainRadii>
class Splitter {
 public:
  Splitter(SplitContext& context, TaskList& list) : context_(context), list_(list), source_(*context.arena) {}

  void split(const SplitRange& range) {
    BinaryNode& node = *range.node;
    node.count = static_cast<std::uint32_t>(range.count);
    node.axis = 0;
    node.split = nullptr;
    if (range.count <= context_.full_leaf) return finish_leaf(range);
    if (range.count > kTaskSpheres && context_.cancelled()) return;

    // Find the longest side of the centres' box.
    const Vec3f side = range.centres.hi - range.centres.lo;
    const int axis = side.x >= side.y && side.x >= side.z ? 0 : side.y >= side.z ? 1 : 2;
    SplitRange left = range, right = range;
    left.depth = right.depth = range.depth + 1;
    if (side[axis] > 0) {
      split_at_plane(range, axis, left, right);
    } else {
      left.coincident = right.coincident = true;
      if (!range.coincident) note_equal(range);
      left.count = half_in_full_leaves(range.count, context_.full_leaf);
    }

    // Recurse into both sides, or turn one into a task.
    right.first = range.first + left.count;
    right.count = range.count - left.count;
    node.axis = static_cast<std::uint32_t>(axis);
    node.split = source_.next();
    left.node = &node.split->side[0];
    right.node = &node.split->side[1];
    if (left.count > kTaskSpheres && right.count > kTaskSpheres) {
      list_.add([&context = context_, right, &list = list_] { run(context, right, list); });
      split(left);
    } else {
      split(left);
      split(right);
    }
    if (range.count <= kTaskSpheres) close_node(node);
  }

  static void run(SplitContext& context, const SplitRange& range, TaskList& list) {
    if (context.out_of_memory || context.cancelled()) return;
    try {
      Splitter splitter(context, list);
      splitter.split(range);
      context.spheres_read += splitter.spheres_read_;
      const std::int64_t done = context.spheres_in_leaves += splitter.spheres_in_leaves_;
      if (context.work != nullptr)
        context.work->report(kShareBeforeSplit + (kShareAfterSplit - kShareBeforeSplit) * static_cast<double>(done) /
                                                     static_cast<double>(context.spheres));
      if (splitter.equal_.empty()) return;
      const std::lock_guard lock(context.mutex);
      context.equal.insert(context.equal.end(), splitter.equal_.begin(), splitter.equal_.end());
    } catch (const std::bad_alloc&) {
      context.out_of_memory = true;
    }
  }

 private:
  const SphereArrays& arrays(bool in_final) const { return in_final ? context_.final : context_.scratch; }

  // The surface of the box around spheres with these centres.
  float area(const Aabb& centres) const {
    const float r = context_.largest_radius;
    return half_area({centres.lo - Vec3f{r, r, r}, centres.hi + Vec3f{r, r, r}});
  }
  float cost(const Aabb& left, std::int64_t left_count, const Aabb& right, std::int64_t right_count) const {
    const std::int64_t full = context_.full_leaf;
    const std::int64_t left_leaves = (left_count + full - 1) / full;
    const std::int64_t right_leaves = (right_count + full - 1) / full;
    return area(left) * static_cast<float>(left_leaves) + area(right) * static_cast<float>(right_leaves);
  }

  // Partitions the spheres by a plane, and sets the ranges of both sides.
  void split_at_plane(const SplitRange& range, int axis, SplitRange& left, SplitRange& right) {
    const SphereArrays& from = arrays(range.in_final);
    const std::int64_t full = context_.full_leaf;
    const std::int64_t wanted = half_in_full_leaves(range.count, full);
    const auto by_count = [&]() HWY_ATTR {
      return plane_by_count(from, range.first, range.count, wanted, axis, range.centres);
    };
    bool boxes_known = false;
    std::int64_t passes = 0;
    SplitPlane plane;
    if (range.depth < kDeepestMidpoint) {
      // Halve the box. If no number lies between its sides, hi itself is the plane.
      const float lo = range.centres.lo[axis], hi = range.centres.hi[axis];
      plane.axis[0] = axis;
      plane.at[0] = lo + (hi - lo) * 0.5F;
      if (!(plane.at[0] > lo)) plane.at[0] = hi;
      plane.below = count_below(from, range.first, range.count, plane);
      ++passes;
      const std::int64_t above = range.count - plane.below;
      const bool two_leaves = plane.below <= full && above <= full;
      if (range.count <= kChoosingSpheres && plane.below != wanted && !two_leaves) {
        // Compare with full leaves.
        const SplitPlane other = by_count();
        Aabb other_left, other_right;
        split_boxes(from, range.first, range.count, plane, left.centres, right.centres);
        split_boxes(from, range.first, range.count, other, other_left, other_right);
        boxes_known = true;
        passes += other.passes + 2;
        if (cost(left.centres, plane.below, right.centres, above) >
            (range.count <= kLowestSpheres ? kLowestBias : kMidpointBias) *
                cost(other_left, other.below, other_right, range.count - other.below)) {
          plane = other;
          left.centres = other_left;
          right.centres = other_right;
        }
      }
    } else {
      plane = by_count();
      passes = plane.passes;
    }
    // The spheres are moved, and their boxes found.
    passes += boxes_known ? 1 : 2;
    spheres_read_ += passes * range.count;
    const SphereArrays& to = arrays(!range.in_final);
    partition<kPlainRadii>(from, to, range.first, range.count, plane);
    left.count = plane.below;
    left.in_final = right.in_final = !range.in_final;
    if (boxes_known) return;
    left.centres = centre_box(to, range.first, left.count);
    right.centres = centre_box(to, range.first + left.count, range.count - left.count);
  }

  HWY_INLINE Floats radii(const SphereArrays& from, std::int64_t i, FloatMask valid, bool whole, Words words) const {
    const FloatTag d;
    if (kPlainRadii) return load(d, from.r + i, valid, whole);
    const auto classes = hn::ShiftRight<WideSpheres::kIdBits>(words);
    return hn::GatherIndex(d, context_.palette, hn::BitCast(hn::RebindToSigned<WordTag>(), classes));
  }

  // Moves the spheres of a leaf to their final position, and finds their box and equal spheres.
  void finish_leaf(const SplitRange& range) {
    const FloatTag d;
    const WordTag dw;
    const SphereArrays& from = arrays(range.in_final);
    const SphereArrays& to = context_.final;
    HWY_ALIGN std::uint32_t hashes[kWidth];
    const bool is_small = range.count <= kWidth;
    spheres_read_ += range.count;
    spheres_in_leaves_ += range.count;
    GrowingBox box;
    for_lanes(range.count, [&](std::int64_t i, FloatMask valid, auto whole) HWY_ATTR {
      const std::int64_t at = range.first + i;
      const std::int64_t left = range.count - i;
      const Words words = load(dw, from.word + at, valid, whole);
      const Floats r = radii(from, at, valid, whole, words);
      Words hash = hn::Zero(dw);
      for (int axis = 0; axis < 3; ++axis) {
        const Floats c = load(d, from.axis(axis) + at, valid, whole);
        if (whole)
          box.add(axis, hn::Sub(c, r), hn::Add(c, r));
        else
          box.add_where(valid, axis, hn::Sub(c, r), hn::Add(c, r));
        if (!range.in_final) store_first(d, c, std::min<std::int64_t>(left, kFloatLanes), left, to.axis(axis) + at);
        constexpr std::uint32_t kOdd[3] = {0x9E3779B1U, 0x85EBCA77U, 0xC2B2AE3DU};
        hash = hn::Add(hash, hn::Mul(hn::BitCast(dw, hn::Add(c, hn::Zero(d))), hn::Set(dw, kOdd[axis])));
      }
      if (is_small) hn::Store(hash, dw, hashes + i);
      if (range.in_final) return;
      store_first(dw, words, std::min<std::int64_t>(left, kFloatLanes), left, to.word + at);
      if (kPlainRadii) store_first(d, r, std::min<std::int64_t>(left, kFloatLanes), left, to.r + at);
    });
    range.node->box = box.box();
    if (range.coincident || (is_small && all_differ(hashes, range.count))) return;
    SplitRange in_place = range;
    in_place.in_final = true;
    note_equal(in_place);
  }

  // Are the first `count` hashes different from each other?
  static HWY_INLINE bool all_differ(const std::uint32_t* hashes, std::int64_t count) {
    const WordTag dw;
    bool differ = true;
    for (int first = 0; first < count; first += kFloatLanes) {
      const Words mine = hn::Load(dw, hashes + first);
      Words equal = hn::Zero(dw);
      for (std::int64_t k = 0; k < count; ++k)
        equal = hn::Sub(equal, hn::VecFromMask(dw, hn::Eq(mine, hn::Set(dw, hashes[k]))));
      const auto several =
          hn::And(hn::Gt(equal, hn::Set(dw, 1)), hn::FirstN(dw, static_cast<std::size_t>(count - first)));
      differ = differ && hn::AllFalse(dw, several);
    }
    return differ;
  }

  void note_equal(const SplitRange& range) {
    spheres_read_ += passes_of_sorting(range.count) * range.count;
    find_equal(arrays(range.in_final), context_.palette, range.first, range.count, equal_);
  }

  SplitContext& context_;
  TaskList& list_;
  SplitSource source_;
  std::vector<EqualSphere> equal_;
  std::int64_t spheres_read_ = 0;
  std::int64_t spheres_in_leaves_ = 0;
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_BUILD_SPLIT_INL_H_
