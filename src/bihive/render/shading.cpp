#include "bihive/render/shading.h"

#include <cmath>
#include <limits>

#include "bihive/geometry/plane.h"
#include "bihive/math/elementary.h"

namespace bihive {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A ray that starts on the surface. On a sphere, `inside` says whether it goes into the ball; a plane has no inside.
Ray ray_from(const Surface& surface, Vec3d direction, bool inside) {
  Ray ray;
  ray.origin = surface.origin;
  ray.direction = to_float(direction);
  ray.leaves = surface.id;
  ray.inside = surface.id != kPlane && inside;
  return ray;
}

Vec3d mirrored(const Surface& surface) {
  return surface.incoming - (2 * dot(surface.incoming, surface.normal)) * surface.normal;
}

}  // namespace

double ambient_visibility(const Scene& scene, const Tracer& tracer, const Surface& surface,
                          const std::vector<Vec3f>& directions, double distance, std::int64_t& ambient_rays) {
  double seen = 0;
  double in_front = 0;
  for (const Vec3f& direction : directions) {
    const double facing = dot(surface.normal, to_double(direction));
    if (!(facing > 0)) continue;
    in_front = in_front + facing;
    Ray ray = ray_from(surface, to_double(direction), surface.from_inside);
    ray.t_max = distance;
    ++ambient_rays;
    const bool hidden = tracer.occluded(ray) || (scene.plane && plane_hit(ray, scene.plane->plane) < kInfinity);
    if (!hidden) seen = seen + facing;
  }
  return in_front > 0 ? seen / in_front : 1;
}

Vec3d local_light(const Scene& scene, const Tracer& tracer, const Surface& surface, bool shadows, double visibility,
                  std::int64_t& shadow_rays) {
  const Material& material = surface.material;
  const double cosine = -dot(surface.incoming, surface.normal);
  Vec3d diffuse;
  Vec3d specular;
  for (const PointLight& light : scene.lights) {
    // Leave out lights behind the surface.
    const Vec3d offset = light.position - to_double(surface.origin);
    const double distance_squared = dot(offset, offset);
    const double towards = dot(surface.normal, offset);
    if (!(distance_squared > 0 && distance_squared < kInfinity && towards > 0)) continue;

    // Leave out lights behind a sphere: any hit up to the light, which lies at t = 1.
    if (shadows) {
      Ray shadow = ray_from(surface, offset, surface.from_inside);
      shadow.t_max = 1;
      ++shadow_rays;
      if (tracer.occluded(shadow)) continue;
    }

    // N.L, and R.V = 2 (N.L) (N.V) - L.V. Only the products are divided by the length of the offset.
    const double nearness = 1 / std::sqrt(distance_squared);
    const double facing = towards * nearness;
    diffuse = diffuse + (material.diffuse * facing) * light.colour;
    const double highlight = 2 * facing * cosine + dot(offset, surface.incoming) * nearness;
    if (highlight > 0)
      specular = specular + (material.specular * shading_power(highlight, material.power)) * light.colour;
  }
  const double strength = material.ambient * visibility;
  const Vec3d ambient{strength, strength, strength};
  return material.colour * (ambient + diffuse) + specular;
}

Ray reflected_ray(const Surface& surface) {
  return ray_from(surface, mirrored(surface), surface.from_inside);
}

Ray transmitted_ray(const Surface& surface) {
  if (surface.id == kPlane) return ray_from(surface, surface.incoming, false);
  const double index = surface.material.refraction_index;
  const double ratio = surface.from_inside ? index : 1 / index;
  const double cosine = -dot(surface.incoming, surface.normal);
  const double cosine_beyond_squared = 1 - ratio * ratio * (1 - cosine * cosine);
  if (cosine_beyond_squared < 0) return ray_from(surface, mirrored(surface), surface.from_inside);
  const double along_normal = ratio * cosine - std::sqrt(cosine_beyond_squared);
  return ray_from(surface, ratio * surface.incoming + along_normal * surface.normal, !surface.from_inside);
}

}  // namespace bihive
