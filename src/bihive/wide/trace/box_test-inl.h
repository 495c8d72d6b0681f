// One ray against boxes: where it enters and exits them.

#if defined(BIHIVE_WIDE_TRACE_BOX_TEST_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_WIDE_TRACE_BOX_TEST_INL_H_
#undef BIHIVE_WIDE_TRACE_BOX_TEST_INL_H_
#else
#define BIHIVE_WIDE_TRACE_BOX_TEST_INL_H_
#endif

#include <hwy/highway.h>

#include "bihive/simd/lanes-inl.h"
#include "bihive/wide/trace/filter_bounds.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// The near and far sides of boxes for a ray, axis by axis; kFloatLanes boxes from `lane` on. Memory must be aligned.
struct BoxLanes {
  Floats near_x, near_y, near_z, far_x, far_y, far_z;
  HWY_INLINE BoxLanes(const float* const near[3], const float* const far[3], int lane)
      : near_x(hn::Load(FloatTag(), near[0] + lane)),
        near_y(hn::Load(FloatTag(), near[1] + lane)),
        near_z(hn::Load(FloatTag(), near[2] + lane)),
        far_x(hn::Load(FloatTag(), far[0] + lane)),
        far_y(hn::Load(FloatTag(), far[1] + lane)),
        far_z(hn::Load(FloatTag(), far[2] + lane)) {}
};

/// A ray in all lanes. Either planes were moved outward (then both offsets are the ray's own) or the offsets were.
struct BoxRay {
  Floats ix, iy, iz, near_x, near_y, near_z, far_x, far_y, far_z, s_min, s_best;
  HWY_INLINE BoxRay(const LocalRay& ray, const float near_offset[3], const float far_offset[3], float best)
      : ix(in_all(ray.inverse[0])),
        iy(in_all(ray.inverse[1])),
        iz(in_all(ray.inverse[2])),
        near_x(in_all(near_offset[0])),
        near_y(in_all(near_offset[1])),
        near_z(in_all(near_offset[2])),
        far_x(in_all(far_offset[0])),
        far_y(in_all(far_offset[1])),
        far_z(in_all(far_offset[2])),
        s_min(in_all(ray.s_min)),
        s_best(in_all(best)) {}

  /// The distances at which the ray's segment enters and exits the boxes: it meets a box if the first is not above the
  /// second.
  HWY_INLINE Floats entry(const BoxLanes& boxes) const {
    const auto s_x = hn::MulAdd(boxes.near_x, ix, near_x);
    const auto s_y = hn::MulAdd(boxes.near_y, iy, near_y);
    const auto s_z = hn::MulAdd(boxes.near_z, iz, near_z);
    return hn::Max(hn::Max(s_x, s_y), hn::Max(s_z, s_min));
  }
  HWY_INLINE Floats exit(const BoxLanes& boxes) const {
    const auto s_x = hn::MulAdd(boxes.far_x, ix, far_x);
    const auto s_y = hn::MulAdd(boxes.far_y, iy, far_y);
    const auto s_z = hn::MulAdd(boxes.far_z, iz, far_z);
    return hn::Min(hn::Min(s_x, s_y), hn::Min(s_z, s_best));
  }
};

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_WIDE_TRACE_BOX_TEST_INL_H_
