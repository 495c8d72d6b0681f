#include "bihive/render/shade/wave/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/shade/wave/shade_primaries.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/render/shade/wave/light-inl.h"
#include "bihive/render/shade/wave/surfaces-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

template <bool kOneOrigin>
HWY_INLINE void shade_primaries_from(const WaveScene& scene, const WavePart& part, const double* t,
                                     const std::int64_t* id, WaveSums& sums) {
  const LongTag w;
  const Wave& wave = *part.wave;
  double* const red = sums.light[0].data();
  double* const green = sums.light[1].data();
  double* const blue = sums.light[2].data();
  const Plane* const plane = scene.scene->plane ? &scene.plane : nullptr;
  const Lanes3 background = add(all(Vec3d{}), all(scene.scene->background));
  // Of rays from one origin, the plane's height above it is the same for all.
  const Lanes3 eye = all(Vec3d{double(wave.origin[0][part.first]), double(wave.origin[1][part.first]),
                               double(wave.origin[2][part.first])});
  const Lanes plane_above = plane != nullptr ? height_above(*plane, eye) : all(0);
  const std::int64_t first = part.first;
  const std::int64_t count = part.count();
  for (std::int64_t k = 0; k < count; k += kLanes) {
    const std::int64_t i = first + k;
    RayLanes rays{kOneOrigin ? eye : load(wave.origin, i), load(wave.direction, i), hn::LoadU(Tag(), t + k),
                  hn::LoadU(w, id + k)};
    if (plane != nullptr) {
      Lanes plane_t;
      const Lanes above = kOneOrigin ? plane_above : height_above(*plane, rays.origin);
      const LaneMask hit = hits_plane(*plane, above, rays, plane_t);
      put_plane(hit, plane_t, rays);
    }
    LaneMask found = lanes_of(hn::Ne(rays.id, hn::Set(w, kNothing)));
    if (HWY_UNLIKELY(count - k < kLanes)) found = hn::And(found, first_lanes(count - k));
    Lanes3 light = background;
    if (!none(found)) {
      const SurfaceLanes surface = surfaces_at(scene, found, wave, i, rays);
      light =
          choose(found, add(all(Vec3d{}), local_light(scene, found, surface, {}, 0, all(Vec3d{1, 1, 1}))), background);
    }
    hn::StoreU(light.x, Tag(), red + i);
    hn::StoreU(light.y, Tag(), green + i);
    hn::StoreU(light.z, Tag(), blue + i);
  }
}

void shade_primaries_on_target(const WaveScene& scene, const WavePart& part, const double* t, const std::int64_t* id,
                               WaveSums& sums) {
  if (part.wave->has_one_origin)
    shade_primaries_from<true>(scene, part, t, id, sums);
  else
    shade_primaries_from<false>(scene, part, t, id, sums);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(shade_primaries_on_target);

namespace steps {

void shade_primaries(const WaveScene& scene, const WavePart& rays, const double* t, const std::int64_t* id,
                     WaveSums& sums) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(shade_primaries_on_target)(scene, rays, t, id, sums);
}

}  // namespace steps
}  // namespace bihive
#endif
