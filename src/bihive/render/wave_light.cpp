#include "bihive/render/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/wave_light.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/kernels/dispatch.h"
#include "bihive/render/wave_lanes-inl.h"
#include "bihive/render/wave_materials-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// Where a light is, seen from surfaces.
struct LightLanes {
  Lanes3 offset, direction;
  Lanes facing;
  LaneMask in_front;

  HWY_INLINE LightLanes(const PointLight& light, Lanes3 origin, Lanes3 normal)
      : offset(subtract(all(light.position), origin)) {
    const Lanes distance = length(offset);
    direction = divide(offset, distance);
    facing = dot(normal, direction);
    in_front = hn::And(hn::Gt(distance, all(0)), hn::Gt(facing, all(0)));
  }
};

void find_shadow_rays_on_target(const WaveSurfaces& surfaces, std::int64_t first, const PointLight& light,
                                ShadowWave& shadows) {
  const WordTag w;
  for (std::int64_t i = first; i < surfaces.count; i += kLanes) {
    const Lanes3 origin = load(surfaces.origin, i);
    const LightLanes to_light(light, origin, load(surfaces.normal, i));
    const LaneMask lit = hn::And(to_light.in_front, first_lanes(surfaces.count - i));
    if (none(lit)) continue;
    const Appender append(lit, shadows.count);
    append(origin, shadows.origin);
    append(to_light.offset, shadows.direction);
    append(all(1), shadows.t_max);
    append(load(surfaces.id, i), shadows.leaves);
    append(hn::Iota(w, i), shadows.surface);
    append(hn::And(load(surfaces.material_inside, i), hn::Set(w, 1)), shadows.inside);
    shadows.count += append.count();
  }
}

HWY_INLINE LaneMask set_lanes(const std::uint8_t* bytes) {
  alignas(64) std::int64_t words[kLanes];
  for (int k = 0; k < kLanes; ++k) words[k] = bytes[k];
  return lanes_of(hn::Ne(hn::Load(WordTag(), words), hn::Zero(WordTag())));
}

// A highlight of exactly no strength adds nothing, however sharp it is, up to powers that could overflow.
HWY_INLINE LaneMask has_highlight(const MaterialLanes& material) {
  return hn::Or(hn::Ne(material.specular, all(0)), hn::Gt(material.power, all(1e6)));
}

HWY_INLINE void add_to_owners(Lanes3 light, const WaveSurfaces& surfaces, std::int64_t i, WaveSums& sums) {
  // Mostly the owners are neighbours, too.
  const std::int64_t first = surfaces.owner[i];
  const std::int64_t n = std::min<std::int64_t>(surfaces.count - i, kLanes);
  if (n == kLanes && hn::AllTrue(WordTag(), hn::Eq(load(surfaces.owner, i), hn::Iota(WordTag(), first)))) {
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

void add_local_light_on_target(const WaveScene& wave_scene, const WaveSurfaces& surfaces, const std::uint8_t* hidden,
                               WaveSums& sums) {
  const std::vector<PointLight>& lights = wave_scene.scene->lights;
  for (std::int64_t i = 0; i < surfaces.count; i += kLanes) {
    const LaneMask there = first_lanes(surfaces.count - i);
    const MaterialLanes material =
        materials_of(wave_scene, there, load(surfaces.material_inside, i), load(surfaces.id, i));
    const Lanes3 origin = load(surfaces.origin, i);
    const Lanes3 normal = load(surfaces.normal, i);
    const Lanes3 to_viewer = negate(load(surfaces.incoming, i));
    Lanes3 diffuse = all(Vec3d{});
    Lanes3 specular = all(Vec3d{});
    for (std::size_t l = 0; l < lights.size(); ++l) {
      // Leave out lights behind the surface or behind a sphere.
      const LightLanes to_light(lights[l], origin, normal);
      LaneMask lit = hn::And(to_light.in_front, there);
      if (hidden != nullptr) lit = hn::AndNot(set_lanes(hidden + std::int64_t(l) * surfaces.count + i), lit);
      if (none(lit)) continue;

      const Lanes3 colour = all(lights[l].colour);
      diffuse = choose(lit, add(diffuse, multiply(hn::Mul(material.diffuse, to_light.facing), colour)), diffuse);
      const Lanes3 mirrored_light = subtract(multiply(hn::Mul(all(2), to_light.facing), normal), to_light.direction);
      const Lanes highlight = dot(mirrored_light, to_viewer);
      const LaneMask glossy = hn::And(hn::And(lit, hn::Gt(highlight, all(0))), has_highlight(material));
      if (none(glossy)) continue;
      const Lanes strength = hn::Mul(material.specular, pow_of(glossy, highlight, material.power));
      specular = choose(glossy, add(specular, multiply(strength, colour)), specular);
    }
    const Lanes3 ambient{material.ambient, material.ambient, material.ambient};
    const Lanes3 light = add(multiply(material.colour, add(ambient, diffuse)), specular);
    add_to_owners(multiply(load(surfaces.weight, i), light), surfaces, i, sums);
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

void add_local_light(const WaveScene& scene, const WaveSurfaces& surfaces, const std::uint8_t* hidden, WaveSums& sums) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(add_local_light_on_target)(scene, surfaces, hidden, sums);
}

}  // namespace steps
}  // namespace bihive
#endif
