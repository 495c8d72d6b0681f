// math/elementary.h on several numbers at a time, with the same operations in the same order, none fused.

#if defined(BIHIVE_RENDER_SHADE_WAVE_POWERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_RENDER_SHADE_WAVE_POWERS_INL_H_
#undef BIHIVE_RENDER_SHADE_WAVE_POWERS_INL_H_
#else
#define BIHIVE_RENDER_SHADE_WAVE_POWERS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "bihive/math/elementary.h"
#include "bihive/render/query/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

/// Conversion of whole numbers below 2^51 in magnitude between integer and binary64.
HWY_INLINE Longs words_from_whole(Lanes whole) {
  const auto magic = all(0x1.8p52);
  return hn::Sub(hn::BitCast(LongTag(), hn::Add(whole, magic)), hn::BitCast(LongTag(), magic));
}
HWY_INLINE Lanes whole_from_words(Longs words) {
  const auto magic = all(0x1.8p52);
  return hn::Sub(hn::BitCast(Tag(), hn::Add(words, hn::BitCast(LongTag(), magic))), magic);
}
/// 2^whole for -1022 <= whole <= 1023.
HWY_INLINE Lanes power_of_two(Lanes whole) {
  const auto biased = hn::Add(words_from_whole(whole), hn::Set(LongTag(), 1023));
  return hn::BitCast(Tag(), hn::ShiftLeft<52>(biased));
}

/// a + b c, and the same with two coefficients.
HWY_INLINE Lanes plus(Lanes a, Lanes b, Lanes c) {
  return hn::Add(a, hn::Mul(b, c));
}
HWY_INLINE Lanes pair(double a, Lanes b, double c) {
  return plus(all(a), b, all(c));
}

/// portable_log2() of normal numbers.
HWY_INLINE Lanes log2_of(Lanes x) {
  // Split into mantissa in [sqrt(1/2), sqrt(2)) and exponent, both exact.
  const LongTag w;
  const auto bits = hn::BitCast(w, x);
  auto exponent = whole_from_words(hn::Sub(hn::ShiftRight<52>(bits), hn::Set(w, 1022)));
  auto mantissa =
      hn::BitCast(Tag(), hn::Or(hn::And(bits, hn::Set(w, 0x000FFFFFFFFFFFFF)), hn::Set(w, 0x3FE0000000000000)));
  const auto small = hn::Lt(mantissa, all(0.70710678118654752440));
  mantissa = hn::IfThenElse(small, hn::Add(mantissa, mantissa), mantissa);
  exponent = hn::IfThenElse(small, hn::Sub(exponent, all(1)), exponent);

  const auto s = hn::Div(hn::Sub(mantissa, all(1)), hn::Add(mantissa, all(1)));
  const auto z = hn::Mul(s, s);
  const auto z2 = hn::Mul(z, z);
  const auto z4 = hn::Mul(z2, z2);
  const auto from_3 = plus(pair(1.0 / 3, z, 1.0 / 5), z2, pair(1.0 / 7, z, 1.0 / 9));
  const auto from_11 = plus(pair(1.0 / 11, z, 1.0 / 13), z2, pair(1.0 / 15, z, 1.0 / 17));
  const auto from_19 = pair(1.0 / 19, z, 1.0 / 21);
  const auto series = plus(all(1), z, plus(from_3, z4, plus(from_11, z4, from_19)));
  const auto fraction = hn::Mul(hn::Mul(hn::Mul(all(2), s), series), all(1.44269504088896340736));
  return hn::Add(exponent, fraction);
}

/// portable_exp2() for -1075 <= x <= 1024.
HWY_INLINE Lanes exp2_of(Lanes x) {
  const auto whole = hn::Floor(hn::Add(x, all(0.5)));
  const auto y = hn::Mul(hn::Sub(x, whole), all(0.69314718055994530942));
  const auto y2 = hn::Mul(y, y);
  const auto y4 = hn::Mul(y2, y2);
  const auto from_2 = plus(pair(1.0 / 2, y, 1.0 / 6), y2, pair(1.0 / 24, y, 1.0 / 120));
  const auto from_6 = plus(pair(1.0 / 720, y, 1.0 / 5040), y2, pair(1.0 / 40320, y, 1.0 / 362880));
  const auto from_10 = plus(pair(1.0 / 3628800, y, 1.0 / 39916800), y2, pair(1.0 / 479001600, y, 1.0 / 6227020800));
  const auto power = hn::Add(all(1), plus(y, y2, plus(from_2, y4, plus(from_6, y4, from_10))));
  // In two steps: the first is exact, so a small result is rounded only once.
  const auto half = hn::Floor(hn::Mul(whole, all(0.5)));
  return hn::Mul(hn::Mul(power, power_of_two(half)), power_of_two(hn::Sub(whole, half)));
}

/// portable_pow() where the mask is set, x > 0 there.
HWY_INLINE Lanes pow_of(LaneMask mask, Lanes x, Lanes y) {
  // Special cases are rare.
  const auto exponent = hn::Mul(y, log2_of(x));
  const auto plain_x = hn::And(hn::Ge(x, all(0x1p-1022)), hn::Lt(x, all(0x1p1023)));
  const auto plain_y = hn::And(hn::Ge(exponent, all(-1074)), hn::Le(exponent, all(1024)));
  const auto plain = hn::And(hn::And(plain_x, plain_y), hn::Ne(y, all(0)));
  if (HWY_LIKELY(none(hn::AndNot(plain, mask)))) return exp2_of(exponent);

  alignas(64) double xs[kLanes], ys[kLanes], powers[kLanes];
  hn::Store(hn::IfThenElse(mask, x, all(1)), Tag(), xs);
  hn::Store(hn::IfThenElse(mask, y, all(1)), Tag(), ys);
  for (int k = 0; k < kLanes; ++k) powers[k] = portable_pow(xs[k], ys[k]);
  return hn::Load(Tag(), powers);
}

/// shading_power() where the mask is set, x > 0 there.
HWY_INLINE Lanes shading_power_of(LaneMask mask, Lanes x, Lanes y) {
  // Neighbours mostly share a power, so compute each power that occurs once.
  const Longs bits = hn::BitCast(LongTag(), y);
  alignas(64) double powers[kLanes];
  hn::Store(y, Tag(), powers);
  Lanes result = all(0);
  for (LaneMask left = mask; !none(left);) {
    const double power = powers[hn::FindFirstTrue(Tag(), left)];
    const LaneMask same = hn::And(left, lanes_of(hn::Eq(bits, hn::BitCast(LongTag(), all(power)))));
    Lanes raised = all(1);
    if (is_small_whole(power)) {
      Lanes square = x;
      for (unsigned n = static_cast<unsigned>(power); n != 0; n >>= 1) {
        if ((n & 1) != 0) raised = hn::Mul(raised, square);
        square = hn::Mul(square, square);
      }
    } else {
      raised = pow_of(same, x, y);
    }
    result = hn::IfThenElse(same, raised, result);
    left = hn::AndNot(same, left);
  }
  return result;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_RENDER_SHADE_WAVE_POWERS_INL_H_
