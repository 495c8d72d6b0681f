// Loads the sphere set into the builder's arrays.

#if defined(BIHIVE_WIDE_BUILD_LOAD_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_BUILD_LOAD_INL_H_
#undef BIHIVE_WIDE_BUILD_LOAD_INL_H_
#else
#define BIHIVE_WIDE_BUILD_LOAD_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "bihive/wide/build/bounds-inl.h"
#include "bihive/wide/build/split.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The arrays of a set from `begin` on, read only.
inline SphereArrays arrays_of(const SphereSet& spheres, std::int64_t begin) {
  SphereArrays arrays;
  arrays.x = const_cast<float*>(spheres.x().data()) + begin;
  arrays.y = const_cast<float*>(spheres.y().data()) + begin;
  arrays.z = const_cast<float*>(spheres.z().data()) + begin;
  arrays.r = const_cast<float*>(spheres.r().data()) + begin;
  return arrays;
}

inline InputSummary summarize_spheres(const SphereSet& spheres, std::int64_t begin, std::int64_t end) {
  const FloatTag d;
  const SphereArrays from = arrays_of(spheres, begin);
  InputSummary summary;
  RadiusPalette& palette = summary.palette;
  GrowingBox box;
  Floats largest = hn::Zero(d), smallest = hn::Set(d, kInfiniteFloat);
  for_lanes(end - begin, [&](std::int64_t i, FloatMask valid, auto whole) HWY_ATTR {
    for (int axis = 0; axis < 3; ++axis) {
      const Floats c = load(d, from.axis(axis) + i, valid, whole);
      if (whole)
        box.add(axis, c, c);
      else
        box.add_where(valid, axis, c, c);
    }
    // Lanes past the end read as radius 0, which needs no palette entry.
    const Floats r = load(d, from.r + i, valid, whole);
    largest = hn::Max(largest, r);
    smallest = hn::Min(smallest, hn::IfThenElse(valid, r, smallest));
    if (palette.overflow) return;
    FloatMask known = hn::Eq(r, hn::Zero(d));
    for (int k = 0; k < palette.size; ++k) known = hn::Or(known, hn::Eq(r, hn::Set(d, palette.radius[k])));
    if (hn::AllTrue(d, known)) return;
    const std::int64_t lanes = std::min<std::int64_t>(kFloatLanes, end - begin - i);
    for (std::int64_t k = 0; k < lanes; ++k) palette.add(from.r[i + k]);
  });
  summary.centres = box.box();
  summary.largest_radius = hn::GetLane(hn::MaxOfLanes(d, largest)) + 0.0F;
  palette.has_zero = hn::GetLane(hn::MinOfLanes(d, smallest)) == 0;
  return summary;
}

/// Packed radius classes and ids of the spheres from `id` on.
HWY_INLINE Words make_words(const SplitContext& context, int palette_size, Floats r, std::int64_t id) {
  const FloatTag d;
  const WordTag dw;
  const Words ids = iota_words(static_cast<std::uint32_t>(id));
  if (context.final.r != nullptr) return ids;
  Words classes = hn::Set(dw, RadiusPalette::kZeroClass);
  for (int k = 0; k < palette_size; ++k)
    classes = hn::IfThenElse(hn::RebindMask(dw, hn::Eq(r, hn::Set(d, context.palette[k]))),
                             hn::Set(dw, static_cast<std::uint32_t>(k)), classes);
  return hn::Or(hn::ShiftLeft<WideSpheres::kIdBits>(classes), ids);
}

/// Calls use(offset, x, y, z, r, words) for the spheres begin to end - 1.
template <class Use>
HWY_INLINE void for_spheres(const SphereSet& spheres, std::int64_t begin, std::int64_t end, const SplitContext& context,
                            const Use& use) {
  const FloatTag d;
  const SphereArrays from = arrays_of(spheres, begin);
  int palette_size = 0;
  while (palette_size < RadiusPalette::kMost && context.palette[palette_size] != 0) ++palette_size;
  for_lanes(end - begin, [&](std::int64_t i, FloatMask valid, auto whole) HWY_ATTR {
    const Floats r = load(d, from.r + i, valid, whole);
    use(i, load(d, from.x + i, valid, whole), load(d, from.y + i, valid, whole), load(d, from.z + i, valid, whole), r,
        make_words(context, palette_size, r, begin + i));
  });
}

inline void load_all(const SphereSet& spheres, std::int64_t begin, std::int64_t end, SplitContext& context) {
  const FloatTag d;
  const WordTag dw;
  const SphereArrays& to = context.scratch;
  for_spheres(spheres, begin, end, context,
              [&](std::int64_t i, Floats x, Floats y, Floats z, Floats r, Words words) HWY_ATTR {
                const std::int64_t at = begin + i;
                const std::int64_t room = end - at;
                const std::int64_t n = std::min<std::int64_t>(room, kFloatLanes);
                store_first(d, x, n, room, to.x + at);
                store_first(d, y, n, room, to.y + at);
                store_first(d, z, n, room, to.z + at);
                store_first(dw, words, n, room, to.word + at);
                if (to.r != nullptr) store_first(d, r, n, room, to.r + at);
              });
}

inline void find_all_cells(const SphereSet& spheres, std::int64_t begin, std::int64_t end, const CellGrid& grid,
                           std::uint16_t* cell, std::uint32_t* counts) {
  const FloatTag d;
  const hn::RebindToSigned<FloatTag> di;
  const SphereArrays from = arrays_of(spheres, begin);
  HWY_ALIGN std::int32_t coordinate[3][kFloatLanes];
  for_lanes(end - begin, [&](std::int64_t i, FloatMask valid, auto whole) HWY_ATTR {
    for (int axis = 0; axis < 3; ++axis) {
      const Floats c = load(d, from.axis(axis) + i, valid, whole);
      const auto scaled = hn::Mul(hn::Sub(c, hn::Set(d, grid.lo[axis])), hn::Set(d, grid.scale[axis]));
      const auto cut = hn::Min(hn::Max(scaled, hn::Zero(d)), hn::Set(d, static_cast<float>(grid.last[axis])));
      hn::Store(hn::ConvertTo(di, cut), di, coordinate[axis]);
    }
    const std::int64_t lanes = std::min<std::int64_t>(kFloatLanes, end - begin - i);
    for (std::int64_t k = 0; k < lanes; ++k) {
      const unsigned at =
          unsigned{grid.place[0][coordinate[0][k]]} | grid.place[1][coordinate[1][k]] | grid.place[2][coordinate[2][k]];
      cell[i + k] = static_cast<std::uint16_t>(at);
      ++counts[at];
    }
  });
}

inline void scatter_all(const SphereSet& spheres, std::int64_t begin, std::int64_t end, const std::uint16_t* cell,
                        std::uint32_t* next, SplitContext& context) {
  const FloatTag d;
  const WordTag dw;
  const SphereArrays from = arrays_of(spheres, begin);
  const SphereArrays& to = context.scratch;
  HWY_ALIGN std::uint32_t word[kFloatLanes];
  for_spheres(spheres, begin, end, context, [&](std::int64_t i, Floats, Floats, Floats, Floats, Words words) HWY_ATTR {
    hn::Store(words, dw, word);
    const std::int64_t lanes = std::min<std::int64_t>(kFloatLanes, end - begin - i);
    for (std::int64_t k = 0; k < lanes; ++k) {
      const std::uint32_t at = next[cell[i + k]]++;
      to.x[at] = from.x[i + k];
      to.y[at] = from.y[i + k];
      to.z[at] = from.z[i + k];
      to.word[at] = word[k];
      if (to.r != nullptr) to.r[at] = from.r[i + k];
    }
  });
  (void)d;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_BUILD_LOAD_INL_H_
