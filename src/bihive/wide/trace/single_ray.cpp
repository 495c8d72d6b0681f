#include "bihive/wide/trace/single_ray.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/wide/trace/single_ray.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/simd/dispatch.h"
#include "bihive/wide/trace/ray_walk-inl.h"
#include "bihive/wide/trace/scalar_walk.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

Hit closest_hit_on_target(const WideTree& tree, const Ray& ray) {
  return answer_single<false>(tree, ray);
}

bool occluded_on_target(const WideTree& tree, const Ray& ray) {
  return answer_single<true>(tree, ray).found();
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(closest_hit_on_target);
HWY_EXPORT(occluded_on_target);

namespace kernels {

Hit closest_hit_single(const WideTree& tree, const Ray& ray) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(closest_hit_on_target)(tree, ray);
}

bool occluded_single(const WideTree& tree, const Ray& ray) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(occluded_on_target)(tree, ray);
}

}  // namespace kernels
}  // namespace bihive
#endif
