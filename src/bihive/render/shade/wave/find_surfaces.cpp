#include <algorithm>

#include "bihive/render/shade/wave/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/shade/wave/find_surfaces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/render/shade/wave/surfaces-inl.h"
#include "bihive/scene/clips.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

void hit_plane_on_target(const WaveScene& scene, const WavePart& part, double* t, std::int64_t* id) {
  const Wave& wave = *part.wave;
  for (std::int64_t k = 0; k < part.count(); k += kLanes) {
    const std::int64_t i = part.first + k;
    RayLanes rays{load(wave.origin, i), load(wave.direction, i), hn::LoadU(Tag(), t + k), hn::LoadU(LongTag(), id + k)};
    hit_plane(scene.plane, wave, i, rays);
    hn::StoreU(rays.t, Tag(), t + k);
    hn::StoreU(rays.id, LongTag(), id + k);
  }
}

HWY_INLINE void add_background(Vec3d background, const Wave& wave, std::int64_t i, LaneMask missed, WaveSums& sums) {
  if (wave.starts_at_eye) {
    for (int channel = 0; channel < 3; ++channel) {
      const Lanes sum = sums.empty ? all(0) : load(sums.light[channel], i);
      hn::BlendedStore(hn::Add(sum, all(background[channel])), missed, Tag(), sums.light[channel].data() + i);
    }
    return;
  }
  alignas(64) double weight[kLanes];
  hn::Store(load(wave.weight, i), Tag(), weight);
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Tag(), missed, bits);
  for (unsigned left = bits[0]; left != 0; left &= left - 1) {
    const int k = __builtin_ctz(left);
    const std::int64_t owner = wave.owner[i + k];
    for (int channel = 0; channel < 3; ++channel) {
      const double share = wave.has_tints ? weight[k] * wave.tint[channel][i + k] : weight[k];
      sums.light[channel][owner] = sums.light[channel][owner] + share * background[channel];
    }
  }
}

void find_surfaces_on_target(const WaveScene& wave_scene, const WavePart& part, const double* t, const std::int64_t* id,
                             WaveSurfaces& surfaces, WaveSums& sums) {
  const LongTag w;
  const Scene& scene = *wave_scene.scene;
  const Wave& wave = *part.wave;
  for (std::int64_t k = 0; k < part.count(); k += kLanes) {
    const std::int64_t i = part.first + k;
    const LaneMask there = first_lanes(part.count() - k);
    RayLanes rays{load(wave.origin, i), load(wave.direction, i), hn::LoadU(Tag(), t + k), hn::LoadU(w, id + k)};
    if (scene.plane) hit_plane(wave_scene.plane, wave, i, rays);

    // Separate the rays that miss everything from the others.
    const LaneMask found = hn::And(there, lanes_of(hn::Ne(rays.id, hn::Set(w, kNothing))));
    const LaneMask missed = hn::AndNot(found, there);
    if (!none(missed)) add_background(scene.background, wave, i, missed, sums);
    if (none(found)) continue;

    const SurfaceLanes surface = surfaces_at(wave_scene, found, wave, i, rays);
    const Appender append(found, surfaces.count);
    append(surface.origin, surfaces.origin);
    append(surface.incoming, surfaces.incoming);
    append(surface.normal, surfaces.normal);
    append(wave.starts_at_eye ? all(1) : load(wave.weight, i), surfaces.weight);
    if (HWY_UNLIKELY(surfaces.has_tints)) append(load(wave.tint, i), surfaces.tint);
    append(wave.starts_at_eye ? counted_from(i) : load(wave.owner, i), surfaces.owner);
    append(surface.id, surfaces.id);
    append(surface.material_inside, surfaces.material_inside);
    surfaces.count += append.count();
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(hit_plane_on_target);
HWY_EXPORT(find_surfaces_on_target);

WaveScene::WaveScene(const Scene& drawn, OpacityRule rule)
    : scene(&drawn),
      inverse_scale(drawn.spheres.inverse_scale()),
      materials(drawn.materials),
      passes_apart(rule == OpacityRule::once),
      faintest_ray(passes_apart ? kFaintestRay : 0),
      lights(local_lights(drawn)),
      cuts(cut_set_of(drawn)),
      image_colours(drawn) {
  for (Material& material : materials)
    if (passes_apart && is_passed_straight(material)) material.transmissive = 0;
  const SphereAttributes& attributes = drawn.spheres.attributes();
  has_effects = bihive::has_effects(drawn);
  has_sticks = !drawn.sticks.empty();
  const auto spawns = [](const Material& material) { return material.reflective > 0 || material.transmissive > 0; };
  spawns_rays =
      std::any_of(materials.begin(), materials.end(), spawns) || (drawn.plane && spawns(drawn.plane->material));
  has_attributes = !attributes.colour.empty() || !attributes.opacity.empty() || drawn.sticks.has_colours() ||
                   drawn.sticks.has_opacities();
  if (!drawn.plane) return;
  plane = local_plane(drawn);
  shadows_only = drawn.plane->shadows_only;
  plane_material = static_cast<std::int64_t>(materials.size());
  Material material = drawn.plane->material;
  if (shadows_only) material.reflective = material.transmissive = 0;
  materials.push_back(material);
  if (!drawn.plane->checker) return;
  const Vec3d first = material.colour;
  material.colour = drawn.plane->checker->second_colour;
  materials.push_back(material);
  material.colour = 0.5 * (first + drawn.plane->checker->second_colour);
  materials.push_back(material);
  axes = plane_axes(drawn.plane->plane.normal);
}

namespace steps {

void hit_plane(const WaveScene& scene, const WavePart& rays, double* t, std::int64_t* id) {
  ensure_target();
  if (scene.scene->plane) HWY_DYNAMIC_DISPATCH(hit_plane_on_target)(scene, rays, t, id);
}

void find_surfaces(const WaveScene& scene, const WavePart& rays, const double* t, const std::int64_t* id,
                   WaveSurfaces& surfaces, WaveSums& sums) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(find_surfaces_on_target)(scene, rays, t, id, surfaces, sums);
}

}  // namespace steps
}  // namespace bihive
#endif
