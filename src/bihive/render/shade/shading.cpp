#include "bihive/render/shading.h"

#include <cmath>
#include <limits>

#include "bihive/geometry/plane.h"
#include "bihive/math/elementary.h"

namespace bihive {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A point of light as seen from a place.
struct LightOffset {
  Vec3d offset;
  double distance_squared, towards, nearness;

  LightOffset(Vec3d point, const Surface& surface)
      : offset(point - to_double(surface.origin)),
        distance_squared(dot(offset, offset)),
        towards(dot(surface.normal, offset)),
        nearness(1 / std::sqrt(distance_squared)) {}

  bool in_front() const { return distance_squared > 0 && distance_squared < kInfinity && towards > 0; }
  // N.L. Only the product is divided by the length of the offset.
  double facing() const { return towards * nearness; }
};

// What arrives at the place from the light, which lies at t = 1?
Vec3d arriving(const LightPaths& paths, const Surface& surface, Vec3d offset, std::int64_t& shadow_rays) {
  Ray shadow = ray_from(surface, offset, surface.from_inside);
  shadow.t_max = 1;
  ++shadow_rays;
  return paths.share(shadow);
}

double in_bands(double facing, int bands) {
  return std::floor(facing * bands + 0.5) / bands;
}

Vec3d in_bands(Vec3d facing, int bands) {
  return {in_bands(facing.x, bands), in_bands(facing.y, bands), in_bands(facing.z, bands)};
}

// The colour of a highlight in white light.
Vec3d tinted(const Material& material) {
  const double rest = 1 - material.tint;
  return Vec3d{rest, rest, rest} + material.tint * material.colour;
}

Vec3d mirrored(const Surface& surface) {
  return surface.incoming - (2 * dot(surface.incoming, surface.normal)) * surface.normal;
}

}  // namespace

Vec3d ambient_visibility(const Scene& scene, const LightPaths& paths, const Surface& surface,
                         const std::vector<Vec3f>& directions, double distance, std::int64_t& ambient_rays) {
  Vec3d seen;
  double in_front = 0;
  for (const Vec3f& direction : directions) {
    const double facing = dot(surface.normal, to_double(direction));
    if (!(facing > 0)) continue;
    in_front = in_front + facing;
    Ray ray = ray_from(surface, to_double(direction), surface.from_inside);
    ray.t_max = distance;
    ++ambient_rays;
    if (scene.plane && plane_hit(ray, local_plane(scene)) < kInfinity) continue;
    seen = seen + facing * paths.share(ray);
  }
  return in_front > 0 ? seen / in_front : Vec3d{1, 1, 1};
}

LightShare soft_light_share(const PointLight& light, const LightPaths& paths, const Surface& surface,
                            const std::vector<Vec3d>& points, std::int64_t& shadow_rays) {
  Vec3d facing;
  Vec3d seen;
  for (const Vec3d& point : points) {
    const LightOffset to_point(light.position + light.radius * point, surface);
    if (!to_point.in_front()) continue;
    const Vec3d share = arriving(paths, surface, to_point.offset, shadow_rays);
    facing = facing + to_point.facing() * share;
    seen = seen + share;
  }
  const auto count = static_cast<double>(points.size());
  return {facing / count, seen / count};
}

Vec3d local_light(const Scene& scene, const LightPaths& paths, const Surface& surface, bool shadows,
                  const std::vector<Vec3d>* light_points, Vec3d visibility, std::int64_t& shadow_rays) {
  const Material& material = surface.material;
  const double cosine = -dot(surface.incoming, surface.normal);
  Vec3d diffuse;
  Vec3d specular;
  for (const PointLight& of_world : scene.lights) {
    PointLight light = of_world;
    light.position = scene.spheres.to_local(light.position);
    // Leave out lights behind the surface, and lights of which nothing arrives.
    const LightOffset centre(light.position, surface);
    LightShare share{{}, {1, 1, 1}};
    if (shadows && light_points != nullptr && light.radius > 0) {
      share = soft_light_share(light, paths, surface, *light_points, shadow_rays);
      if (share.seen == Vec3d{}) continue;
    } else {
      if (!centre.in_front()) continue;
      if (shadows) share.seen = arriving(paths, surface, centre.offset, shadow_rays);
      if (share.seen == Vec3d{}) continue;
      share.facing = centre.facing() * share.seen;
    }
    if (material.bands > 0) share.facing = in_bands(share.facing, material.bands);
    diffuse = diffuse + (material.diffuse * share.facing) * light.colour;

    // R.V = 2 (N.L) (N.V) - L.V.
    if (!centre.in_front()) continue;
    const double highlight = 2 * centre.facing() * cosine + dot(centre.offset, surface.incoming) * centre.nearness;
    if (highlight > 0)
      specular = specular + (material.specular * share.seen * shading_power(highlight, material.power)) * light.colour;
  }
  const Vec3d strength = material.ambient * visibility;
  const Vec3d ambient = strength * scene.ambient_light;
  if (material.tint > 0) specular = specular * tinted(material);
  Vec3d light = ambient + diffuse;
  if (material.glow > 0) light = light + Vec3d{material.glow, material.glow, material.glow};
  return material.colour * light + specular;
}

Vec3d unshadowed_share(const Scene& scene, const std::vector<PointLight>& lights, const Surface& surface,
                       const Vec3d* seen, Vec3d visibility) {
  const Material& material = surface.material;
  Vec3d open = material.ambient * scene.ambient_light;
  Vec3d arriving = open * visibility;
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const LightOffset centre(lights[i].position, surface);
    if (!centre.in_front() || centre.towards < lights[i].radius) continue;
    const Vec3d unhidden = (material.diffuse * centre.facing()) * lights[i].colour;
    open = open + unhidden;
    arriving = arriving + unhidden * seen[i];
  }
  Vec3d share{1, 1, 1};
  for (int channel = 0; channel < 3; ++channel)
    if (arriving[channel] < open[channel]) share[channel] = arriving[channel] / open[channel];
  return share;
}

Vec3d light_of_shadows_only(const Scene& scene, const LightPaths& paths, const Surface& surface, bool shadows,
                            const std::vector<Vec3d>* light_points, Vec3d visibility, std::int64_t& shadow_rays) {
  const std::vector<PointLight> lights = local_lights(scene);
  std::vector<Vec3d> seen(lights.size(), Vec3d{1, 1, 1});
  for (std::size_t i = 0; shadows && i < lights.size(); ++i) {
    const LightOffset centre(lights[i].position, surface);
    if (light_points != nullptr && lights[i].radius > 0)
      seen[i] = soft_light_share(lights[i], paths, surface, *light_points, shadow_rays).seen;
    else if (centre.in_front())
      seen[i] = arriving(paths, surface, centre.offset, shadow_rays);
  }
  return scene.background * unshadowed_share(scene, lights, surface, seen.data(), visibility);
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
