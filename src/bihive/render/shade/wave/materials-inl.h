// material_of() of scene/scene.h for several surfaces at a time.

#if defined(BIHIVE_RENDER_SHADE_WAVE_MATERIALS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_RENDER_SHADE_WAVE_MATERIALS_INL_H_
#undef BIHIVE_RENDER_SHADE_WAVE_MATERIALS_INL_H_
#else
#define BIHIVE_RENDER_SHADE_WAVE_MATERIALS_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/render/shade/wave/wave.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

/// The answer of surfaces to light, and whether their secondary rays run inside a sphere.
struct MaterialLanes {
  Lanes3 colour;
  Lanes ambient, diffuse, reflective, specular, power, transmissive, refraction_index;
  Lanes opacity = hn::Set(Tag(), 1);  ///< the factor of the other lanes that a sphere's own opacity scales
};

/// The colours that sticks have of their own.
inline HWY_NOINLINE void colour_sticks(const Scene& scene, Longs id, Lanes3& colour) {
  const Tag d;
  alignas(64) std::int64_t ids[kLanes];
  alignas(64) double x[kLanes], y[kLanes], z[kLanes];
  hn::Store(id, LongTag(), ids);
  hn::Store(colour.x, d, x);
  hn::Store(colour.y, d, y);
  hn::Store(colour.z, d, z);
  for (int k = 0; k < kLanes; ++k) {
    const std::int64_t half = ids[k] - scene.spheres.total_size();
    const Vec3f* const own = half < 0 ? nullptr : scene.sticks.colour_at(half);
    if (own == nullptr) continue;
    x[k] = double(own->x);
    y[k] = double(own->y);
    z[k] = double(own->z);
  }
  colour = {hn::Load(d, x), hn::Load(d, y), hn::Load(d, z)};
}

/// Opacity and colour of single spheres, if the scene has any.
HWY_INLINE void apply_attributes(const WaveScene& scene, Longs id, MaterialLanes& lanes) {
  const SphereAttributes& attributes = scene.scene->spheres.attributes();
  const LaneMask on_sphere = lanes_of(hn::Gt(id, hn::Set(LongTag(), -1)));
  alignas(64) std::int64_t ids[kLanes];
  hn::Store(id, LongTag(), ids);
  alignas(64) double channel[3][kLanes] = {}, opacity_of[kLanes] = {};
  const bool has_opacity =
      !attributes.opacity.empty() || (HWY_UNLIKELY(scene.has_sticks) && scene.scene->sticks.has_opacities());
  for (int k = 0; k < kLanes; ++k) {
    if (ids[k] < 0) continue;
    double of_stick = 1;
    if (HWY_UNLIKELY(scene.has_sticks)) {
      const std::int64_t half = ids[k] - scene.scene->spheres.total_size();
      if (half >= 0) of_stick = scene.scene->sticks.opacity_at(half);
      ids[k] = shown_sphere(*scene.scene, ids[k]);
    }
    const auto i = static_cast<std::size_t>(scene.scene->spheres.stored_id(ids[k]));
    if (!attributes.colour.empty()) {
      const Vec3f colour = scene.image_colours.any() ? scene.image_colours.colour(ids[k]) : attributes.colour[i];
      channel[0][k] = double(colour.x);
      channel[1][k] = double(colour.y);
      channel[2][k] = double(colour.z);
    }
    if (has_opacity) opacity_of[k] = of_stick * (attributes.opacity.empty() ? 1 : double(attributes.opacity[i]));
  }
  if (!attributes.colour.empty()) {
    const Tag d;
    const Lanes3 colour{hn::Load(d, channel[0]), hn::Load(d, channel[1]), hn::Load(d, channel[2])};
    lanes.colour = choose(on_sphere, colour, lanes.colour);
  }
  if (HWY_UNLIKELY(scene.has_sticks) && scene.scene->sticks.has_colours())
    colour_sticks(*scene.scene, id, lanes.colour);
  if (!has_opacity) return;
  const Lanes opacity = hn::Load(Tag(), opacity_of);
  const LaneMask clear = hn::And(on_sphere, hn::Lt(opacity, all(1)));
  lanes.ambient = hn::IfThenElse(clear, hn::Mul(lanes.ambient, opacity), lanes.ambient);
  lanes.diffuse = hn::IfThenElse(clear, hn::Mul(lanes.diffuse, opacity), lanes.diffuse);
  lanes.specular = hn::IfThenElse(clear, hn::Mul(lanes.specular, opacity), lanes.specular);
  lanes.opacity = hn::IfThenElse(clear, opacity, lanes.opacity);
  const Lanes sent_on = scene.passes_apart ? all(0) : hn::Sub(all(1), opacity);
  lanes.transmissive = hn::IfThenElse(clear, sent_on, lanes.transmissive);
  lanes.refraction_index = hn::IfThenElse(clear, all(1), lanes.refraction_index);
}

HWY_INLINE MaterialLanes all(const Material& material) {
  return {all(material.colour),   all(material.ambient), all(material.diffuse),      all(material.reflective),
          all(material.specular), all(material.power),   all(material.transmissive), all(material.refraction_index)};
}
HWY_INLINE MaterialLanes choose(LaneMask mask, const MaterialLanes& yes, const MaterialLanes& no) {
  const auto chosen = [mask](Lanes a, Lanes b) HWY_ATTR { return hn::IfThenElse(mask, a, b); };
  return {choose(mask, yes.colour, no.colour),       chosen(yes.ambient, no.ambient),
          chosen(yes.diffuse, no.diffuse),           chosen(yes.reflective, no.reflective),
          chosen(yes.specular, no.specular),         chosen(yes.power, no.power),
          chosen(yes.transmissive, no.transmissive), chosen(yes.refraction_index, no.refraction_index)};
}

HWY_INLINE const Material& material_at(const WaveScene& scene, std::int64_t material_inside) {
  return scene.materials[static_cast<std::size_t>(material_inside >> 1)];
}

/// For the lanes `wanted`, at least one; the others hold anything. `material_inside` and `id` as in WaveSurfaces.
HWY_INLINE MaterialLanes materials_of(const WaveScene& scene, LaneMask wanted, Longs material_inside, Longs id) {
  // Neighbours mostly share a material, so load each material that occurs once. The compared numbers include the inside
  // bit.
  alignas(64) std::int64_t numbers[kLanes];
  const Longs which = hn::Or(material_inside, hn::Set(LongTag(), 1));
  hn::Store(which, LongTag(), numbers);
  std::int64_t number = numbers[hn::FindFirstTrue(Tag(), wanted)];
  MaterialLanes lanes = all(material_at(scene, number));
  LaneMask left = hn::AndNot(lanes_of(hn::Eq(which, hn::Set(LongTag(), number))), wanted);
  while (HWY_UNLIKELY(!none(left))) {
    number = numbers[hn::FindFirstTrue(Tag(), left)];
    const LaneMask same = hn::And(left, lanes_of(hn::Eq(which, hn::Set(LongTag(), number))));
    lanes = choose(same, all(material_at(scene, number)), lanes);
    left = hn::AndNot(same, left);
  }
  if (!scene.has_attributes) return lanes;
  apply_attributes(scene, hn::IfThenElse(longs_of(wanted), id, hn::Set(LongTag(), kNothing)), lanes);
  return lanes;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_RENDER_SHADE_WAVE_MATERIALS_INL_H_
