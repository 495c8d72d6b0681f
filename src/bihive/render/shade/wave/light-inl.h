// local_light() of render/shading.h for several surfaces at a time.

#if defined(BIHIVE_RENDER_SHADE_WAVE_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_RENDER_SHADE_WAVE_LIGHT_INL_H_
#undef BIHIVE_RENDER_SHADE_WAVE_LIGHT_INL_H_
#else
#define BIHIVE_RENDER_SHADE_WAVE_LIGHT_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/render/shade/wave/materials-inl.h"
#include "bihive/render/shade/wave/powers-inl.h"
#include "bihive/render/shade/wave/surfaces-inl.h"
#include "bihive/render/shade/wave/wave.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

/// The place of a light's point as seen from surfaces.
struct LightLanes {
  Lanes3 offset;
  Lanes distance_squared, towards;
  LaneMask in_front;

  HWY_INLINE LightLanes(Vec3d point, Lanes3 origin, Lanes3 normal)
      : offset(subtract(all(point), origin)),
        distance_squared(dot(offset, offset)),
        towards(dot(normal, offset)),
        in_front(hn::And(hn::And(hn::Gt(distance_squared, all(0)), hn::Lt(distance_squared, all(kInfinity))),
                         hn::Gt(towards, all(0)))) {}

  HWY_INLINE Lanes nearness() const { return hn::Div(all(1), hn::Sqrt(distance_squared)); }
};

// A highlight of exactly no strength adds nothing at any power, except powers that could overflow.
HWY_INLINE LaneMask has_highlight(const MaterialLanes& material) {
  return hn::Or(hn::Ne(material.specular, all(0)), hn::Gt(material.power, all(1e6)));
}

HWY_INLINE LaneMask set_lanes(const std::uint8_t* bytes) {
  alignas(64) std::int64_t words[kLanes];
  for (int k = 0; k < kLanes; ++k) words[k] = bytes[k];
  return lanes_of(hn::Ne(hn::Load(LongTag(), words), hn::Zero(LongTag())));
}

HWY_INLINE Lanes3 load(const ColourRows& rows, std::int64_t i) {
  return {hn::LoadU(Tag(), rows.of[0] + i), hn::LoadU(Tag(), rows.of[1] + i), hn::LoadU(Tag(), rows.of[2] + i)};
}

HWY_INLINE Lanes3 kept(LaneMask mask, Lanes3 v) {
  return {hn::IfThenElseZero(mask, v.x), hn::IfThenElseZero(mask, v.y), hn::IfThenElseZero(mask, v.z)};
}

HWY_INLINE LaneMask any_colour(Lanes3 v) {
  return hn::Or(hn::Or(hn::Ne(v.x, all(0)), hn::Ne(v.y, all(0))), hn::Ne(v.z, all(0)));
}

/// The effects of materials, if the scene has any.
struct EffectLanes {
  Lanes bands, tint, glow;

  /// None.
  HWY_INLINE EffectLanes() : bands(all(0)), tint(all(0)), glow(all(0)) {}

  HWY_INLINE EffectLanes(const WaveScene& scene, LaneMask there, Longs material_inside) {
    alignas(64) std::int64_t numbers[kLanes];
    hn::Store(hn::IfThenElseZero(longs_of(there), material_inside), LongTag(), numbers);
    alignas(64) double bands_of[kLanes], tint_of[kLanes], glow_of[kLanes];
    for (int k = 0; k < kLanes; ++k) {
      const Material& material = material_at(scene, numbers[k]);
      bands_of[k] = material.bands;
      tint_of[k] = material.tint;
      glow_of[k] = material.glow;
    }
    bands = hn::Load(Tag(), bands_of);
    tint = hn::Load(Tag(), tint_of);
    glow = hn::Load(Tag(), glow_of);
  }

  HWY_INLINE Lanes in_bands(Lanes facing) const {
    const Lanes stepped = hn::Div(hn::Floor(hn::Add(hn::Mul(facing, bands), all(0.5))), bands);
    return hn::IfThenElse(hn::Gt(bands, all(0)), stepped, facing);
  }
  HWY_INLINE Lanes3 in_bands(Lanes3 facing) const {
    return {in_bands(facing.x), in_bands(facing.y), in_bands(facing.z)};
  }
  HWY_INLINE Lanes3 with_glow(Lanes3 light) const {
    return choose(hn::Gt(glow, all(0)), add(light, Lanes3{glow, glow, glow}), light);
  }
  HWY_INLINE Lanes3 tinted(Lanes3 specular, Lanes3 colour) const {
    const Lanes rest = hn::Sub(all(1), tint);
    const Lanes3 of_highlight = add(Lanes3{rest, rest, rest}, multiply(tint, colour));
    return choose(hn::Gt(tint, all(0)), multiply(specular, of_highlight), specular);
  }
};

/// For the lanes `there`, at least one. `received`: of the surfaces from number `first` on. `visibility`: of
/// ambient_visibility().
HWY_INLINE Lanes3 local_light(const WaveScene& wave_scene, LaneMask there, const SurfaceLanes& surface,
                              const steps::LightReceived& received, std::int64_t first, Lanes3 visibility) {
  const MaterialLanes material = materials_of(wave_scene, there, surface.material_inside, surface.id);
  EffectLanes effects;
  if (HWY_UNLIKELY(wave_scene.has_effects)) {
    effects = EffectLanes(wave_scene, there, surface.material_inside);
    effects.glow = hn::Mul(effects.glow, material.opacity);
  }
  Lanes3 diffuse = all(Vec3d{});
  Lanes3 specular = all(Vec3d{});
  std::int64_t hidden_at = first;
  std::int64_t soft_at = first;
  for (const PointLight& light : wave_scene.lights) {
    const LightLanes to_light(light.position, surface.origin, surface.normal);
    const LaneMask in_front = hn::And(to_light.in_front, there);
    LaneMask lit = in_front;
    Lanes3 seen = all(Vec3d{1, 1, 1});
    Lanes3 soft_facing = all(Vec3d{});
    const bool soft = received.facing && light.radius > 0;
    // Leave out lights behind the surface or behind a sphere.
    if (soft) {
      soft_facing = load(received.facing, soft_at);
      seen = load(received.seen, soft_at);
      soft_at += received.surfaces;
      lit = hn::And(there, any_colour(seen));
    } else if (received.hidden != nullptr) {
      lit = hn::AndNot(set_lanes(received.hidden + hidden_at), lit);
      if (HWY_UNLIKELY(bool(received.share))) seen = load(received.share, hidden_at);
    }
    hidden_at += received.surfaces;
    if (none(lit)) continue;

    // Add nothing for lights that are left out.
    const Lanes3 colour = all(light.colour);
    const Lanes nearness = to_light.nearness();
    const Lanes facing = hn::IfThenElseZero(hn::And(lit, in_front), hn::Mul(to_light.towards, nearness));
    Lanes3 received_facing = soft ? kept(lit, soft_facing) : Lanes3{facing, facing, facing};
    if (HWY_UNLIKELY(bool(received.share)) && !soft) received_facing = multiply(facing, seen);
    if (HWY_UNLIKELY(wave_scene.has_effects)) received_facing = effects.in_bands(received_facing);
    diffuse = add(diffuse, multiply(multiply(material.diffuse, received_facing), colour));
    const Lanes highlight = hn::Add(hn::Mul(hn::Mul(all(2), facing), surface.cosine),
                                    hn::Mul(dot(to_light.offset, surface.incoming), nearness));
    const LaneMask glossy =
        hn::And(hn::And(hn::And(lit, in_front), hn::Gt(highlight, all(0))), has_highlight(material));
    if (none(glossy)) continue;
    const Lanes power = shading_power_of(glossy, highlight, material.power);
    const Lanes3 strength = multiply(power, multiply(material.specular, seen));
    specular = add(specular, multiply(kept(glossy, strength), colour));
  }
  if (HWY_UNLIKELY(wave_scene.has_effects)) specular = effects.tinted(specular, material.colour);
  const Lanes3 strength = multiply(material.ambient, visibility);
  Lanes3 light = add(multiply(strength, all(wave_scene.scene->ambient_light)), diffuse);
  if (HWY_UNLIKELY(wave_scene.has_effects)) light = effects.with_glow(light);
  return add(multiply(material.colour, light), specular);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_RENDER_SHADE_WAVE_LIGHT_INL_H_
