// Adds to Highway 1.0.3 for WebAssembly: vectors of two numbers of binary64, with the names and the meaning of Highway.
#pragma once

#include <hwy/highway.h>

#if HWY_TARGET == HWY_WASM
#include <wasm_simd128.h>

#include <cstddef>

namespace hwy {
namespace HWY_NAMESPACE {

template <std::size_t N>
using Doubles = Vec128<double, N>;
template <std::size_t N>
using DoublesMask = Mask128<double, N>;

template <std::size_t N, HWY_IF_LE128(double, N)>
HWY_API Doubles<N> Set(Simd<double, N, 0> /* tag */, double value) {
  return {wasm_f64x2_splat(value)};
}

template <std::size_t N>
HWY_API Doubles<N> operator+(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_add(a.raw, b.raw)};
}
template <std::size_t N>
HWY_API Doubles<N> operator-(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_sub(a.raw, b.raw)};
}
template <std::size_t N>
HWY_API Doubles<N> operator*(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_mul(a.raw, b.raw)};
}
template <std::size_t N>
HWY_API Doubles<N> operator/(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_div(a.raw, b.raw)};
}

/// In two roundings: there is no fused form. Only filters may call it.
template <std::size_t N>
HWY_API Doubles<N> MulAdd(Doubles<N> mul, Doubles<N> x, Doubles<N> add) {
  return mul * x + add;
}

template <std::size_t N>
HWY_API DoublesMask<N> operator==(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_eq(a.raw, b.raw)};
}
template <std::size_t N>
HWY_API DoublesMask<N> operator!=(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_ne(a.raw, b.raw)};
}
template <std::size_t N>
HWY_API DoublesMask<N> operator<(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_lt(a.raw, b.raw)};
}
template <std::size_t N>
HWY_API DoublesMask<N> operator>(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_gt(a.raw, b.raw)};
}
template <std::size_t N>
HWY_API DoublesMask<N> operator<=(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_le(a.raw, b.raw)};
}
template <std::size_t N>
HWY_API DoublesMask<N> operator>=(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_ge(a.raw, b.raw)};
}

template <std::size_t N>
HWY_API Doubles<N> Abs(Doubles<N> v) {
  return {wasm_f64x2_abs(v.raw)};
}
template <std::size_t N>
HWY_API Doubles<N> Sqrt(Doubles<N> v) {
  return {wasm_f64x2_sqrt(v.raw)};
}
template <std::size_t N>
HWY_API Doubles<N> Floor(Doubles<N> v) {
  return {wasm_f64x2_floor(v.raw)};
}
/// As on x86: if one is NaN, the second.
template <std::size_t N>
HWY_API Doubles<N> Min(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_pmin(b.raw, a.raw)};
}
template <std::size_t N>
HWY_API Doubles<N> Max(Doubles<N> a, Doubles<N> b) {
  return {wasm_f64x2_pmax(b.raw, a.raw)};
}

/// (Highway's own takes the bits of a double for a whole number.)
template <std::size_t N>
HWY_API double GetLane(Doubles<N> v) {
  return wasm_f64x2_extract_lane(v.raw, 0);
}

template <std::size_t N, HWY_IF_LE128(double, N)>
HWY_API Doubles<N> PromoteTo(Simd<double, N, 0> /* tag */, Vec128<float, N> v) {
  return {wasm_f64x2_promote_low_f32x4(v.raw)};
}
template <std::size_t N, HWY_IF_LE128(double, N)>
HWY_API Vec128<float, N> DemoteTo(Simd<float, N, 0> /* tag */, Doubles<N> v) {
  return Vec128<float, N>{wasm_f32x4_demote_f64x2_zero(v.raw)};
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace hwy
#endif
