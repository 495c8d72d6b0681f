#include "bihive/render/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/camera_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/kernels/dispatch.h"
#include "bihive/render/wave_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

void camera_rays_on_target(const PixelRays& pixels, const double* x, const double* y, Wave& wave) {
  const Lanes3 forward = all(pixels.forward());
  const Lanes3 right = all(pixels.right());
  const Lanes3 down = all(pixels.down());
  const Lanes half_width = all(pixels.half_width());
  const Lanes half_height = all(pixels.half_height());
  const Lanes3 eye = all(to_double(pixels.eye()));
  for (std::int64_t i = 0; i < wave.count; i += kLanes) {
    const Lanes steps_right = hn::Sub(hn::LoadU(Tag(), x + i), half_width);
    const Lanes steps_down = hn::Sub(hn::LoadU(Tag(), y + i), half_height);
    const Lanes3 direction = normalized(add(add(forward, multiply(steps_right, right)), multiply(steps_down, down)));
    for (int axis = 0; axis < 3; ++axis) {
      store(eye[axis], wave.origin[axis], i);
      store(direction[axis], wave.direction[axis], i);
    }
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(camera_rays_on_target);

namespace steps {

void camera_rays(const PixelRays& pixels, const double* x, const double* y, Wave& wave) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(camera_rays_on_target)(pixels, x, y, wave);
}

}  // namespace steps
}  // namespace bihive
#endif
