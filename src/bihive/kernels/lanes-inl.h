// Small helpers of the kernels: sixteen lanes of binary32 in one, two or four steps, and masks as bits.

#if defined(BIHIVE_KERNELS_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_KERNELS_LANES_INL_H_
#undef BIHIVE_KERNELS_LANES_INL_H_
#else
#define BIHIVE_KERNELS_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "bihive/kernels/wide_tree.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using FloatTag = hn::CappedTag<float, kWidth>;
using WordTag = hn::Rebind<std::uint32_t, FloatTag>;
constexpr int kFloatLanes = static_cast<int>(hn::MaxLanes(FloatTag()));

/// Bit i: lane i.
template <class Mask>
HWY_INLINE std::uint32_t mask_bits(Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(FloatTag(), mask, bytes);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
}

/// The radii of kFloatLanes spheres from `slot` on.
HWY_INLINE auto load_radii(const WideSpheres& spheres, std::int64_t slot) {
  const FloatTag d;
  if (!spheres.has_palette) return hn::LoadU(d, spheres.r + slot);
  const auto classes = hn::ShiftRight<WideSpheres::kIdBits>(hn::LoadU(WordTag(), spheres.word + slot));
  return hn::GatherIndex(d, spheres.palette.data(), hn::BitCast(hn::RebindToSigned<WordTag>(), classes));
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_KERNELS_LANES_INL_H_
