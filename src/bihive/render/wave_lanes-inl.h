// Vectors of binary64 for the steps of a wave: math/vec3.h and math/elementary.h on several rays at a time, with the
// very operations of those in the same order. Fused multiply-add only where its result is proven to be the rounded one
// (divide_by_small).

#if defined(BIHIVE_RENDER_WAVE_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_RENDER_WAVE_LANES_INL_H_
#undef BIHIVE_RENDER_WAVE_LANES_INL_H_
#else
#define BIHIVE_RENDER_WAVE_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "bihive/kernels/wasm_float64-inl.h"
#include "bihive/kernels/wasm_lanes-inl.h"
#include "bihive/math/elementary.h"
#include "bihive/math/vec3.h"
#include "bihive/render/wave.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using FloatHalf = hn::Rebind<float, Tag>;
using WordTag = hn::Rebind<std::int64_t, Tag>;
using Lanes = hn::Vec<Tag>;
using Words = hn::Vec<WordTag>;
using LaneMask = hn::Mask<Tag>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
static_assert(kLanes <= kColumnPadding);

HWY_INLINE Lanes all(double x) {
  return hn::Set(Tag(), x);
}
HWY_INLINE LaneMask first_lanes(std::int64_t n) {
  return hn::FirstN(Tag(), static_cast<std::size_t>(std::min<std::int64_t>(n, kLanes)));
}
HWY_INLINE LaneMask lanes_of(hn::Mask<WordTag> mask) {
  return hn::RebindMask(Tag(), mask);
}
HWY_INLINE hn::Mask<WordTag> words_of(LaneMask mask) {
  return hn::RebindMask(WordTag(), mask);
}
HWY_INLINE bool none(LaneMask mask) {
  return hn::AllFalse(Tag(), mask);
}
HWY_INLINE bool every(LaneMask mask) {
  return hn::AllTrue(Tag(), mask);
}

HWY_INLINE Lanes load(const Column<double>& column, std::int64_t i) {
  return hn::LoadU(Tag(), column.data() + i);
}
HWY_INLINE Lanes load(const Column<float>& column, std::int64_t i) {
  return hn::PromoteTo(Tag(), hn::LoadU(FloatHalf(), column.data() + i));
}
HWY_INLINE Words load(const Column<std::int64_t>& column, std::int64_t i) {
  return hn::LoadU(WordTag(), column.data() + i);
}
HWY_INLINE void store(Lanes v, Column<double>& column, std::int64_t i) {
  hn::StoreU(v, Tag(), column.data() + i);
}
HWY_INLINE void store(Lanes v, Column<float>& column, std::int64_t i) {
  hn::StoreU(hn::DemoteTo(FloatHalf(), v), FloatHalf(), column.data() + i);
}
HWY_INLINE void store(Words v, Column<std::int64_t>& column, std::int64_t i) {
  hn::StoreU(v, WordTag(), column.data() + i);
}

/// As bytes; each must fit one.
HWY_INLINE void store(Words v, Column<std::uint8_t>& column, std::int64_t i) {
  alignas(64) std::int64_t words[kLanes];
  hn::Store(v, WordTag(), words);
  for (int k = 0; k < kLanes; ++k) column[i + k] = static_cast<std::uint8_t>(words[k]);
}

/// Vec3d of several rays. Its parts are named one by one, never by number: GCC 12 would copy it through memory.
struct Lanes3 {
  Lanes x, y, z;
};

HWY_INLINE Lanes3 all(Vec3d v) {
  return {all(v.x), all(v.y), all(v.z)};
}
template <class T>
HWY_INLINE Lanes3 load(const Column<T> (&columns)[3], std::int64_t i) {
  return {load(columns[0], i), load(columns[1], i), load(columns[2], i)};
}
HWY_INLINE Lanes3 add(Lanes3 a, Lanes3 b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Lanes3 subtract(Lanes3 a, Lanes3 b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
HWY_INLINE Lanes3 negate(Lanes3 a) {
  return {hn::Neg(a.x), hn::Neg(a.y), hn::Neg(a.z)};
}
HWY_INLINE Lanes3 multiply(Lanes3 a, Lanes3 b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
HWY_INLINE Lanes3 multiply(Lanes s, Lanes3 a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE Lanes3 divide(Lanes3 a, Lanes s) {
  return {hn::Div(a.x, s), hn::Div(a.y, s), hn::Div(a.z, s)};
}
HWY_INLINE Lanes dot(Lanes3 a, Lanes3 b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Lanes length(Lanes3 a) {
  return hn::Sqrt(dot(a, a));
}
HWY_INLINE Lanes3 normalized(Lanes3 a) {
  return divide(a, length(a));
}
HWY_INLINE Lanes3 choose(LaneMask mask, Lanes3 yes, Lanes3 no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}
template <class T>
HWY_INLINE void store(Lanes3 v, Column<T> (&columns)[3], std::int64_t i) {
  store(v.x, columns[0], i);
  store(v.y, columns[1], i);
  store(v.z, columns[2], i);
}

// Highway 1.0.3 keeps its tables for 64-bit lanes in a local array, which GCC 12 copies to the stack for each vector: 2
// KiB. So this is our own.
#if HWY_TARGET == HWY_AVX2
// Halves of the lanes of each mask in front, in their order.
struct CompressTable {
  alignas(32) std::int32_t halves[16][8];
};
constexpr CompressTable make_compress_table() {
  CompressTable table{};
  for (int mask = 0; mask < 16; ++mask) {
    int at = 0;
    for (int lane = 0; lane < 4; ++lane) {
      if ((mask >> lane & 1) == 0) continue;
      table.halves[mask][at++] = 2 * lane;
      table.halves[mask][at++] = 2 * lane + 1;
    }
  }
  return table;
}
inline constexpr CompressTable kCompressTable = make_compress_table();
#endif

/// Moves the lanes of a mask together, to the front; what comes behind them is undefined.
class Compressor {
 public:
#if HWY_TARGET == HWY_AVX3
  HWY_INLINE explicit Compressor(LaneMask mask) : mask_(mask) {}
  HWY_INLINE Lanes operator()(Lanes v) const {
    return Lanes{_mm512_maskz_compress_pd(mask_.raw, v.raw)};
  }

 private:
  LaneMask mask_;
#elif HWY_TARGET == HWY_AVX2
  HWY_INLINE explicit Compressor(LaneMask mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(Tag(), mask, bits);
    halves_ = kCompressTable.halves[bits[0] & 15];
  }
  HWY_INLINE Lanes operator()(Lanes v) const {
    const hn::Repartition<float, Tag> f;
    return hn::BitCast(Tag(), hn::TableLookupLanes(hn::BitCast(f, v), hn::SetTableIndices(f, halves_)));
  }

 private:
  const std::int32_t* halves_;
#elif HWY_TARGET == HWY_WASM
  // The first lane stays where it is, or the second takes its place.
  HWY_INLINE explicit Compressor(LaneMask mask)
      : first_stays_(hn::MaskFromVec(hn::InterleaveLower(hn::VecFromMask(Tag(), mask), hn::VecFromMask(Tag(), mask)))) {
  }
  HWY_INLINE Lanes operator()(Lanes v) const {
    return hn::IfThenElse(first_stays_, v, hn::InterleaveUpper(Tag(), v, v));
  }

 private:
  LaneMask first_stays_;
#else
  HWY_INLINE explicit Compressor(LaneMask mask) {
    hn::StoreMaskBits(Tag(), mask, bits_);
  }
  HWY_INLINE Lanes operator()(Lanes v) const {
    alignas(64) double lanes[kLanes], kept[kLanes] = {};
    hn::Store(v, Tag(), lanes);
    int at = 0;
    for (int k = 0; k < kLanes; ++k)
      if ((bits_[0] >> k & 1) != 0) kept[at++] = lanes[k];
    return hn::Load(Tag(), kept);
  }

 private:
  std::uint8_t bits_[8] = {};
#endif
};

/// Appends lanes to columns: all of them, or those of a mask moved together. Writes up to a vector past the last.
class Appender {
 public:
  HWY_INLINE Appender(LaneMask keep, std::int64_t at)
      : compress_(keep), every_(every(keep)), count_(static_cast<std::int64_t>(hn::CountTrue(Tag(), keep))), at_(at) {}
  HWY_INLINE std::int64_t count() const { return count_; }

  template <class T>
  HWY_INLINE void operator()(Lanes v, Column<T>& column) const {
    store(HWY_LIKELY(every_) ? v : compress_(v), column, at_);
  }
  template <class T>
  HWY_INLINE void operator()(Words v, Column<T>& column) const {
    store(HWY_LIKELY(every_) ? v : hn::BitCast(WordTag(), compress_(hn::BitCast(Tag(), v))), column, at_);
  }
  template <class T>
  HWY_INLINE void operator()(Lanes3 v, Column<T> (&columns)[3]) const {
    (*this)(v.x, columns[0]);
    (*this)(v.y, columns[1]);
    (*this)(v.z, columns[2]);
  }

 private:
  Compressor compress_;
  bool every_;
  std::int64_t count_, at_;
};

/// Whole numbers below 2^51 in magnitude from one form to the other.
HWY_INLINE Words words_from_whole(Lanes whole) {
  const auto magic = all(0x1.8p52);
  return hn::Sub(hn::BitCast(WordTag(), hn::Add(whole, magic)), hn::BitCast(WordTag(), magic));
}
HWY_INLINE Lanes whole_from_words(Words words) {
  const auto magic = all(0x1.8p52);
  return hn::Sub(hn::BitCast(Tag(), hn::Add(words, hn::BitCast(WordTag(), magic))), magic);
}
/// 2^whole for -1022 <= whole <= 1023.
HWY_INLINE Lanes power_of_two(Lanes whole) {
  const auto biased = hn::Add(words_from_whole(whole), hn::Set(WordTag(), 1023));
  return hn::BitCast(Tag(), hn::ShiftLeft<52>(biased));
}

/// portable_log2() of normal numbers.
HWY_INLINE Lanes log2_of(Lanes x) {
  // Split into mantissa in [sqrt(1/2), sqrt(2)) and exponent, both exact.
  const WordTag w;
  const auto bits = hn::BitCast(w, x);
  auto exponent = whole_from_words(hn::Sub(hn::ShiftRight<52>(bits), hn::Set(w, 1022)));
  auto mantissa =
      hn::BitCast(Tag(), hn::Or(hn::And(bits, hn::Set(w, 0x000FFFFFFFFFFFFF)), hn::Set(w, 0x3FE0000000000000)));
  const auto small = hn::Lt(mantissa, all(0.70710678118654752440));
  mantissa = hn::IfThenElse(small, hn::Add(mantissa, mantissa), mantissa);
  exponent = hn::IfThenElse(small, hn::Sub(exponent, all(1)), exponent);

  const auto s = hn::Div(hn::Sub(mantissa, all(1)), hn::Add(mantissa, all(1)));
  const auto s2 = hn::Mul(s, s);
  auto series = all(0);
  for (int k = 23; k >= 3; k -= 2) series = hn::Mul(hn::Add(series, all(1.0 / k)), s2);
  const auto ln = hn::Mul(hn::Mul(all(2), s), hn::Add(all(1), series));
  return hn::Add(exponent, hn::Mul(ln, all(1.44269504088896340736)));
}

/// x / k, rounded to nearest, for a whole k from 1 to 14 and |x| below 2; right to a part in 2^50 where |x| < 2^-900.
HWY_INLINE Lanes divide_by_small(Lanes x, int k) {
#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_AVX3
  // Markstein's theorem: from a quotient that is right to one unit in the last place, with the rounded reciprocal, the
  // exact remainder gives the rounded quotient. For each of these k the reciprocal's relative error is at most 2^-54,
  // so that with the rounding of the product the first quotient is right to one unit.
  const Lanes reciprocal = all(1.0 / k);
  const Lanes quotient = hn::Mul(x, reciprocal);
  const Lanes remainder = hn::NegMulAdd(quotient, all(k), x);
  return hn::MulAdd(remainder, reciprocal, quotient);
#else
  return hn::Div(x, all(k));
#endif
}

/// portable_exp2() for -1075 <= x <= 1024.
HWY_INLINE Lanes exp2_of(Lanes x) {
  const auto whole = hn::Floor(hn::Add(x, all(0.5)));
  const auto y = hn::Mul(hn::Sub(x, whole), all(0.69314718055994530942));
  auto series = all(1);
  for (int k = 14; k >= 1; --k) series = hn::Add(all(1), divide_by_small(hn::Mul(series, y), k));
  // In two steps: the first is exact, so that the result is rounded once where it is small.
  const auto half = hn::Floor(hn::Mul(whole, all(0.5)));
  return hn::Mul(hn::Mul(series, power_of_two(half)), power_of_two(hn::Sub(whole, half)));
}

/// portable_pow() where the mask is set, x > 0 there.
HWY_INLINE Lanes pow_of(LaneMask mask, Lanes x, Lanes y) {
  // Almost always nothing is out of the ordinary.
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

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_RENDER_WAVE_LANES_INL_H_
