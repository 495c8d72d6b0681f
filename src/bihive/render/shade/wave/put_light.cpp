#include <cstring>

#include "bihive/render/shade/wave/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/shade/wave/put_light.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

constexpr std::int64_t kBlock = kBlockPx * kBlockPx;

// Four pixels from their channels, in pairs of neighbours.
HWY_INLINE void put_square(const float* red, const float* green, const float* blue, Vec3f* above, Vec3f* below) {
  alignas(16) Vec3f pixels[4];
#if HWY_TARGET == HWY_SCALAR
  for (int k = 0; k < 4; ++k) pixels[k] = {red[k], green[k], blue[k]};
#else
  constexpr hn::FixedTag<float, 4> four;
  hn::StoreInterleaved3(hn::Load(four, red), hn::Load(four, green), hn::Load(four, blue), four, &pixels[0].x);
#endif
  // Load sixteen bytes if they were stored as sixteen bytes: a processor waits when a load covers two recent stores.
  const auto* const from = reinterpret_cast<const char*>(pixels);
  auto* const to_above = reinterpret_cast<char*>(above);
  auto* const to_below = reinterpret_cast<char*>(below);
  std::memcpy(to_above, from, 16);
  std::memcpy(to_above + 16, from + 16, 8);
  std::memcpy(to_below, from + 24, 8);
  std::memcpy(to_below + 8, from + 32, 16);
}

// The pixels of a whole block, in the order of kZCurve: squares of two by two.
HWY_INLINE void put_block(const float (&channel)[3][kBlock], Vec3f* corner, std::size_t width) {
  for (std::int64_t i = 0; i < kBlock; i += 4) {
    const PixelPlace step = kZCurve[static_cast<std::size_t>(i)];
    Vec3f* const above = corner + step.y * width + step.x;
    put_square(channel[0] + i, channel[1] + i, channel[2] + i, above, above + width);
  }
}

void put_light_on_target(const WaveSums& sums, const PixelPlace* pixel, std::int64_t count, PixelPlace film_corner,
                         Film& film) {
  alignas(64) float channel[3][kBlock];
  Vec3f* const radiance = film.radiance.data();
  const auto width = static_cast<std::size_t>(film.width);
  const auto place_of = [&](PixelPlace place) {
    return static_cast<std::size_t>(place.y - film_corner.y) * width +
           static_cast<std::size_t>(place.x - film_corner.x);
  };
  for (std::int64_t first = 0; first < count; first += kBlock) {
    const std::int64_t n = std::min(kBlock, count - first);
    for (int k = 0; k < 3; ++k)
      for (std::int64_t i = 0; i < n; i += kLanes)
        hn::Store(hn::DemoteTo(FloatHalf(), load(sums.light[k], first + i)), FloatHalf(), channel[k] + i);
    const PixelPlace* const place = pixel + first;
    if (HWY_LIKELY(n == kBlock && is_whole_block(place))) {
      put_block(channel, radiance + place_of(*place), width);
      continue;
    }
    for (std::int64_t i = 0; i < n; ++i) radiance[place_of(place[i])] = {channel[0][i], channel[1][i], channel[2][i]};
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(put_light_on_target);

namespace steps {

void put_light(const WaveSums& sums, const PixelPlace* pixel, std::int64_t count, PixelPlace film_corner, Film& film) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(put_light_on_target)(sums, pixel, count, film_corner, film);
}

}  // namespace steps
}  // namespace bihive
#endif
