// Functions that Highway 1.0.3 does lane after lane for WebAssembly, though there are instructions for them. Names and
// meaning are those of Highway, and the compiler prefers these for the vectors below.
#pragma once

#include <hwy/highway.h>

#if HWY_TARGET == HWY_WASM
#include <wasm_simd128.h>

#include <cstddef>
#include <cstdint>

namespace hwy {
namespace HWY_NAMESPACE {

HWY_API std::size_t CountTrue(Full128<float> /* tag */, Mask128<float> mask) {
  return static_cast<std::size_t>(__builtin_popcount(static_cast<unsigned>(wasm_i32x4_bitmask(mask.raw))));
}
HWY_API std::size_t CountTrue(Full128<double> /* tag */, Mask128<double> mask) {
  return static_cast<std::size_t>(__builtin_popcount(static_cast<unsigned>(wasm_i64x2_bitmask(mask.raw))));
}

HWY_API bool AllFalse(Full128<float> /* tag */, Mask128<float> mask) {
  return !wasm_v128_any_true(mask.raw);
}
HWY_API bool AllFalse(Full128<double> /* tag */, Mask128<double> mask) {
  return !wasm_v128_any_true(mask.raw);
}

HWY_API std::intptr_t FindFirstTrue(Full128<double> /* tag */, Mask128<double> mask) {
  const auto bits = static_cast<unsigned>(wasm_i64x2_bitmask(mask.raw));
  return bits != 0 ? __builtin_ctz(bits) : -1;
}
HWY_API std::size_t StoreMaskBits(Full128<double> /* tag */, Mask128<double> mask, std::uint8_t* bits) {
  *bits = static_cast<std::uint8_t>(wasm_i64x2_bitmask(mask.raw));
  return 1;
}

/// Half vectors by one load or store.
template <class T, HWY_IF_LANE_SIZE(T, 4)>
HWY_API Vec128<T, 2> LoadU(Simd<T, 2, 0> /* tag */, const T* from) {
  return Vec128<T, 2>{wasm_v128_load64_zero(from)};
}
template <class T, HWY_IF_LANE_SIZE(T, 4)>
HWY_API Vec128<T, 2> Load(Simd<T, 2, 0> /* tag */, const T* from) {
  return Vec128<T, 2>{wasm_v128_load64_zero(from)};
}
template <class T, HWY_IF_LANE_SIZE(T, 4)>
HWY_API void StoreU(Vec128<T, 2> v, Simd<T, 2, 0> /* tag */, T* to) {
  wasm_v128_store64_lane(to, v.raw, 0);
}
template <class T, HWY_IF_LANE_SIZE(T, 4)>
HWY_API void Store(Vec128<T, 2> v, Simd<T, 2, 0> /* tag */, T* to) {
  wasm_v128_store64_lane(to, v.raw, 0);
}
HWY_API Vec128<std::uint16_t, 4> LoadU(Simd<std::uint16_t, 4, 0> /* tag */, const std::uint16_t* from) {
  return Vec128<std::uint16_t, 4>{wasm_v128_load64_zero(from)};
}

/// Four loads into lanes: what is stored lane by lane and loaded whole has to wait until it is written.
template <class T, HWY_IF_LANE_SIZE(T, 4)>
HWY_API Vec128<T> GatherIndex(Full128<T> /* tag */, const T* from, Vec128<std::int32_t> index) {
  __v128_u lanes = wasm_v128_load32_zero(from + wasm_i32x4_extract_lane(index.raw, 0));
  lanes = wasm_v128_load32_lane(from + wasm_i32x4_extract_lane(index.raw, 1), lanes, 1);
  lanes = wasm_v128_load32_lane(from + wasm_i32x4_extract_lane(index.raw, 2), lanes, 2);
  return Vec128<T>{wasm_v128_load32_lane(from + wasm_i32x4_extract_lane(index.raw, 3), lanes, 3)};
}
template <class T, HWY_IF_LANE_SIZE(T, 4)>
HWY_API Vec128<T, 2> GatherIndex(Simd<T, 2, 0> /* tag */, const T* from, Vec128<std::int32_t, 2> index) {
  const __v128_u lanes = wasm_v128_load32_zero(from + wasm_i32x4_extract_lane(index.raw, 0));
  return Vec128<T, 2>{wasm_v128_load32_lane(from + wasm_i32x4_extract_lane(index.raw, 1), lanes, 1)};
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace hwy
#endif
