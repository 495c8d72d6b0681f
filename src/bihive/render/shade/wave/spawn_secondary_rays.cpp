#include "bihive/render/shade/wave/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/shade/wave/spawn_secondary_rays.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/render/shade/wave/materials-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// One ray from each surface.
struct SpawnedLanes {
  Lanes3 direction;
  Lanes weight;
  Longs inside;
};

HWY_INLINE SpawnedLanes choose(LaneMask mask, const SpawnedLanes& yes, const SpawnedLanes& no) {
  return {choose(mask, yes.direction, no.direction), hn::IfThenElse(mask, yes.weight, no.weight),
          hn::IfThenElse(longs_of(mask), yes.inside, no.inside)};
}

// transmitted_ray(), if the mirrored one is known.
HWY_INLINE SpawnedLanes transmitted(const MaterialLanes& material, Lanes3 incoming, Lanes3 normal, LaneMask on_plane,
                                    const SpawnedLanes& reflected) {
  const Longs one = hn::Set(LongTag(), 1);
  const LaneMask from_inside = lanes_of(hn::Eq(reflected.inside, one));
  const Lanes index = material.refraction_index;
  const Lanes ratio = hn::IfThenElse(from_inside, index, hn::Div(all(1), index));
  const Lanes cosine = hn::Neg(dot(incoming, normal));
  const Lanes beyond_squared =
      hn::Sub(all(1), hn::Mul(hn::Mul(ratio, ratio), hn::Sub(all(1), hn::Mul(cosine, cosine))));
  const Lanes along_normal = hn::Sub(hn::Mul(ratio, cosine), hn::Sqrt(beyond_squared));
  const Lanes3 refracted = add(multiply(ratio, incoming), multiply(along_normal, normal));

  // Total internal reflection stays inside; a plane is thin.
  const LaneMask total = hn::Lt(beyond_squared, all(0));
  SpawnedLanes spawned{choose(total, reflected.direction, refracted), reflected.weight,
                       hn::IfThenElse(longs_of(total), reflected.inside, hn::Sub(one, reflected.inside))};
  spawned.direction = choose(on_plane, incoming, spawned.direction);
  spawned.inside = hn::IfThenZeroElse(longs_of(on_plane), spawned.inside);
  return spawned;
}

// If a surface sends two rays, they must be neighbours.
HWY_INLINE void append_both(const WaveSurfaces& surfaces, std::int64_t i, LaneMask reflects,
                            const SpawnedLanes& reflected, LaneMask transmits, const SpawnedLanes& through,
                            Wave& next) {
  struct Sent {
    alignas(64) double direction[3][kLanes], weight[kLanes];
    alignas(64) std::int64_t inside[kLanes];
    std::uint8_t bits[8] = {};
  } sent[2];
  const auto keep = [](LaneMask mask, const SpawnedLanes& lanes, Sent& to) HWY_ATTR {
    hn::Store(lanes.direction.x, Tag(), to.direction[0]);
    hn::Store(lanes.direction.y, Tag(), to.direction[1]);
    hn::Store(lanes.direction.z, Tag(), to.direction[2]);
    hn::Store(lanes.weight, Tag(), to.weight);
    hn::Store(lanes.inside, LongTag(), to.inside);
    hn::StoreMaskBits(Tag(), mask, to.bits);
  };
  keep(reflects, reflected, sent[0]);
  keep(transmits, through, sent[1]);
  for (int k = 0; k < kLanes; ++k)
    for (const Sent& one : sent) {
      if ((one.bits[0] >> k & 1) == 0) continue;
      const std::int64_t at = next.count++;
      for (int axis = 0; axis < 3; ++axis) {
        next.origin[axis][at] = surfaces.origin[axis][i + k];
        next.direction[axis][at] = static_cast<float>(one.direction[axis][k]);
      }
      next.weight[at] = one.weight[k];
      for (int channel = 0; next.has_tints && channel < 3; ++channel)
        next.tint[channel][at] = surfaces.tint[channel][i + k];
      next.owner[at] = surfaces.owner[i + k];
      next.leaves[at] = surfaces.id[i + k];
      next.inside[at] = static_cast<std::uint8_t>(one.inside[k]);
    }
}

steps::SpawnedRays spawn_secondary_rays_on_target(const WaveScene& scene, const WaveSurfaces& surfaces,
                                                  std::int64_t first, Wave& next) {
  const LongTag w;
  steps::SpawnedRays spawned;
  for (std::int64_t i = first; i < surfaces.count; i += kLanes) {
    // A share of exactly 0 makes no ray, nor does a faint one.
    const LaneMask there = first_lanes(surfaces.count - i);
    const Longs id = load(surfaces.id, i);
    const Longs material_inside = load(surfaces.material_inside, i);
    const MaterialLanes material = materials_of(scene, there, material_inside, id);
    const Lanes weight = load(surfaces.weight, i);
    const Lanes reflected_weight = hn::Mul(weight, material.reflective);
    const Lanes transmitted_weight = hn::Mul(weight, material.transmissive);
    LaneMask reflects = hn::And(there, hn::Ne(material.reflective, all(0)));
    LaneMask transmits = hn::And(there, hn::Ne(material.transmissive, all(0)));
    if (scene.faintest_ray > 0) {
      reflects = hn::And(reflects, hn::Ge(reflected_weight, all(scene.faintest_ray)));
      transmits = hn::And(transmits, hn::Ge(transmitted_weight, all(scene.faintest_ray)));
    }
    const LaneMask sends = hn::Or(reflects, transmits);
    if (none(sends)) continue;

    const Lanes3 incoming = load(surfaces.incoming, i);
    const Lanes3 normal = load(surfaces.normal, i);
    const Longs inside = hn::And(material_inside, hn::Set(w, 1));
    const Lanes3 mirrored = subtract(incoming, multiply(hn::Mul(all(2), dot(incoming, normal)), normal));
    SpawnedLanes ray{mirrored, reflected_weight, inside};
    if (!none(transmits)) {
      const LaneMask on_plane = lanes_of(hn::Eq(id, hn::Set(w, kPlane)));
      SpawnedLanes through = transmitted(material, incoming, normal, on_plane, ray);
      through.weight = transmitted_weight;
      spawned.transmitted += static_cast<std::int64_t>(hn::CountTrue(Tag(), transmits));
      spawned.reflected += static_cast<std::int64_t>(hn::CountTrue(Tag(), reflects));
      if (!none(hn::And(reflects, transmits))) {
        append_both(surfaces, i, reflects, ray, transmits, through, next);
        continue;
      }
      ray = choose(transmits, through, ray);
    } else {
      spawned.reflected += static_cast<std::int64_t>(hn::CountTrue(Tag(), reflects));
    }

    const Appender append(sends, next.count);
    append(load(surfaces.origin, i), next.origin);
    append(ray.direction, next.direction);
    append(ray.weight, next.weight);
    if (HWY_UNLIKELY(next.has_tints)) append(load(surfaces.tint, i), next.tint);
    append(load(surfaces.owner, i), next.owner);
    append(id, next.leaves);
    append(ray.inside, next.inside);
    next.count += append.count();
  }
  return spawned;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(spawn_secondary_rays_on_target);

namespace steps {

SpawnedRays spawn_secondary_rays(const WaveScene& scene, const WaveSurfaces& surfaces, std::int64_t first, Wave& next) {
  ensure_target();
  return HWY_DYNAMIC_DISPATCH(spawn_secondary_rays_on_target)(scene, surfaces, first, next);
}

}  // namespace steps
}  // namespace bihive
#endif
