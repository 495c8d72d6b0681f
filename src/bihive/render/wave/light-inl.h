// local_light() of render/shading.h for several surfaces at a time.

#if defined(BIHIVE_RENDER_WAVE_LIGHT_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_RENDER_WAVE_LIGHT_INL_H_
#undef BIHIVE_RENDER_WAVE_LIGHT_INL_H_
#else
#define BIHIVE_RENDER_WAVE_LIGHT_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "bihive/render/wave/lanes-inl.h"
#include "bihive/render/wave/materials-inl.h"
#include "bihive/render/wave/powers-inl.h"
#include "bihive/render/wave/surfaces-inl.h"
#include "bihive/render/wave/wave.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

/// The place of a light as seen from surfaces.
struct LightLanes {
  Lanes3 offset;
  Lanes distance_squared, towards;
  LaneMask in_front;

  HWY_INLINE LightLanes(const PointLight& light, Lanes3 origin, Lanes3 normal)
      : offset(subtract(all(light.position), origin)),
        distance_squared(dot(offset, offset)),
        towards(dot(normal, offset)),
        in_front(hn::And(hn::And(hn::Gt(distance_squared, all(0)), hn::Lt(distance_squared, all(kInfinity))),
                         hn::Gt(towards, all(0)))) {}
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

/// For the lanes `there`, at least one. `hidden`: null, or one byte for each light and surface, 1 if the light is
/// hidden; the bytes of the next light are `to_next_light` bytes further. `visibility`: of ambient_visibility().
HWY_INLINE Lanes3 local_light(const WaveScene& wave_scene, LaneMask there, const SurfaceLanes& surface,
                              const std::uint8_t* hidden, std::int64_t to_next_light, Lanes visibility) {
  const MaterialLanes material = materials_of(wave_scene, there, surface.material_inside, surface.id);
  Lanes3 diffuse = all(Vec3d{});
  Lanes3 specular = all(Vec3d{});
  for (const PointLight& light : wave_scene.scene->lights) {
    // Leave out lights behind the surface or behind a sphere.
    const LightLanes to_light(light, surface.origin, surface.normal);
    LaneMask lit = hn::And(to_light.in_front, there);
    if (hidden != nullptr) {
      lit = hn::AndNot(set_lanes(hidden), lit);
      hidden += to_next_light;
    }
    if (none(lit)) continue;

    // Add nothing for lights that are left out.
    const Lanes3 colour = all(light.colour);
    const Lanes nearness = hn::Div(all(1), hn::Sqrt(to_light.distance_squared));
    const Lanes facing = hn::IfThenElseZero(lit, hn::Mul(to_light.towards, nearness));
    diffuse = add(diffuse, multiply(hn::Mul(material.diffuse, facing), colour));
    const Lanes highlight = hn::Add(hn::Mul(hn::Mul(all(2), facing), surface.cosine),
                                    hn::Mul(dot(to_light.offset, surface.incoming), nearness));
    const LaneMask glossy = hn::And(hn::And(lit, hn::Gt(highlight, all(0))), has_highlight(material));
    if (none(glossy)) continue;
    const Lanes strength = hn::Mul(material.specular, shading_power_of(glossy, highlight, material.power));
    specular = add(specular, multiply(hn::IfThenElseZero(glossy, strength), colour));
  }
  const Lanes strength = hn::Mul(material.ambient, visibility);
  const Lanes3 ambient{strength, strength, strength};
  return add(multiply(material.colour, add(ambient, diffuse)), specular);
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_RENDER_WAVE_LIGHT_INL_H_
