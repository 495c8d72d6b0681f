#include <algorithm>

#include "bihive/render/shade/wave/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/shade/wave/add_local_light.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/render/shade/wave/light-inl.h"
#include "bihive/render/shade/wave/surfaces-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

void find_shadow_rays_on_target(const WaveSurfaces& surfaces, std::int64_t first, const PointLight& light,
                                ShadowWave& shadows) {
  const LongTag w;
  for (std::int64_t i = first; i < surfaces.count; i += kLanes) {
    const Lanes3 origin = load(surfaces.origin, i);
    const LightLanes to_light(light.position, origin, load(surfaces.normal, i));
    const LaneMask lit = hn::And(to_light.in_front, first_lanes(surfaces.count - i));
    if (none(lit)) continue;
    const Appender append(lit, shadows.count);
    append(origin, shadows.origin);
    append(to_light.offset, shadows.direction);
    append(all(1), shadows.t_max);
    append(load(surfaces.id, i), shadows.leaves);
    append(counted_from(i), shadows.surface);
    append(hn::And(load(surfaces.material_inside, i), hn::Set(w, 1)), shadows.inside);
    shadows.count += append.count();
  }
}

// Light of the lanes on a plane that shows shadows alone, in place of local_light().
HWY_NOINLINE Lanes3 with_shadows_only(const WaveScene& scene, const WaveSurfaces& surfaces, std::int64_t first,
                                      const steps::LightReceived& received, const ColourRows& visibility,
                                      Lanes3 light) {
  alignas(64) double sent[3][kLanes];
  hn::Store(light.x, Tag(), sent[0]);
  hn::Store(light.y, Tag(), sent[1]);
  hn::Store(light.z, Tag(), sent[2]);
  const std::int64_t n = std::min<std::int64_t>(surfaces.count - first, kLanes);
  for (std::int64_t k = 0; k < n; ++k) {
    if (surfaces.id[first + k] != kPlane) continue;
    const Vec3d own = steps::light_of_shadows_only(scene, surfaces, first + k, received, visibility);
    for (int channel = 0; channel < 3; ++channel) sent[channel][k] = own[channel];
  }
  return {hn::Load(Tag(), sent[0]), hn::Load(Tag(), sent[1]), hn::Load(Tag(), sent[2])};
}

HWY_INLINE void add_to_owners(Lanes3 light, const WaveSurfaces& surfaces, std::int64_t i, WaveSums& sums) {
  // Neighbouring surfaces mostly have neighbouring owners.
  const std::int64_t first = surfaces.owner[i];
  const std::int64_t n = std::min<std::int64_t>(surfaces.count - i, kLanes);
  if (n == kLanes && hn::AllTrue(LongTag(), hn::Eq(load(surfaces.owner, i), counted_from(first)))) {
    const Lanes3 before = sums.empty ? all(Vec3d{}) : load(sums.light, first);
    store(add(before, light), sums.light, first);
    return;
  }
  alignas(64) double received[3][kLanes];
  hn::Store(light.x, Tag(), received[0]);
  hn::Store(light.y, Tag(), received[1]);
  hn::Store(light.z, Tag(), received[2]);
  for (int k = 0; k < n; ++k)
    for (int channel = 0; channel < 3; ++channel) {
      double& sum = sums.light[channel][surfaces.owner[i + k]];
      sum = (sums.empty ? 0 : sum) + received[channel][k];
    }
}

void add_local_light_on_target(const WaveScene& scene, const WaveSurfaces& surfaces,
                               const steps::LightReceived& received, const ColourRows& visibility, WaveSums& sums) {
  for (std::int64_t i = 0; i < surfaces.count; i += kLanes) {
    const LaneMask there = first_lanes(surfaces.count - i);
    SurfaceLanes surface;
    surface.origin = load(surfaces.origin, i);
    surface.incoming = load(surfaces.incoming, i);
    surface.normal = load(surfaces.normal, i);
    surface.cosine = hn::Neg(dot(surface.incoming, surface.normal));
    surface.id = load(surfaces.id, i);
    surface.material_inside = load(surfaces.material_inside, i);
    Lanes3 light =
        local_light(scene, there, surface, received, i, visibility ? load(visibility, i) : all(Vec3d{1, 1, 1}));
    if (HWY_UNLIKELY(scene.shadows_only)) light = with_shadows_only(scene, surfaces, i, received, visibility, light);
    const Lanes weight = load(surfaces.weight, i);
    Lanes3 weights{weight, weight, weight};
    if (HWY_UNLIKELY(surfaces.has_tints)) weights = multiply(weight, load(surfaces.tint, i));
    add_to_owners(multiply(weights, light), surfaces, i, sums);
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(find_shadow_rays_on_target);
HWY_EXPORT(add_local_light_on_target);

namespace steps {

void find_shadow_rays(const WaveSurfaces& surfaces, std::int64_t first, const PointLight& light, ShadowWave& shadows) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(find_shadow_rays_on_target)(surfaces, first, light, shadows);
}

void add_local_light(const WaveScene& scene, const WaveSurfaces& surfaces, const LightReceived& received,
                     const ColourRows& visibility, WaveSums& sums) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(add_local_light_on_target)(scene, surfaces, received, visibility, sums);
}

}  // namespace steps
}  // namespace bihive
#endif
