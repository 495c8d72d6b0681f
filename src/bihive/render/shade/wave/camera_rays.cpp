#include "bihive/render/shade/wave/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/shade/wave/camera_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// PixelRays prepared for vectors. `start` is forward, or of parallel rays the centre.
struct CameraLanes {
  Lanes3 start, right, down;
  Lanes half_width, half_height;

  HWY_INLINE Lanes3 at(Lanes x, Lanes y) const {
    const Lanes3 along_row = add(start, multiply(hn::Sub(x, half_width), right));
    return add(along_row, multiply(hn::Sub(y, half_height), down));
  }
};

HWY_INLINE CameraLanes camera_lanes(const PixelRays& pixels) {
  return {all(pixels.parallel() ? pixels.centre() : pixels.forward()), all(pixels.right()), all(pixels.down()),
          all(pixels.half_width()), all(pixels.half_height())};
}

HWY_INLINE void put_everywhere(Vec3d vector, Columns3<float>& columns, std::int64_t count) {
  const Lanes3 lanes = all(vector);
  for (std::int64_t i = 0; i < count; i += kLanes) store(lanes, columns, i);
}

// Calls place_of(i, x, y) for the picture positions of rays i and its neighbours.
template <class PlaceOf>
HWY_INLINE void make_rays(const PixelRays& pixels, Wave& wave, const PlaceOf& place_of) {
  const CameraLanes camera = camera_lanes(pixels);
  Lanes x, y;
  if (pixels.parallel()) {
    put_everywhere(pixels.forward(), wave.direction, wave.count);
    for (std::int64_t i = 0; i < wave.count; i += kLanes) {
      place_of(i, x, y);
      store(camera.at(x, y), wave.origin, i);
    }
    return;
  }
  put_everywhere(to_double(pixels.eye()), wave.origin, wave.count);
  for (std::int64_t i = 0; i < wave.count; i += kLanes) {
    place_of(i, x, y);
    store(normalized(camera.at(x, y)), wave.direction, i);
  }
}

HWY_INLINE void make_lens_rays(const PixelRays& pixels, const PicturePositions& positions, Wave& wave) {
  const CameraLanes camera = camera_lanes(pixels);
  const Lanes3 centre = all(pixels.centre());
  const Lanes3 lens_right = all(pixels.lens_right()), lens_down = all(pixels.lens_down());
  const Lanes3 tilt_right = all(pixels.tilt_right()), tilt_down = all(pixels.tilt_down());
  for (std::int64_t i = 0; i < wave.count; i += kLanes) {
    const Lanes right = hn::LoadU(Tag(), positions.lens_x + i), down = hn::LoadU(Tag(), positions.lens_y + i);
    const Lanes3 direction = camera.at(hn::LoadU(Tag(), positions.x + i), hn::LoadU(Tag(), positions.y + i));
    const Lanes3 tilt = add(multiply(right, tilt_right), multiply(down, tilt_down));
    store(add(centre, add(multiply(right, lens_right), multiply(down, lens_down))), wave.origin, i);
    store(normalized(subtract(direction, tilt)), wave.direction, i);
  }
}

void camera_rays_on_target(const PixelRays& pixels, const PicturePositions& positions, Wave& wave) {
  if (pixels.has_lens()) return make_lens_rays(pixels, positions, wave);
  make_rays(pixels, wave, [&](std::int64_t i, Lanes& x_px, Lanes& y_px) HWY_ATTR {
    x_px = hn::LoadU(Tag(), positions.x + i);
    y_px = hn::LoadU(Tag(), positions.y + i);
  });
}

void pixel_rays_on_target(const PixelRays& pixels, const PixelPlace* pixel, SamplePlace place, Wave& wave) {
  // x is the lower half of a pixel's word, y the upper one: all supported machines have that byte order.
  static_assert(sizeof(PixelPlace) == sizeof(std::uint32_t));
  constexpr hn::Rebind<std::int32_t, Tag> i32;
  constexpr hn::Rebind<std::uint32_t, Tag> u32;
  const auto* const words = reinterpret_cast<const std::uint32_t*>(pixel);
  make_rays(pixels, wave, [&](std::int64_t i, Lanes& x_px, Lanes& y_px) HWY_ATTR {
    const auto both = hn::LoadU(u32, words + i);
    const auto x_of = hn::BitCast(i32, hn::And(both, hn::Set(u32, 0xFFFF)));
    const auto y_of = hn::BitCast(i32, hn::ShiftRight<16>(both));
    x_px = hn::Add(hn::PromoteTo(Tag(), x_of), all(place.x));
    y_px = hn::Add(hn::PromoteTo(Tag(), y_of), all(place.y));
  });
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

void camera_rays(const PixelRays& pixels, const PicturePositions& positions, Wave& wave) {
  ensure_target();
  wave.has_one_origin = !pixels.parallel() && !pixels.has_lens();
  HWY_DYNAMIC_DISPATCH(camera_rays_on_target)(pixels, positions, wave);
}

void camera_rays(const PixelRays& pixels, const PixelPlace* pixel, SamplePlace place, Wave& wave) {
  ensure_target();
  wave.has_one_origin = !pixels.parallel();
  HWY_DYNAMIC_DISPATCH(pixel_rays_on_target)(pixels, pixel, place, wave);
}

}  // namespace steps
}  // namespace bihive
#endif
