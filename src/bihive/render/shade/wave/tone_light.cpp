#include "bihive/render/shade/wave/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/shade/wave/tone_light.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// std::max and std::min, also for NaN.
HWY_INLINE Lanes larger(Lanes a, Lanes b) {
  return hn::IfThenElse(hn::Lt(a, b), b, a);
}
HWY_INLINE Lanes smaller(Lanes a, Lanes b) {
  return hn::IfThenElse(hn::Lt(b, a), b, a);
}

// For x above 1/2; the factor of the light.
HWY_INLINE Lanes soft_factor(Lanes x) {
  constexpr double kWhite = 2 * (kSoftWhite - 0.5);
  const Lanes s = hn::Mul(all(2), hn::Sub(smaller(x, all(kSoftWhite)), all(0.5)));
  const Lanes bent = hn::Div(hn::Mul(s, hn::Add(all(1), hn::Div(s, all(kWhite * kWhite)))), hn::Add(all(1), s));
  return hn::Div(hn::Add(all(0.5), hn::Mul(all(0.5), bent)), x);
}

HWY_INLINE Lanes filmic_lanes(Lanes x) {
  const Lanes light = smaller(x, all(kFilmicWhite));
  const Lanes above = hn::Mul(light, hn::Add(hn::Mul(all(2.51), light), all(0.03)));
  const Lanes below = hn::Add(hn::Mul(light, hn::Add(hn::Mul(all(2.43), light), all(0.59))), all(0.14));
  return hn::IfThenElseZero(hn::Gt(x, all(0)), smaller(hn::Div(above, below), all(1)));
}

// toned() of several samples.
HWY_INLINE Lanes3 toned_lanes(Lanes3 light, const Tone& tone, double factor) {
  const Lanes3 exposed = multiply(all(factor), light);
  if (tone.curve == ToneCurve::none) return exposed;
  if (tone.curve == ToneCurve::filmic)
    return {filmic_lanes(exposed.x), filmic_lanes(exposed.y), filmic_lanes(exposed.z)};
  const Lanes largest = larger(larger(exposed.x, exposed.y), exposed.z);
  return choose(hn::Gt(largest, all(0.5)), multiply(soft_factor(largest), exposed), exposed);
}

void tone_light_on_target(const Tone& tone, const std::uint8_t* hit, std::int64_t count, WaveSums& sums) {
  const double factor = exposure_factor(tone);
  for (std::int64_t i = 0; i < count; i += kLanes) {
    alignas(64) double hits[kLanes] = {};
    for (std::int64_t k = 0; k < kLanes && i + k < count; ++k) hits[k] = hit[i + k];
    const LaneMask found = hn::Gt(hn::Load(Tag(), hits), all(0));
    const Lanes3 light = load(sums.light, i);
    store(choose(found, toned_lanes(light, tone, factor), light), sums.light, i);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(tone_light_on_target);

namespace steps {

void tone_light(const Tone& tone, const std::uint8_t* hit, std::int64_t count, WaveSums& sums) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(tone_light_on_target)(tone, hit, count, sums);
}

}  // namespace steps
}  // namespace bihive
#endif
