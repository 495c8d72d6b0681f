// Vectors of binary32 and of 32-bit words, sixteen lanes in one, two or four steps; masks as bits.

#if defined(BIHIVE_SIMD_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_SIMD_LANES_INL_H_
#undef BIHIVE_SIMD_LANES_INL_H_
#else
#define BIHIVE_SIMD_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "bihive/simd/compress_table.h"
#include "bihive/simd/wasm_float64-inl.h"
#include "bihive/simd/wasm_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Lanes of the widest vector in use.
constexpr int kMostLanes = 16;

using FloatTag = hn::CappedTag<float, kMostLanes>;
using WordTag = hn::Rebind<std::uint32_t, FloatTag>;
constexpr int kFloatLanes = static_cast<int>(hn::MaxLanes(FloatTag()));

using Floats = hn::VFromD<FloatTag>;
using Words = hn::VFromD<WordTag>;
using FloatMask = hn::Mask<FloatTag>;

HWY_INLINE Floats in_all(float value) {
  return hn::Set(FloatTag(), value);
}

/// Bit i: lane i.
template <class Mask>
HWY_INLINE std::uint32_t mask_bits(Mask mask) {
#if HWY_TARGET <= HWY_AVX3
  return mask.raw;
#elif HWY_ARCH_X86 && HWY_TARGET <= HWY_SSE4
  return static_cast<std::uint32_t>(hn::detail::BitsFromMask(mask));
#elif HWY_TARGET == HWY_WASM
  return wasm_i32x4_bitmask(mask.raw);
#else
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(FloatTag(), mask, bytes);
  return bytes[0] | static_cast<std::uint32_t>(bytes[1]) << 8;
#endif
}

/// first, first + 1, ... (Highway's own Iota writes lane after lane and waits for them.)
HWY_INLINE auto iota_words(std::uint32_t first) {
  alignas(64) static constexpr std::uint32_t kCount[kMostLanes] = {0, 1, 2,  3,  4,  5,  6,  7,
                                                                   8, 9, 10, 11, 12, 13, 14, 15};
  const WordTag d;
  return hn::Add(hn::Load(d, kCount), hn::Set(d, first));
}

/// The first four lanes (all of a narrower vector).
template <class V, class T>
HWY_INLINE void store_four(V v, T* to) {
  const hn::CappedTag<T, 4> four;
  if constexpr (kFloatLanes == 16)
    hn::StoreU(hn::LowerHalf(hn::LowerHalf(v)), four, to);
  else if constexpr (kFloatLanes == 8)
    hn::StoreU(hn::LowerHalf(v), four, to);
  else
    hn::StoreU(v, four, to);
}

/// The lanes of `mask` moved to the front, in order; the others are undefined. `V` holds floats or words. (Highway's
/// own Compress copies a table to the stack at every call where GCC 12 compiles it for narrower vectors.)
template <class V, class M>
HWY_INLINE V compress(V values, M mask) {
#if HWY_TARGET == HWY_WASM
  const std::uint32_t bits = mask_bits(mask);
  return V{wasm_i8x16_swizzle(values.raw, wasm_v128_load(kCompressBytes[bits].data()))};
#else
  if constexpr (kFloatLanes == 8 || kFloatLanes == 4) {
    const hn::DFromV<V> d;
    const hn::Rebind<std::uint8_t, WordTag> bytes;
    const std::uint32_t bits = mask_bits(hn::RebindMask(FloatTag(), mask));
    const auto* places = reinterpret_cast<const std::uint8_t*>(&kCompressPlaces[bits]);
    const auto lanes = hn::PromoteTo(WordTag(), hn::LoadU(bytes, places));
    return hn::TableLookupLanes(values, hn::IndicesFromVec(d, lanes));
  } else {
    return hn::Compress(values, mask);
  }
#endif
}

/// kFloatLanes words with `Compress`ed lanes in front, all of them stored: what follows the last one is overwritten.
/// Returns how many there are. (Storing the compressed lanes alone takes many times longer on some machines.)
template <class D, class V, class M>
HWY_INLINE std::size_t store_compressed(D d, V values, M mask, hn::TFromD<D>* to) {
  hn::StoreU(compress(values, mask), d, to);
  return static_cast<std::size_t>(__builtin_popcount(mask_bits(hn::RebindMask(FloatTag(), mask))));
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_SIMD_LANES_INL_H_
