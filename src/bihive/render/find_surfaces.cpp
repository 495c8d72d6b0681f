#include "bihive/render/wave.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/find_surfaces.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/kernels/dispatch.h"
#include "bihive/render/wave_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// plane_hit() of rays that may be invalid: whether the plane is hit in front of `t`, and where.
HWY_INLINE LaneMask hits_plane(const Plane& plane, const WavePart& rays, std::int64_t i, Lanes t, Lanes& plane_t) {
  const Lanes3 origin = load(rays.wave->origin, i);
  const Lanes3 direction = load(rays.wave->direction, i);
  const Lanes3 normal = all(plane.normal);
  const Lanes speed = dot(normal, direction);
  plane_t = hn::Div(dot(normal, subtract(all(plane.point), origin)), speed);
  LaneMask hit = hn::And(hn::And(hn::Ge(plane_t, all(0)), hn::Lt(plane_t, t)), hn::Ne(speed, all(0)));

  // is_valid(): times 0 everything finite is 0.
  const Lanes3 zero = all(Vec3d{});
  const Lanes zeros = hn::Add(dot(origin, zero), dot(direction, zero));
  hit = hn::And(hit, hn::Eq(zeros, all(0)));
  if (!rays.wave->starts_at_eye)
    hit = hn::And(hit, lanes_of(hn::Ne(load(rays.wave->leaves, i), hn::Set(WordTag(), kPlane))));
  return hit;
}

void hit_plane_on_target(const WaveScene& scene, const WavePart& rays, double* t, std::int64_t* id) {
  const Plane& plane = scene.scene->plane->plane;
  for (std::int64_t i = 0; i < rays.count(); i += kLanes) {
    const Lanes sphere_t = hn::LoadU(Tag(), t + i);
    Lanes plane_t;
    const LaneMask hit = hits_plane(plane, rays, rays.first + i, sphere_t, plane_t);
    if (none(hit)) continue;
    const Words sphere = hn::LoadU(WordTag(), id + i);
    hn::StoreU(hn::IfThenElse(hit, plane_t, sphere_t), Tag(), t + i);
    hn::StoreU(hn::IfThenElse(words_of(hit), hn::Set(WordTag(), kPlane), sphere), WordTag(), id + i);
  }
}

// The plane's material by the checker's squares: its position after the plane's first.
HWY_INLINE Words checker_step(const WaveScene& scene, Lanes3 point) {
  const Checker& checker = *scene.scene->plane->checker;
  const Lanes size = all(checker.size);
  const Lanes squares = hn::Add(hn::Floor(hn::Div(dot(point, all(scene.axes.u)), size)),
                                hn::Floor(hn::Div(dot(point, all(scene.axes.v)), size)));
  const Lanes rest = hn::Sub(squares, hn::Mul(all(2), hn::Floor(hn::Mul(squares, all(0.5)))));
  const LaneMask odd = hn::Ne(rest, all(0));
  const LaneMask far = hn::Gt(dot(point, point), all(checker.fade_distance * checker.fade_distance));
  const WordTag w;
  return hn::IfThenElse(words_of(far), hn::Set(w, 2), hn::IfThenElse(words_of(odd), hn::Set(w, 1), hn::Set(w, 0)));
}

// What the spheres of some lanes are like, one after the other. Lanes without a sphere get something finite.
struct SphereLanes {
  alignas(64) float centre[3][kLanes];
  alignas(64) std::int64_t material[kLanes];

  HWY_INLINE void gather(const Scene& scene, Words id) {
    alignas(64) std::int64_t ids[kLanes];
    hn::Store(id, WordTag(), ids);
    const std::int32_t* of_sphere = scene.material_of_sphere.empty() ? nullptr : scene.material_of_sphere.data();
    for (int k = 0; k < kLanes; ++k) {
      const auto i = static_cast<std::size_t>(std::max<std::int64_t>(ids[k], 0));
      centre[0][k] = scene.spheres.x()[i];
      centre[1][k] = scene.spheres.y()[i];
      centre[2][k] = scene.spheres.z()[i];
      material[k] = of_sphere != nullptr ? of_sphere[i] : 0;
    }
  }
};

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
    for (int channel = 0; channel < 3; ++channel)
      sums.light[channel][owner] = sums.light[channel][owner] + weight[k] * background[channel];
  }
}

void find_surfaces_on_target(const WaveScene& wave_scene, const WavePart& rays, const double* t_of,
                             const std::int64_t* id_of, WaveSurfaces& surfaces, WaveSums& sums) {
  const WordTag w;
  const Scene& scene = *wave_scene.scene;
  const Wave& wave = *rays.wave;
  const Lanes scale = all(wave_scene.scale);
  for (std::int64_t k = 0; k < rays.count(); k += kLanes) {
    // Part those that miss everything from the others.
    const std::int64_t i = rays.first + k;
    const LaneMask there = first_lanes(rays.count() - k);
    const Words id = hn::IfThenElse(words_of(there), hn::LoadU(w, id_of + k), hn::Set(w, kNothing));
    const LaneMask found = lanes_of(hn::Ne(id, hn::Set(w, kNothing)));
    const LaneMask missed = hn::AndNot(found, there);
    if (!none(missed)) add_background(scene.background, wave, i, missed, sums);
    if (none(found)) continue;

    const Lanes t = hn::LoadU(Tag(), t_of + k);
    const Lanes3 origin = load(wave.origin, i);
    const Lanes3 direction = load(wave.direction, i);
    const Lanes3 point = add(origin, multiply(t, direction));
    const Lanes3 scaled = multiply(scale, direction);
    const Lanes3 incoming = normalized(scaled);

    // Outward normals and materials of spheres and of the plane.
    const LaneMask on_plane = hn::And(found, lanes_of(hn::Eq(id, hn::Set(w, kPlane))));
    Lanes3 outward = all(Vec3d{});
    Words material = hn::Zero(w);
    if (!every(hn::Or(on_plane, hn::Not(found)))) {
      SphereLanes spheres;
      spheres.gather(scene, id);
      const FloatHalf f;
      const Lanes3 centre{hn::PromoteTo(Tag(), hn::Load(f, spheres.centre[0])),
                          hn::PromoteTo(Tag(), hn::Load(f, spheres.centre[1])),
                          hn::PromoteTo(Tag(), hn::Load(f, spheres.centre[2]))};
      outward = normalized(add(subtract(multiply(scale, origin), centre), multiply(t, scaled)));
      material = hn::Load(w, spheres.material);
    }
    if (!none(on_plane)) {
      Words of_plane = hn::Set(w, wave_scene.plane_material);
      if (scene.plane->checker) of_plane = hn::Add(of_plane, checker_step(wave_scene, point));
      outward = choose(on_plane, all(scene.plane->plane.normal), outward);
      material = hn::IfThenElse(words_of(on_plane), of_plane, material);
    }

    // Turn the normals against the rays, and keep the surfaces.
    const LaneMask from_inside = hn::Gt(dot(incoming, outward), all(0));
    const Lanes3 normal = choose(from_inside, negate(outward), outward);
    const Words inside = hn::IfThenElseZero(words_of(hn::AndNot(on_plane, from_inside)), hn::Set(w, 1));
    const Appender append(found, surfaces.count);
    append(point, surfaces.origin);
    append(incoming, surfaces.incoming);
    append(normal, surfaces.normal);
    append(wave.starts_at_eye ? all(1) : load(wave.weight, i), surfaces.weight);
    append(wave.starts_at_eye ? hn::Iota(w, i) : load(wave.owner, i), surfaces.owner);
    append(id, surfaces.id);
    append(hn::Add(hn::Add(material, material), inside), surfaces.material_inside);
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

WaveScene::WaveScene(const Scene& drawn) : scene(&drawn), scale(drawn.spheres.scale()), materials(drawn.materials) {
  if (!drawn.plane) return;
  plane_material = static_cast<std::int64_t>(materials.size());
  Material material = drawn.plane->material;
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
