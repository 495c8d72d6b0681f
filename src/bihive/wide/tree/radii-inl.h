// The radii of spheres of a wide tree, a vector at a time.

#if defined(BIHIVE_WIDE_TREE_RADII_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TREE_RADII_INL_H_
#undef BIHIVE_WIDE_TREE_RADII_INL_H_
#else
#define BIHIVE_WIDE_TREE_RADII_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

static_assert(kWidth == kMostLanes);

/// Entry classes[i] of the palette in lane i.
template <class Words>
HWY_INLINE auto look_up_radii(const WideSpheres& spheres, Words classes) {
  const FloatTag d;
  if (spheres.palette_size == 1) return hn::Set(d, spheres.palette[0]);
  if constexpr (kFloatLanes >= 8) {
    const auto low = hn::TableLookupLanes(hn::Load(d, spheres.palette.data()),
                                          hn::IndicesFromVec(d, hn::And(classes, hn::Set(WordTag(), kFloatLanes - 1))));
    if (spheres.palette_size <= kFloatLanes) return low;
    if constexpr (kFloatLanes == 16) {
      const auto high =
          hn::TableLookupLanes(hn::Load(d, spheres.palette.data() + 16),
                               hn::IndicesFromVec(d, hn::And(classes, hn::Set(WordTag(), kFloatLanes - 1))));
      return hn::IfThenElse(hn::RebindMask(d, hn::Gt(classes, hn::Set(WordTag(), 15))), high, low);
    }
  }
  return hn::GatherIndex(d, spheres.palette.data(), hn::BitCast(hn::RebindToSigned<WordTag>(), classes));
}

/// The radii of kFloatLanes spheres from `slot` on.
HWY_INLINE auto load_radii(const WideSpheres& spheres, std::int64_t slot) {
  const FloatTag d;
  if (!spheres.has_palette) return hn::LoadU(d, spheres.r + slot);
  if (spheres.palette_size == 1) return hn::Set(d, spheres.palette[0]);
  return look_up_radii(spheres, hn::ShiftRight<WideSpheres::kIdBits>(hn::LoadU(WordTag(), spheres.word + slot)));
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TREE_RADII_INL_H_
