// Split planes: which spheres are below, how many, and the plane that leaves a given number below.

#if defined(BIHIVE_WIDE_BUILD_SPLIT_PLANE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_BUILD_SPLIT_PLANE_INL_H_
#undef BIHIVE_WIDE_BUILD_SPLIT_PLANE_INL_H_
#else
#define BIHIVE_WIDE_BUILD_SPLIT_PLANE_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <cstring>
#include <limits>

#include "bihive/wide/build/bounds-inl.h"
#include "bihive/wide/build/tuning.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A plane across axis[0]. Where `ties` is set, a second plane across axis[1] splits the centres that lie
/// on it, and a third one those on both: so any number can be split off, though never equal centres.
struct SplitPlane {
  int axis[3] = {};
  float at[3] = {};
  bool ties = false;
  std::int64_t below = 0;  ///< how many centres are below
  int passes = 0;          ///< over all centres, to find it
};

/// The lanes below a plane; `centre(axis)` loads a coordinate.
template <bool kTies, class Centre>
HWY_INLINE FloatMask lanes_below(const SplitPlane& plane, const Centre& centre) {
  const FloatTag d;
  const Floats c0 = centre(plane.axis[0]);
  const Floats at0 = hn::Set(d, plane.at[0]);
  FloatMask below = hn::Lt(c0, at0);
  if (!kTies) return below;
  const Floats c1 = centre(plane.axis[1]);
  const Floats at1 = hn::Set(d, plane.at[1]);
  const FloatMask on_both = hn::And(hn::Eq(c0, at0), hn::Eq(c1, at1));
  below = hn::Or(below, hn::And(hn::Eq(c0, at0), hn::Lt(c1, at1)));
  return hn::Or(below, hn::And(on_both, hn::Lt(centre(plane.axis[2]), hn::Set(d, plane.at[2]))));
}

/// Calls body(std::true_type or std::false_type) for the kind of plane.
template <class Body>
HWY_INLINE void by_ties(const SplitPlane& plane, const Body& body) {
  if (plane.ties)
    body(std::true_type());
  else
    body(std::false_type());
}

/// The number of centres of a range below the plane.
HWY_INLINE std::int64_t count_below(const SphereArrays& spheres, std::int64_t first, std::int64_t count,
                                    const SplitPlane& plane) {
  const FloatTag d;
  std::size_t below = 0;
  by_ties(plane, [&](auto ties) HWY_ATTR {
    for_lanes(count, [&](std::int64_t i, FloatMask valid, auto whole) HWY_ATTR {
      const auto centre = [&](int axis) HWY_ATTR { return load(d, spheres.axis(axis) + first + i, valid, whole); };
      below += hn::CountTrue(d, hn::And(lanes_below<decltype(ties)::value>(plane, centre), valid));
    });
  });
  return static_cast<std::int64_t>(below);
}

/// The boxes of the centres below a plane, and of the others.
HWY_INLINE void split_boxes(const SphereArrays& spheres, std::int64_t first, std::int64_t count,
                            const SplitPlane& plane, Aabb& left, Aabb& right) {
  const FloatTag d;
  GrowingBox below, above;
  by_ties(plane, [&](auto ties) HWY_ATTR {
    for_lanes(count, [&](std::int64_t i, FloatMask valid, auto whole) HWY_ATTR {
      const auto centre = [&](int axis) HWY_ATTR { return load(d, spheres.axis(axis) + first + i, valid, whole); };
      const FloatMask is_below = lanes_below<decltype(ties)::value>(plane, centre);
      const FloatMask left_lanes = hn::And(is_below, valid);
      const FloatMask right_lanes = hn::AndNot(is_below, valid);
      for (int axis = 0; axis < 3; ++axis) {
        const Floats c = centre(axis);
        below.add_where(left_lanes, axis, c, c);
        above.add_where(right_lanes, axis, c, c);
      }
    });
  });
  left = below.box();
  right = above.box();
}

/// Moves spheres below the plane to the front of the same range of `to`, the others after them. Stable.
template <bool kPlainRadii>
HWY_INLINE void partition(const SphereArrays& from, const SphereArrays& to, std::int64_t first, std::int64_t count,
                          const SplitPlane& plane) {
  const FloatTag d;
  const WordTag dw;
  const Words lane_numbers = iota_words(0);
  std::int64_t left = first;
  std::int64_t right = first + plane.below;
  const std::int64_t left_end = right;
  const std::int64_t right_end = first + count;
  by_ties(plane, [&](auto ties) HWY_ATTR {
    for_lanes(count, [&](std::int64_t i, FloatMask valid, auto whole) HWY_ATTR {
      const auto centre = [&](int axis) HWY_ATTR { return load(d, from.axis(axis) + first + i, valid, whole); };
      const FloatMask is_below = lanes_below<decltype(ties)::value>(plane, centre);
      const FloatMask goes_left = hn::And(is_below, valid);
      const FloatMask goes_right = hn::AndNot(is_below, valid);
      const auto left_lanes = static_cast<std::int64_t>(hn::CountTrue(d, goes_left));
      const auto right_lanes = static_cast<std::int64_t>(hn::CountTrue(d, goes_right));
      const auto to_left = hn::IndicesFromVec(dw, compress(lane_numbers, hn::RebindMask(dw, goes_left)));
      const auto to_right = hn::IndicesFromVec(dw, compress(lane_numbers, hn::RebindMask(dw, goes_right)));
      const auto move = [&](const auto* source, auto* target) HWY_ATTR {
        const auto v = load(dw, reinterpret_cast<const std::uint32_t*>(source) + first + i, valid, whole);
        auto* const words = reinterpret_cast<std::uint32_t*>(target);
        store_first(dw, hn::TableLookupLanes(v, to_left), left_lanes, left_end - left, words + left);
        store_first(dw, hn::TableLookupLanes(v, to_right), right_lanes, right_end - right, words + right);
      };
      move(from.x, to.x);
      move(from.y, to.y);
      move(from.z, to.z);
      move(from.word, to.word);
      if (kPlainRadii) move(from.r, to.r);
      left += left_lanes;
      right += right_lanes;
    });
  });
}

/// Floats as integers in the same order.
inline std::int32_t ordered_bits(float v) {
  std::int32_t bits;
  std::memcpy(&bits, &v, sizeof bits);
  return bits >= 0 ? bits : std::numeric_limits<std::int32_t>::min() - bits;
}
inline float from_ordered_bits(std::int32_t bits) {
  if (bits < 0) bits = std::numeric_limits<std::int32_t>::min() - bits;
  float v;
  std::memcpy(&v, &bits, sizeof v);
  return v;
}

/// The nearest centres on both sides of a plane, among those that only its last component splits.
HWY_INLINE void neighbours(const SphereArrays& spheres, std::int64_t first, std::int64_t count, const SplitPlane& plane,
                           int last, float& below, float& above) {
  const FloatTag d;
  Floats largest = hn::Set(d, -kInfiniteFloat), smallest = hn::Set(d, kInfiniteFloat);
  const Floats at = hn::Set(d, plane.at[last]);
  for_lanes(count, [&](std::int64_t i, FloatMask valid, auto whole) HWY_ATTR {
    FloatMask tied = valid;
    for (int k = 0; k < last; ++k) {
      const Floats on = hn::Set(d, plane.at[k]);
      tied = hn::And(tied, hn::Eq(load(d, spheres.axis(plane.axis[k]) + first + i, valid, whole), on));
    }
    const Floats c = load(d, spheres.axis(plane.axis[last]) + first + i, valid, whole);
    const FloatMask is_below = hn::Lt(c, at);
    largest = hn::Max(largest, hn::IfThenElse(hn::And(tied, is_below), c, largest));
    smallest = hn::Min(smallest, hn::IfThenElse(hn::AndNot(is_below, tied), c, smallest));
  });
  below = hn::GetLane(hn::MaxOfLanes(d, largest));
  above = hn::GetLane(hn::MinOfLanes(d, smallest));
}

/// A plane across `axis` with `wanted` of the centres below it, or as close to that as coincident centres allow; at
/// least one on each side. `box` is that of the centres, and not a point. Other axes split those on the plane.
HWY_INLINE SplitPlane plane_by_count(const SphereArrays& spheres, std::int64_t first, std::int64_t count,
                                     std::int64_t wanted, int axis, const Aabb& box) {
  SplitPlane plane;
  const Vec3f side = box.hi - box.lo;
  const int other = axis == 0 ? 1 : 0;
  const int another = axis == 2 ? 1 : 2;
  plane.axis[0] = axis;
  plane.axis[1] = side[other] >= side[another] ? other : another;
  plane.axis[2] = side[other] >= side[another] ? another : other;
  for (float& at : plane.at) at = -kInfiniteFloat;
  std::int64_t low_below = 0, high_below = count;
  for (int k = 0; k < 3; ++k) {
    // At the plane `low` too few are below, at `high` too many; both are kept as integers.
    plane.ties = k > 0;
    std::int64_t low = ordered_bits(box.lo[plane.axis[k]]);
    std::int64_t high = std::int64_t{ordered_bits(box.hi[plane.axis[k]])} + 1;
    for (int round = 0; high - low > 1; ++round) {
      const float low_at = from_ordered_bits(static_cast<std::int32_t>(low));
      const float high_at = from_ordered_bits(static_cast<std::int32_t>(high));
      std::int64_t middle = low + (high - low) / 2;
      if (round < kInterpolations) {
        const float share = static_cast<float>(wanted - low_below) / static_cast<float>(high_below - low_below);
        const float guess = low_at + (high_at - low_at) * share;
        if (guess > low_at && guess < high_at) middle = ordered_bits(guess);
      }
      plane.at[k] = from_ordered_bits(static_cast<std::int32_t>(middle));
      plane.below = count_below(spheres, first, count, plane);
      ++plane.passes;
      if (plane.below == wanted) return plane;
      // Nothing lies between a plane and its neighbours: if guesses do not converge, continue from those.
      float before = plane.at[k], after = plane.at[k];
      if (round + 1 >= kInterpolations) {
        neighbours(spheres, first, count, plane, k, before, after);
        ++plane.passes;
      }
      if (plane.below < wanted) {
        low = ordered_bits(after);
        low_below = plane.below;
      } else {
        high = std::int64_t{ordered_bits(before)} + (round + 1 >= kInterpolations ? 1 : 0);
        high_below = plane.below;
      }
    }
    plane.at[k] = from_ordered_bits(static_cast<std::int32_t>(low));
  }

  // Equal centres stay together: on the side that has fewer, unless that would leave the other side empty.
  if (low_below == 0 || (high_below < count && high_below - wanted < wanted - low_below)) {
    plane.below = high_below;
    plane.at[2] = from_ordered_bits(ordered_bits(plane.at[2]) + 1);
  } else {
    plane.below = low_below;
  }
  return plane;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_BUILD_SPLIT_PLANE_INL_H_
