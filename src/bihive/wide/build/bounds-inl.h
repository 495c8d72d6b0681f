// Vector loops over a range of spheres: loads, stores, bounds.

#if defined(BIHIVE_WIDE_BUILD_BOUNDS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_BUILD_BOUNDS_INL_H_
#undef BIHIVE_WIDE_BUILD_BOUNDS_INL_H_
#else
#define BIHIVE_WIDE_BUILD_BOUNDS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <type_traits>

#include "bihive/math/aabb.h"
#include "bihive/math/infinity.h"
#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/build/split.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Calls step(offset, valid, whole) for each vector of a range: `valid` is true for all lanes but those after its end,
/// and `whole` is std::true_type where it is true for all. Loads from arrays must use load(), which does not read past
/// the end.
template <class Step>
HWY_INLINE void for_lanes(std::int64_t count, const Step& step) {
  const FloatTag d;
  const FloatMask all = hn::FirstN(d, kFloatLanes);
  std::int64_t i = 0;
  for (; i + kFloatLanes <= count; i += kFloatLanes) step(i, all, std::true_type());
  if (i < count) step(i, hn::FirstN(d, static_cast<std::size_t>(count - i)), std::false_type());
}

template <class Tag, class T, class Whole>
HWY_INLINE hn::Vec<Tag> load(Tag d, const T* from, FloatMask valid, Whole whole) {
  if (whole) return hn::LoadU(d, from);
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
  return hn::MaskedLoad(hn::RebindMask(d, valid), d, from);
#else
  // A masked load would read past the end.
  HWY_ALIGN T lanes[kFloatLanes] = {};
  const std::size_t n = hn::CountTrue(FloatTag(), valid);
  for (std::size_t i = 0; i < n; ++i) lanes[i] = from[i];
  return hn::Load(d, lanes);
#endif
}

/// Stores the first n lanes; memory after them, up to `room`, may be overwritten.
template <class Tag, class T>
HWY_INLINE void store_first(Tag d, hn::Vec<Tag> v, std::int64_t n, std::int64_t room, T* to) {
  if (room >= kFloatLanes) return hn::StoreU(v, d, to);
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
  hn::BlendedStore(v, hn::FirstN(d, static_cast<std::size_t>(n)), d, to);
#else
  // A blended store would write back what another thread may be changing.
  HWY_ALIGN T lanes[kFloatLanes];
  hn::Store(v, d, lanes);
  for (std::int64_t i = 0; i < n; ++i) to[i] = lanes[i];
#endif
}

/// A growing box, kept as a vector of boxes.
struct GrowingBox {
  Floats lo[3], hi[3];

  HWY_INLINE GrowingBox() {
    const FloatTag d;
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = hn::Set(d, kInfiniteFloat);
      hi[axis] = hn::Set(d, -kInfiniteFloat);
    }
  }
  HWY_INLINE void add(int axis, Floats low, Floats high) {
    lo[axis] = hn::Min(lo[axis], low);
    hi[axis] = hn::Max(hi[axis], high);
  }
  HWY_INLINE void add_where(FloatMask mask, int axis, Floats low, Floats high) {
    lo[axis] = hn::IfThenElse(mask, hn::Min(lo[axis], low), lo[axis]);
    hi[axis] = hn::IfThenElse(mask, hn::Max(hi[axis], high), hi[axis]);
  }
  /// Adding 0 turns -0 into +0, so that the result does not depend on the order of minima.
  HWY_INLINE Aabb box() const {
#if HWY_TARGET == HWY_SCALAR
    HWY_ALIGN float least[8];
    for (int axis = 0; axis < 3; ++axis) {
      least[axis] = hn::GetLane(lo[axis]);
      least[3 + axis] = -hn::GetLane(hi[axis]);
    }
#else
    const FloatTag d;
    // Six minima at once: lanes of several vectors side by side, in every four lanes.
    const auto two = [&](Floats a, Floats b)
                         HWY_ATTR { return hn::Min(hn::InterleaveLower(d, a, b), hn::InterleaveUpper(d, a, b)); };
    const hn::Repartition<double, FloatTag> dd;
    const auto four = [&](Floats ab, Floats ce) HWY_ATTR {
      const auto a = hn::BitCast(dd, ab), c = hn::BitCast(dd, ce);
      return hn::Min(hn::BitCast(d, hn::InterleaveLower(dd, a, c)), hn::BitCast(d, hn::InterleaveUpper(dd, a, c)));
    };
    const auto all_blocks = [&](Floats v) HWY_ATTR {
#if HWY_TARGET == HWY_AVX3
      v = hn::Min(v, hn::ReverseBlocks(d, v));
#endif
#if HWY_TARGET == HWY_AVX3 || HWY_TARGET == HWY_AVX2
      v = hn::Min(v, hn::SwapAdjacentBlocks(v));
#endif
      return v;
    };
    const Floats last = two(hn::Neg(hi[1]), hn::Neg(hi[2]));
    HWY_ALIGN float least[4 + kWidth];
    hn::Store(all_blocks(four(two(lo[0], lo[1]), two(lo[2], hn::Neg(hi[0])))), d, least);
    hn::StoreU(all_blocks(four(last, last)), d, least + 4);
#endif
    return {{least[0] + 0.0F, least[1] + 0.0F, least[2] + 0.0F}, {0.0F - least[3], 0.0F - least[4], 0.0F - least[5]}};
  }
};

/// The box of the centres first to first + count - 1.
HWY_INLINE Aabb centre_box(const SphereArrays& spheres, std::int64_t first, std::int64_t count) {
  const FloatTag d;
  GrowingBox box;
  for_lanes(count, [&](std::int64_t i, FloatMask valid, auto whole) HWY_ATTR {
    for (int axis = 0; axis < 3; ++axis) {
      const Floats c = load(d, spheres.axis(axis) + first + i, valid, whole);
      if (whole)
        box.add(axis, c, c);
      else
        box.add_where(valid, axis, c, c);
    }
  });
  return box.box();
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_BUILD_BOUNDS_INL_H_
