#include "bihive/render/wave/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/wave/camera_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/wave/lanes-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// PixelRays prepared for vectors.
struct CameraLanes {
  Lanes3 forward, right, down;
  Lanes half_width, half_height;

  HWY_INLINE Lanes3 direction(Lanes x, Lanes y) const {
    const Lanes3 along_row = add(forward, multiply(hn::Sub(x, half_width), right));
    return normalized(add(along_row, multiply(hn::Sub(y, half_height), down)));
  }
};

HWY_INLINE CameraLanes camera_lanes(const PixelRays& pixels) {
  return {all(pixels.forward()), all(pixels.right()), all(pixels.down()), all(pixels.half_width()),
          all(pixels.half_height())};
}

HWY_INLINE void put_eye(const PixelRays& pixels, Wave& wave) {
  const Lanes3 eye = all(to_double(pixels.eye()));
  for (std::int64_t i = 0; i < wave.count; i += kLanes) store(eye, wave.origin, i);
}

void camera_rays_on_target(const PixelRays& pixels, const double* x, const double* y, Wave& wave) {
  const CameraLanes camera = camera_lanes(pixels);
  put_eye(pixels, wave);
  for (std::int64_t i = 0; i < wave.count; i += kLanes) {
    const Lanes3 direction = camera.direction(hn::LoadU(Tag(), x + i), hn::LoadU(Tag(), y + i));
    store(direction, wave.direction, i);
  }
}

void pixel_rays_on_target(const PixelRays& pixels, const PixelPlace* pixel, SamplePlace place, Wave& wave) {
  // x is the lower half of a pixel's word, y the upper one: all supported machines have that byte order.
  static_assert(sizeof(PixelPlace) == sizeof(std::uint32_t));
  constexpr hn::Rebind<std::int32_t, Tag> i32;
  constexpr hn::Rebind<std::uint32_t, Tag> u32;
  const auto* const words = reinterpret_cast<const std::uint32_t*>(pixel);
  const CameraLanes camera = camera_lanes(pixels);
  put_eye(pixels, wave);
  for (std::int64_t i = 0; i < wave.count; i += kLanes) {
    const auto both = hn::LoadU(u32, words + i);
    const auto x_of = hn::BitCast(i32, hn::And(both, hn::Set(u32, 0xFFFF)));
    const auto y_of = hn::BitCast(i32, hn::ShiftRight<16>(both));
    const Lanes x = hn::Add(hn::PromoteTo(Tag(), x_of), all(place.x));
    const Lanes y = hn::Add(hn::PromoteTo(Tag(), y_of), all(place.y));
    const Lanes3 direction = camera.direction(x, y);
    store(direction, wave.direction, i);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(camera_rays_on_target);
HWY_EXPORT(pixel_rays_on_target);

namespace steps {

void camera_rays(const PixelRays& pixels, const double* x, const double* y, Wave& wave) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(camera_rays_on_target)(pixels, x, y, wave);
}

void camera_rays(const PixelRays& pixels, const PixelPlace* pixel, SamplePlace place, Wave& wave) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(pixel_rays_on_target)(pixels, pixel, place, wave);
}

}  // namespace steps
}  // namespace bihive
#endif
