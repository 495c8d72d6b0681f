// surface_at() of render/surface.h for several rays at a time.

#if defined(BIHIVE_RENDER_SHADE_WAVE_SURFACES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef BIHIVE_RENDER_SHADE_WAVE_SURFACES_INL_H_
#undef BIHIVE_RENDER_SHADE_WAVE_SURFACES_INL_H_
#else
#define BIHIVE_RENDER_SHADE_WAVE_SURFACES_INL_H_
#endif

#include <hwy/highway.h>

#include <cstdint>
#include <limits>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/render/shade/wave/wave.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// Neighbouring rays of a wave, and their hits. A ray may be invalid.
struct RayLanes {
  Lanes3 origin, direction;
  Lanes t;
  Longs id;
};

/// The height of the plane above points, in lengths of its normal.
HWY_INLINE Lanes height_above(const Plane& plane, Lanes3 points) {
  return dot(all(plane.normal), subtract(all(plane.point), points));
}

/// The test of the plane in scene_hit(), for rays that do not leave the plane. The plane is `height` above the origins.
/// +inf, -inf and NaN are never nearer.
HWY_INLINE LaneMask hits_plane(const Plane& plane, Lanes height, const RayLanes& rays, Lanes& t) {
  t = hn::Div(height, dot(all(plane.normal), rays.direction));
  return hn::And(hn::Ge(t, all(0)), hn::Lt(t, rays.t));
}
HWY_INLINE void put_plane(LaneMask hit, Lanes t, RayLanes& rays) {
  rays.t = hn::IfThenElse(hit, t, rays.t);
  rays.id = hn::IfThenElse(longs_of(hit), hn::Set(LongTag(), kPlane), rays.id);
}

/// The same for any rays of a wave, from number i on; they may be invalid.
HWY_INLINE void hit_plane(const Plane& plane, const Wave& wave, std::int64_t i, RayLanes& rays) {
  Lanes t;
  LaneMask hit = hits_plane(plane, height_above(plane, rays.origin), rays, t);
  if (!wave.starts_at_eye) {
    // t may be 0 for a direction that is not finite.
    hit = hn::And(hit, hn::Lt(hn::Abs(dot(all(plane.normal), rays.direction)), all(kInfinity)));
    hit = hn::And(hit, lanes_of(hn::Ne(load(wave.leaves, i), hn::Set(LongTag(), kPlane))));
  }
  put_plane(hit, t, rays);
}

// The position of the plane's material by the checker's squares, counted from the plane's first material.
HWY_INLINE Longs checker_step(const WaveScene& scene, Lanes3 point) {
  const Checker& checker = *scene.scene->plane->checker;
  const Lanes size = all(checker.size);
  const Lanes squares = hn::Add(hn::Floor(hn::Div(dot(point, all(scene.axes.u)), size)),
                                hn::Floor(hn::Div(dot(point, all(scene.axes.v)), size)));
  const Lanes rest = hn::Sub(squares, hn::Mul(all(2), hn::Floor(hn::Mul(squares, all(0.5)))));
  const LaneMask odd = hn::Ne(rest, all(0));
  const LaneMask far = hn::Gt(dot(point, point), all(checker.fade_distance * checker.fade_distance));
  const LongTag w;
  return hn::IfThenElse(longs_of(far), hn::Set(w, 2), hn::IfThenElse(longs_of(odd), hn::Set(w, 1), hn::Set(w, 0)));
}

/// Surfaces in some lanes; the others hold anything.
struct SurfaceLanes {
  Lanes3 origin;  ///< numbers of binary32
  Lanes3 incoming, normal;
  Lanes cosine;  ///< -incoming . normal
  Longs id, material_inside;
};

// Replaces normals of spheres, outward ones, where `normal_of(k, id, normal)` has another one for lane k: those of caps
// and sticks. Few hits need it, so one after the other will do.
template <class NormalOf>
HWY_NOINLINE void replace_normals(LaneMask on_sphere, Longs ids, Lanes3& outward, const NormalOf& normal_of) {
  alignas(64) std::int64_t id[kLanes];
  alignas(64) double x[kLanes], y[kLanes], z[kLanes];
  hn::Store(ids, LongTag(), id);
  hn::Store(outward.x, Tag(), x);
  hn::Store(outward.y, Tag(), y);
  hn::Store(outward.z, Tag(), z);
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(Tag(), on_sphere, bits);
  for (unsigned left = bits[0]; left != 0; left &= left - 1) {
    const int k = __builtin_ctz(left);
    Vec3d normal;
    if (!normal_of(k, id[k], normal)) continue;
    x[k] = normal.x;
    y[k] = normal.y;
    z[k] = normal.z;
  }
  outward = {hn::Load(Tag(), x), hn::Load(Tag(), y), hn::Load(Tag(), z)};
}

inline void put_cap_normals(const CutSet& cuts, const Wave& wave, std::int64_t i, LaneMask on_sphere, Longs ids,
                            Lanes3& outward) {
  replace_normals(on_sphere, ids, outward, [&](int k, std::int64_t id, Vec3d& normal) {
    return cuts.is_cut(id) && cuts.cap_normal(wave.span().at(i + k), id, normal);
  });
}

inline void put_stick_normals(const Scene& scene, const Wave& wave, std::int64_t i, LaneMask on_sphere,
                              const RayLanes& rays, Lanes3& outward) {
  alignas(64) double t[kLanes];
  hn::Store(rays.t, Tag(), t);
  replace_normals(on_sphere, rays.id, outward, [&](int k, std::int64_t id, Vec3d& normal) {
    if (id < scene.spheres.total_size()) return false;
    normal = stick_normal(scene, wave.span().at(i + k), {t[k], id});
    return true;
  });
}

// Replaces the ids of sticks' halves by those of the spheres at their ends. True: there are some.
inline HWY_NOINLINE bool show_spheres_of_sticks(const Scene& scene, std::int64_t ids[kLanes]) {
  bool any = false;
  for (int k = 0; k < kLanes; ++k) {
    any = any || ids[k] >= scene.spheres.total_size();
    ids[k] = shown_sphere(scene, ids[k]);
  }
  return any;
}

// Local centres. Makes the ids those of the stored spheres.
inline HWY_NOINLINE Lanes3 centres_of_images(const SphereSet& spheres, std::int64_t ids[kLanes]) {
  alignas(64) double x[kLanes], y[kLanes], z[kLanes];
  for (int k = 0; k < kLanes; ++k) {
    const Vec3d centre = spheres.local_centre(ids[k]);
    x[k] = centre.x;
    y[k] = centre.y;
    z[k] = centre.z;
    ids[k] = spheres.stored_id(ids[k]);
  }
  return {hn::Load(Tag(), x), hn::Load(Tag(), y), hn::Load(Tag(), z)};
}

/// For lanes `found` of the rays, at least one: the rays that hit something. They are those of the wave from number i
/// on.
HWY_INLINE SurfaceLanes surfaces_at(const WaveScene& wave_scene, LaneMask found, const Wave& wave, std::int64_t i,
                                    const RayLanes& rays) {
  const LongTag w;
  const Scene& scene = *wave_scene.scene;
  SurfaceLanes surface;
  surface.id = rays.id;
  const Lanes3 along = multiply(rays.t, rays.direction);
  const Lanes3 point = add(rays.origin, along);
  surface.origin = rounded_to_float(point);
  surface.incoming = normalized_again(rays.direction);

  // Outward normals and materials of spheres and of the plane.
  const LaneMask on_plane = hn::And(found, lanes_of(hn::Eq(rays.id, hn::Set(w, kPlane))));
  const LaneMask on_sphere = hn::AndNot(on_plane, found);
  Lanes3 outward;
  Longs material = hn::Zero(w);
  if (!none(on_sphere)) {
    alignas(64) std::int64_t sphere[kLanes];
    hn::Store(hn::IfThenElseZero(longs_of(on_sphere), rays.id), w, sphere);
    const SphereSet& spheres = scene.spheres;
    const bool on_stick = HWY_UNLIKELY(wave_scene.has_sticks) && show_spheres_of_sticks(scene, sphere);
    Lanes3 centre;
    if (HWY_UNLIKELY(spheres.has_images())) {
      centre = centres_of_images(spheres, sphere);
    } else {
      const Lanes3 stored{gathered(spheres.x().data(), sphere), gathered(spheres.y().data(), sphere),
                          gathered(spheres.z().data(), sphere)};
      centre = multiply(all(wave_scene.inverse_scale), stored);
    }
    outward = normalized(add(subtract(rays.origin, centre), along));
    if (HWY_UNLIKELY(on_stick)) put_stick_normals(scene, wave, i, on_sphere, rays, outward);
    if (HWY_UNLIKELY(wave_scene.cuts != nullptr))
      put_cap_normals(*wave_scene.cuts, wave, i, on_sphere, rays.id, outward);
    if (!scene.material_of_sphere.empty()) material = gathered(scene.material_of_sphere.data(), sphere);
  }
  if (!none(on_plane)) {
    Longs of_plane = hn::Set(w, wave_scene.plane_material);
    if (scene.plane->checker) of_plane = hn::Add(of_plane, checker_step(wave_scene, point));
    if (none(on_sphere)) {
      outward = all(scene.plane->plane.normal);
      material = of_plane;
    } else {
      outward = choose(on_plane, all(scene.plane->plane.normal), outward);
      material = hn::IfThenElse(longs_of(on_plane), of_plane, material);
    }
  }

  // Turn the normals against the rays.
  const Lanes speed = dot(surface.incoming, outward);
  const LaneMask from_inside = hn::Gt(speed, all(0));
  surface.normal = negate(from_inside, outward);
  surface.cosine = hn::Abs(speed);
  const Longs inside = hn::IfThenElseZero(longs_of(hn::And(on_sphere, from_inside)), hn::Set(w, 1));
  surface.material_inside = hn::Add(hn::Add(material, material), inside);
  return surface;
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#endif  // BIHIVE_RENDER_SHADE_WAVE_SURFACES_INL_H_
