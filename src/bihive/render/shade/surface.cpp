#include "bihive/render/surface.h"

#include <cmath>

#include "bihive/geometry/cut_sphere.h"
#include "bihive/geometry/stick_set.h"
#include "bihive/scene/clips.h"

namespace bihive {
namespace {

// Parity in floor arithmetic: a conversion to an integer would overflow near the horizon.
bool is_odd(double whole) {
  return whole - 2 * std::floor(whole / 2) != 0;
}

Vec3d checker_colour(const ScenePlane& plane, const Checker& checker, Vec3d point) {
  const Vec3d first = plane.material.colour;
  if (dot(point, point) > checker.fade_distance * checker.fade_distance) return 0.5 * (first + checker.second_colour);
  const PlaneAxes axes = plane_axes(plane.plane.normal);
  const double squares = std::floor(dot(point, axes.u) / checker.size) + std::floor(dot(point, axes.v) / checker.size);
  return is_odd(squares) ? checker.second_colour : first;
}

}  // namespace

Vec3d stick_normal(const Scene& scene, const Ray& ray, const SceneHit& hit) {
  const std::int64_t stick = (hit.id - scene.spheres.total_size()) / 2;
  return stick_normal(ScaledRay(ray, scene.spheres.scale()), scene.sticks.stored(scene.spheres, stick), hit.t);
}

Surface surface_at(const Scene& scene, const Ray& ray, const SceneHit& hit) {
  const std::shared_ptr<const CutSet> cuts = scene.clips.empty() ? nullptr : cut_set_of(scene);
  return surface_at(scene, ray, hit, cuts.get());
}

Surface surface_at(const Scene& scene, const Ray& ray, const SceneHit& hit, const CutSet* cuts) {
  Surface surface;
  surface.id = hit.id;
  const Vec3d origin = to_double(ray.origin);
  const Vec3d along = hit.t * to_double(ray.direction);
  const Vec3d point = origin + along;
  surface.origin = to_float(point);

  // In binary64 no square of a number of binary32 can overflow or vanish.
  surface.incoming = normalized_again(to_double(ray.direction));
  Vec3d outward;
  if (hit.id == kPlane) {
    outward = scene.plane->plane.normal;
    surface.material = scene.plane->material;
    if (scene.plane->checker) surface.material.colour = checker_colour(*scene.plane, *scene.plane->checker, point);
  } else {
    if (cuts == nullptr || !cuts->cap_normal(ray, hit.id, outward))
      outward = hit.id >= scene.spheres.total_size()
                    ? stick_normal(scene, ray, hit)
                    : normalized((origin - scene.spheres.local_centre(hit.id)) + along);
    surface.material = shown_material(scene, hit.id);
  }
  surface.from_inside = dot(surface.incoming, outward) > 0;
  surface.normal = surface.from_inside ? -outward : outward;
  return surface;
}

}  // namespace bihive
