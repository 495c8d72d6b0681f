#include "bihive/render/query/wide_brute_force.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/geometry/hit.h"
#include "bihive/geometry/scaled_ray.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bihive/render/query/wide_brute_force.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "bihive/render/query/lanes-inl.h"
#include "bihive/simd/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace bihive {
namespace HWY_NAMESPACE {

// As many rays as a vector has lanes, in stored units. A lane without a ray has an empty segment.
struct BruteRays {
  alignas(64) double origin[3][kLanes], direction[3][kLanes], t_min[kLanes], t_max[kLanes];
  alignas(64) double left_centre[3][kLanes], left_radius[kLanes], outward[kLanes];
  bool leave = false;  // one of them leaves a sphere of the set

  BruteRays(const SphereSet& spheres, const RaySpan& rays, std::int64_t first, double scale) {
    for (int k = 0; k < kLanes; ++k) {
      const Ray ray = first + k < rays.count ? rays.at(first + k) : Ray{};
      put(k, is_valid(ray), ray, spheres, scale);
    }
  }

 private:
  void put(int lane, bool valid, const Ray& ray, const SphereSet& spheres, double scale) {
    const bool leaves = ray.leaves >= 0 && ray.leaves < spheres.size();
    const Vec3d from = to_double(ray.origin), along = to_double(ray.direction);
    const Vec3d left = leaves ? spheres.stored_centre(ray.leaves) : Vec3d{};
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis][lane] = valid ? from[axis] * scale : 0;
      direction[axis][lane] = valid ? along[axis] * scale : 1;
      left_centre[axis][lane] = left[axis];
    }
    t_min[lane] = valid ? ray.t_min : 1;
    t_max[lane] = valid ? ray.t_max : 0;
    left_radius[lane] = leaves ? spheres.stored_radius(ray.leaves) : -1;
    outward[lane] = ray.inside ? 0 : 1;
    leave = leave || leaves;
  }
};

HWY_INLINE Lanes3 load(const double (&columns)[3][kLanes]) {
  return {hn::Load(Tag(), columns[0]), hn::Load(Tag(), columns[1]), hn::Load(Tag(), columns[2])};
}

// sphere_hit() of geometry/sphere.h: the same operations in the same order, for each lane.
template <bool kLeave>
HWY_INLINE void test_all_on(const BruteRays& rays, const SphereSet& spheres, double* t, std::int64_t* id) {
  const Lanes3 origin = load(rays.origin), direction = load(rays.direction), left = load(rays.left_centre);
  const Lanes t_min = hn::Load(Tag(), rays.t_min), t_max = hn::Load(Tag(), rays.t_max);
  const Lanes left_radius = hn::Load(Tag(), rays.left_radius);
  const LaneMask outward = hn::Gt(hn::Load(Tag(), rays.outward), all(0));
  const Lanes direction_squared = dot(direction, direction);
  const auto inside = [&](Lanes root) { return hn::And(hn::Ge(root, t_min), hn::Le(root, t_max)); };

  Lanes best = all(std::numeric_limits<double>::infinity());
  Lanes best_id = all(double(kNothing));
  for (std::int64_t i = 0; i < spheres.size(); ++i) {
    const double r = spheres.stored_radius(i);
    const Lanes3 centre = all(spheres.stored_centre(i));

    // Find the point of the line that is closest to the centre, and the vector from it to the centre.
    const Lanes3 oc = subtract(centre, origin);
    const Lanes t_closest = hn::Div(dot(oc, direction), direction_squared);
    const Lanes3 perpendicular = subtract(oc, multiply(t_closest, direction));

    // Pythagoras gives half of the chord. Where no lane has one, there are no roots to look at.
    const Lanes discriminant = hn::Sub(all(r * r), dot(perpendicular, perpendicular));
    const LaneMask meets = hn::Ge(discriminant, all(0));
    if (none(meets) || !(r > 0)) continue;
    const Lanes half_chord = hn::Sqrt(hn::Div(discriminant, direction_squared));
    const Lanes t_near = hn::Sub(t_closest, half_chord), t_far = hn::Add(t_closest, half_chord);

    // Take the nearer root if it lies in the segment, else the farther one.
    LaneMask near_counts = inside(t_near), far_counts = inside(t_far);
    if constexpr (kLeave) {
      const LaneMask own = hn::And(hn::And(hn::Eq(all(r), left_radius), hn::Eq(centre.x, left.x)),
                                   hn::And(hn::Eq(centre.y, left.y), hn::Eq(centre.z, left.z)));
      near_counts = hn::AndNot(own, near_counts);
      far_counts = hn::AndNot(hn::And(own, outward), far_counts);
    }
    const Lanes found = hn::IfThenElse(near_counts, t_near, t_far);
    const LaneMask hit = hn::And(meets, hn::Or(near_counts, far_counts));

    // Of equal t the smaller id stays: ids come in their order.
    const LaneMask nearer = hn::And(hit, hn::Lt(found, best));
    best = hn::IfThenElse(nearer, found, best);
    best_id = hn::IfThenElse(nearer, all(static_cast<double>(i)), best_id);
  }

  alignas(64) double ids[kLanes];
  hn::Store(best_id, Tag(), ids);
  hn::Store(best, Tag(), t);
  for (int k = 0; k < kLanes; ++k) id[k] = static_cast<std::int64_t>(ids[k]);
}

void wide_brute_hits_on_target(const SphereSet& spheres, const RaySpan& rays, const HitSpan& hits) {
  const double scale = spheres.scale();
  for (std::int64_t i = 0; i < rays.count; i += kLanes) {
    const BruteRays some(spheres, rays, i, scale);
    alignas(64) double t[kLanes];
    std::int64_t id[kLanes];
    if (some.leave)
      test_all_on<true>(some, spheres, t, id);
    else
      test_all_on<false>(some, spheres, t, id);
    for (int k = 0; k < std::min<std::int64_t>(kLanes, rays.count - i); ++k) {
      hits.t[i + k] = t[k];
      hits.sphere_id[i + k] = id[k];
    }
  }
}

// NOLINTNEXTLINE(google-readability-namespace-comments)
}  // namespace HWY_NAMESPACE
}  // namespace bihive
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace bihive {
HWY_EXPORT(wide_brute_hits_on_target);

void wide_brute_hits(const SphereSet& spheres, const RaySpan& rays, const HitSpan& hits) {
  ensure_target();
  HWY_DYNAMIC_DISPATCH(wide_brute_hits_on_target)(spheres, rays, hits);
}

void wide_brute_occluded(const SphereSet& spheres, const RaySpan& rays, std::uint8_t* hidden) {
  constexpr std::int64_t kSome = 64;
  double t[kSome];
  std::int64_t id[kSome];
  for (std::int64_t i = 0; i < rays.count; i += kSome) {
    const std::int64_t count = std::min(kSome, rays.count - i);
    wide_brute_hits(spheres, rays.part(i, count), {t, id});
    for (std::int64_t k = 0; k < count; ++k) hidden[i + k] = id[k] != kNothing ? 1 : 0;
  }
}

}  // namespace bihive
#endif
