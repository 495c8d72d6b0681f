// Spheres that lie in a beam's way. Few of a leaf's sixteen do, so they wait until they fill a vector.

#if defined(BIHIVE_WIDE_TRACE_WAITING_SPHERES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_WAITING_SPHERES_INL_H_
#undef BIHIVE_WIDE_TRACE_WAITING_SPHERES_INL_H_
#else
#define BIHIVE_WIDE_TRACE_WAITING_SPHERES_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "bihive/simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

class WaitingSpheres {
 public:
  bool empty() const { return count_ == 0; }
  /// Whether a vector is full, or there are enough that a beam should meet them before it continues: a hit ends it
  /// sooner.
  bool enough() const { return count_ >= std::min(kFloatLanes, 8); }

  /// Adds the spheres of `mask` among those from `slot` on. Not while there are enough().
  template <class V, class M>
  HWY_INLINE void add(std::int64_t slot, const V centre[3], V padded, M mask) {
    const FloatTag d;
    const WordTag w;
    for (int axis = 0; axis < 3; ++axis) store_compressed(d, centre[axis], mask, centre_[axis] + count_);
    store_compressed(d, padded, mask, padded_ + count_);
    const auto slots = iota_words(static_cast<std::uint32_t>(slot));
    count_ += static_cast<int>(store_compressed(w, slots, hn::RebindMask(w, mask), slot_ + count_));
  }

  /// The first ones, up to a vector of them.
  int first_count() const { return std::min(count_, kFloatLanes); }
  const float* centre(int axis) const { return centre_[axis]; }
  const float* padded() const { return padded_; }  ///< r + e
  std::uint32_t slot(int k) const { return slot_[k]; }

  void drop_first() {
    const FloatTag d;
    count_ -= first_count();
    for (int axis = 0; axis < 3; ++axis) hn::Store(hn::Load(d, centre_[axis] + kFloatLanes), d, centre_[axis]);
    hn::Store(hn::Load(d, padded_ + kFloatLanes), d, padded_);
    hn::Store(hn::Load(WordTag(), slot_ + kFloatLanes), WordTag(), slot_);
  }

 private:
  int count_ = 0;
  alignas(64) float centre_[3][2 * kFloatLanes];  // NOLINT: lanes after count_ are undefined
  alignas(64) float padded_[2 * kFloatLanes];
  alignas(64) std::uint32_t slot_[2 * kFloatLanes];
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_WAITING_SPHERES_INL_H_
