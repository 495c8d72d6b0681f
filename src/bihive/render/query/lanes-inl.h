// Vectors of binary64: math/vec3.h on several rays at a time, with the same operations in the
// same order, none fused.

#if defined(BIHIVE_RENDER_QUERY_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_RENDER_QUERY_LANES_INL_H_
#undef BIHIVE_RENDER_QUERY_LANES_INL_H_
#else
#define BIHIVE_RENDER_QUERY_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "bihive/math/vec3.h"
#include "bihive/render/query/column.h"
#include "bihive/simd/wasm_float64-inl.h"
#include "bihive/simd/wasm_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using FloatHalf = hn::Rebind<float, Tag>;
using LongTag = hn::Rebind<std::int64_t, Tag>;
using Lanes = hn::Vec<Tag>;
using Longs = hn::Vec<LongTag>;
using LaneMask = hn::Mask<Tag>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
static_assert(kLanes <= kColumnPadding);

HWY_INLINE Lanes all(double x) {
  return hn::Set(Tag(), x);
}
/// first, first + 1, ... Highway 1.0.3 would store a vector to memory and load it.
HWY_INLINE Longs counted_from(std::int64_t first) {
  return hn::Add(hn::Iota(LongTag(), 0), hn::Set(LongTag(), first));
}
HWY_INLINE LaneMask first_lanes(std::int64_t n) {
  return hn::FirstN(Tag(), static_cast<std::size_t>(std::min<std::int64_t>(n, kLanes)));
}
HWY_INLINE LaneMask lanes_of(hn::Mask<LongTag> mask) {
  return hn::RebindMask(Tag(), mask);
}
HWY_INLINE hn::Mask<LongTag> longs_of(LaneMask mask) {
  return hn::RebindMask(LongTag(), mask);
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
HWY_INLINE Longs load(const Column<std::int64_t>& column, std::int64_t i) {
  return hn::LoadU(LongTag(), column.data() + i);
}
HWY_INLINE void store(Lanes v, Column<double>& column, std::int64_t i) {
  hn::StoreU(v, Tag(), column.data() + i);
}
HWY_INLINE void store(Lanes v, Column<float>& column, std::int64_t i) {
  hn::StoreU(hn::DemoteTo(FloatHalf(), v), FloatHalf(), column.data() + i);
}
HWY_INLINE void store(Longs v, Column<std::int64_t>& column, std::int64_t i) {
  hn::StoreU(v, LongTag(), column.data() + i);
}

/// As bytes; each number must fit one byte.
HWY_INLINE void store(Longs v, Column<std::uint8_t>& column, std::int64_t i) {
  alignas(64) std::int64_t words[kLanes];
  hn::Store(v, LongTag(), words);
  for (int k = 0; k < kLanes; ++k) column[i + k] = static_cast<std::uint8_t>(words[k]);
}

/// column[at[k]] in lane k, by one load and one insertion for each lane. A vector load of lanes that were just stored
/// one by one would have to wait.
HWY_INLINE Lanes gathered(const float* column, const std::int64_t* at) {
#if HWY_TARGET == HWY_AVX3
  const __m128 lower = _mm_set_ps(column[at[3]], column[at[2]], column[at[1]], column[at[0]]);
  const __m128 upper = _mm_set_ps(column[at[7]], column[at[6]], column[at[5]], column[at[4]]);
  return Lanes{_mm512_cvtps_pd(_mm256_set_m128(upper, lower))};
#elif HWY_TARGET == HWY_AVX2
  return Lanes{_mm256_cvtps_pd(_mm_set_ps(column[at[3]], column[at[2]], column[at[1]], column[at[0]]))};
#else
  alignas(64) double entry[kLanes];
  for (int k = 0; k < kLanes; ++k) entry[k] = double(column[at[k]]);
  return hn::Load(Tag(), entry);
#endif
}
HWY_INLINE Longs gathered(const std::int32_t* column, const std::int64_t* at) {
#if HWY_TARGET == HWY_AVX3
  return Longs{_mm512_set_epi64(column[at[7]], column[at[6]], column[at[5]], column[at[4]], column[at[3]],
                                column[at[2]], column[at[1]], column[at[0]])};
#elif HWY_TARGET == HWY_AVX2
  return Longs{_mm256_cvtepi32_epi64(_mm_set_epi32(column[at[3]], column[at[2]], column[at[1]], column[at[0]]))};
#else
  alignas(64) std::int64_t entry[kLanes];
  for (int k = 0; k < kLanes; ++k) entry[k] = column[at[k]];
  return hn::Load(LongTag(), entry);
#endif
}

/// Vec3d of several rays. Its parts have names, not numbers: with numbers GCC 12 would copy it through memory.
struct Lanes3 {
  Lanes x, y, z;
};

HWY_INLINE Lanes3 all(Vec3d v) {
  return {all(v.x), all(v.y), all(v.z)};
}
template <class T>
HWY_INLINE Lanes3 load(const Columns3<T>& columns, std::int64_t i) {
  return {load(columns[0], i), load(columns[1], i), load(columns[2], i)};
}
HWY_INLINE Lanes3 add(Lanes3 a, Lanes3 b) {
  return {hn::Add(a.x, b.x), hn::Add(a.y, b.y), hn::Add(a.z, b.z)};
}
HWY_INLINE Lanes3 subtract(Lanes3 a, Lanes3 b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
/// -a where the mask is set.
HWY_INLINE Lanes3 negate(LaneMask mask, Lanes3 a) {
  const Lanes flip = hn::IfThenElseZero(mask, all(-0.0));
  return {hn::Xor(flip, a.x), hn::Xor(flip, a.y), hn::Xor(flip, a.z)};
}
HWY_INLINE Lanes3 multiply(Lanes3 a, Lanes3 b) {
  return {hn::Mul(a.x, b.x), hn::Mul(a.y, b.y), hn::Mul(a.z, b.z)};
}
HWY_INLINE Lanes3 multiply(Lanes s, Lanes3 a) {
  return {hn::Mul(s, a.x), hn::Mul(s, a.y), hn::Mul(s, a.z)};
}
HWY_INLINE Lanes dot(Lanes3 a, Lanes3 b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE Lanes length(Lanes3 a) {
  return hn::Sqrt(dot(a, a));
}
HWY_INLINE Lanes3 normalized(Lanes3 a) {
  return multiply(hn::Div(all(1), length(a)), a);
}
/// A lane that is far from length 1 is normalized by itself.
HWY_INLINE Lanes3 normalized_again(Lanes3 a) {
  const Lanes beyond = hn::Sub(dot(a, a), all(1));
  const Lanes series = hn::Sub(all(1), hn::Mul(beyond, hn::Sub(all(0.5), hn::Mul(all(0.375), beyond))));
  const LaneMask almost = hn::Lt(hn::Abs(beyond), all(0x1p-18));
  if (HWY_LIKELY(every(almost))) return multiply(series, a);
  return multiply(hn::IfThenElse(almost, series, hn::Div(all(1), length(a))), a);
}
HWY_INLINE Lanes3 choose(LaneMask mask, Lanes3 yes, Lanes3 no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y), hn::IfThenElse(mask, yes.z, no.z)};
}
/// To the nearest number of binary32.
HWY_INLINE Lanes3 rounded_to_float(Lanes3 a) {
  const FloatHalf f;
  return {hn::PromoteTo(Tag(), hn::DemoteTo(f, a.x)), hn::PromoteTo(Tag(), hn::DemoteTo(f, a.y)),
          hn::PromoteTo(Tag(), hn::DemoteTo(f, a.z))};
}
template <class T>
HWY_INLINE void store(Lanes3 v, Columns3<T>& columns, std::int64_t i) {
  store(v.x, columns[0], i);
  store(v.y, columns[1], i);
  store(v.z, columns[2], i);
}

// Highway 1.0.3 keeps its tables for 64-bit lanes in a local array, and GCC 12 copies that array to the stack for each
// vector: 2 KiB. So this table is our own.
#if HWY_TARGET == HWY_AVX2
// Moves the halves of the lanes of each mask to the front, in their order.
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

/// Moves the lanes of a mask together, to the front; the lanes behind them are undefined.
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
  // The first lane stays, or the second one takes its place.
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

/// Appends lanes to columns: all of them, or the lanes of a mask moved together. Writes up to a vector past the last.
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
  HWY_INLINE void operator()(Longs v, Column<T>& column) const {
    store(HWY_LIKELY(every_) ? v : hn::BitCast(LongTag(), compress_(hn::BitCast(Tag(), v))), column, at_);
  }
  template <class T>
  HWY_INLINE void operator()(Lanes3 v, Columns3<T>& columns) const {
    (*this)(v.x, columns[0]);
    (*this)(v.y, columns[1]);
    (*this)(v.z, columns[2]);
  }

 private:
  Compressor compress_;
  bool every_;
  std::int64_t count_, at_;
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_RENDER_QUERY_LANES_INL_H_
