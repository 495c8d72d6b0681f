#include <cstdint>

#include "bihive/image/transfer.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/image/bytes_from_radiance.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/simd/dispatch.h"
#include "bihive/simd/wasm_float64-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// byte_from_radiance() in its own operations, some numbers at a time.
void bytes_from_radiance_on_target(const float* radiance, std::int64_t count, std::uint8_t* bytes) {
  constexpr hn::CappedTag<double, 8> d;
  constexpr hn::Rebind<float, decltype(d)> narrow;
  constexpr hn::Rebind<std::int32_t, decltype(d)> whole;
  constexpr hn::Rebind<std::uint8_t, decltype(d)> byte;
  constexpr auto kLanes = static_cast<std::int64_t>(hn::MaxLanes(d));
  const auto zero = hn::Zero(d), one = hn::Set(d, 1);
  std::int64_t i = 0;
  for (; i + kLanes <= count; i += kLanes) {
    const auto value = hn::PromoteTo(d, hn::LoadU(narrow, radiance + i));
    const auto least = hn::IfThenElseZero(hn::Gt(value, zero), value);
    const auto clamped = hn::IfThenElse(hn::Lt(least, one), least, one);
    const auto displayed = hn::Floor(hn::Add(hn::Mul(clamped, hn::Set(d, 255)), hn::Set(d, 0.5)));
    hn::StoreU(hn::DemoteTo(byte, hn::DemoteTo(whole, displayed)), byte, bytes + i);
  }
  for (; i < count; ++i) bytes[i] = byte_from_radiance(double(radiance[i]), Transfer::none);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(bytes_from_radiance_on_target);

void bytes_from_radiance(const float* radiance, std::int64_t count, std::uint8_t* bytes) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(bytes_from_radiance_on_target)(radiance, count, bytes);
}

}  // namespace bihive
#endif
