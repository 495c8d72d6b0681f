// material_of() of scene/scene.h for several surfaces at a time.

#if defined(BIHIVE_RENDER_WAVE_MATERIALS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_RENDER_WAVE_MATERIALS_INL_H_
#undef BIHIVE_RENDER_WAVE_MATERIALS_INL_H_
#else
#define BIHIVE_RENDER_WAVE_MATERIALS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cstdint>

#include "bihive/render/wave.h"
#include "bihive/render/wave_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

/// How surfaces answer light, and whether rays that they send on run inside a sphere.
struct MaterialLanes {
  Lanes3 colour;
  Lanes ambient, diffuse, reflective, specular, power, transmissive, refraction_index;
};

/// Opacity and colour of single spheres, where the scene has any.
HWY_INLINE void apply_attributes(const Scene& scene, Words id, MaterialLanes& lanes) {
  const SphereAttributes& attributes = scene.spheres.attributes();
  if (attributes.colour.empty() && attributes.opacity.empty()) return;
  const LaneMask on_sphere = lanes_of(hn::Gt(id, hn::Set(WordTag(), -1)));
  alignas(64) std::int64_t ids[kLanes];
  hn::Store(id, WordTag(), ids);
  alignas(64) double channel[3][kLanes] = {}, opacity_of[kLanes] = {};
  for (int k = 0; k < kLanes; ++k) {
    if (ids[k] < 0) continue;
    const auto i = static_cast<std::size_t>(ids[k]);
    if (!attributes.colour.empty()) {
      channel[0][k] = double(attributes.colour[i].x);
      channel[1][k] = double(attributes.colour[i].y);
      channel[2][k] = double(attributes.colour[i].z);
    }
    if (!attributes.opacity.empty()) opacity_of[k] = double(attributes.opacity[i]);
  }
  if (!attributes.colour.empty()) {
    const Tag d;
    const Lanes3 colour{hn::Load(d, channel[0]), hn::Load(d, channel[1]), hn::Load(d, channel[2])};
    lanes.colour = choose(on_sphere, colour, lanes.colour);
  }
  if (attributes.opacity.empty()) return;
  const Lanes opacity = hn::Load(Tag(), opacity_of);
  const LaneMask clear = hn::And(on_sphere, hn::Lt(opacity, all(1)));
  lanes.ambient = hn::IfThenElse(clear, hn::Mul(lanes.ambient, opacity), lanes.ambient);
  lanes.diffuse = hn::IfThenElse(clear, hn::Mul(lanes.diffuse, opacity), lanes.diffuse);
  lanes.specular = hn::IfThenElse(clear, hn::Mul(lanes.specular, opacity), lanes.specular);
  lanes.transmissive = hn::IfThenElse(clear, hn::Sub(all(1), opacity), lanes.transmissive);
  lanes.refraction_index = hn::IfThenElse(clear, all(1), lanes.refraction_index);
}

/// Of lanes `wanted`; the others hold anything. `material_inside` and `id` as in WaveSurfaces.
HWY_INLINE MaterialLanes materials_of(const WaveScene& scene, LaneMask wanted, Words material_inside, Words id) {
  // Neighbours mostly share a material: take each that occurs once.
  const Lanes zero = all(0);
  MaterialLanes lanes{{zero, zero, zero}, zero, zero, zero, zero, zero, zero, zero};
  alignas(64) std::int64_t numbers[kLanes];
  const Words which = hn::ShiftRight<1>(material_inside);
  hn::Store(which, WordTag(), numbers);
  for (LaneMask left = wanted; !none(left);) {
    const std::int64_t number = numbers[hn::FindFirstTrue(Tag(), left)];
    const Material& material = scene.materials[static_cast<std::size_t>(number)];
    const LaneMask same = hn::And(left, lanes_of(hn::Eq(which, hn::Set(WordTag(), number))));
    lanes.colour = choose(same, all(material.colour), lanes.colour);
    lanes.ambient = hn::IfThenElse(same, all(material.ambient), lanes.ambient);
    lanes.diffuse = hn::IfThenElse(same, all(material.diffuse), lanes.diffuse);
    lanes.specular = hn::IfThenElse(same, all(material.specular), lanes.specular);
    lanes.power = hn::IfThenElse(same, all(material.power), lanes.power);
    lanes.reflective = hn::IfThenElse(same, all(material.reflective), lanes.reflective);
    lanes.transmissive = hn::IfThenElse(same, all(material.transmissive), lanes.transmissive);
    lanes.refraction_index = hn::IfThenElse(same, all(material.refraction_index), lanes.refraction_index);
    left = hn::AndNot(same, left);
  }
  apply_attributes(*scene.scene, hn::IfThenElse(words_of(wanted), id, hn::Set(WordTag(), kNothing)), lanes);
  return lanes;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_RENDER_WAVE_MATERIALS_INL_H_
