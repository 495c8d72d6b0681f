// Twin of render/shading.h, by the plain formulas: it divides the offset to a light by its length, and builds R. A
// sample's light may come in slices (gl/light_slices.h), whose sum it is: each samples some directions and some lights.
#include "elementary"
#include "faint_level"
#include "surface"

uniform vec3 ambient_light;
#ifdef AMBIENT_OCCLUSION
uniform sampler2D directions;  // of all sets, one after the other (gl/sample_textures.h)
uniform int direction_set;     // of the sample
uniform int direction_sets;
uniform int direction_count;
uniform int direction_begin;   // of the slice, among direction_count
uniform int direction_end;
uniform float ambient_distance;
#endif
uniform sampler2D light_points;
uniform int light_point_set;
uniform int light_point_sets;
uniform int light_point_count;  // 0: no soft shadows
uniform int light_begin;        // of the slice
uniform int light_end;
uniform int light_point_begin;
uniform int light_point_end;
uniform bool first_slice;  // includes everything else

// A ray that starts on the surface.
Ray ray_from(Surface surface, vec3 direction, bool inside) {
  Ray ray = make_ray(surface.origin, direction);
  ray.leaves = surface.sphere;
  if (surface.sphere != kPlane) {
    ray.inside = inside;
    ray.left = surface.stored;
  }
  return ray;
}

vec3 mirrored(Surface surface) {
  return surface.incoming - (2.0 * dot(surface.incoming, surface.normal)) * surface.normal;
}

vec3 in_bands(vec3 facing, float bands) {
  return floor(facing * bands + 0.5) / bands;
}

// The colour of a highlight in white light.
vec3 tinted(Material material) {
  return vec3(1.0 - material.tint) + material.tint * material.colour;
}

// The visible share within the slice. Without AMBIENT_OCCLUSION everything is visible.
vec3 ambient_visibility(Surface surface, int level, inout int ambient_rays) {
#ifdef AMBIENT_OCCLUSION
  if (direction_begin == direction_end) return vec3(0.0);
  int count = used_at_level(direction_count, level, kFewestDirections);
  int first = first_at_level(direction_count, direction_sets, direction_set, level, kFewestDirections);
  int end = direction_end * count / direction_count;
  vec3 seen = vec3(0.0);
  for (int k = direction_begin * count / direction_count; k < end; ++k) {
    vec3 direction = texelFetch(directions, texel(first + k), 0).xyz;
    float facing = dot(surface.normal, direction);
    if (!(facing > 0.0)) continue;
    Ray ray = ray_from(surface, direction, surface.from_inside);
    ray.t_max = ambient_distance;
    ++ambient_rays;
    if (plane_hit(ray) < kNever) continue;
    seen += facing * share(ray);
  }
  // All directions in front, eight at a time: some drivers count loops (gl/light_slices.h).
  float in_front = 0.0;
  for (int k = 0; k < count; k += 8)
    for (int i = 0; i < 8; ++i) {
      vec3 direction = texelFetch(directions, texel(first + min(k + i, count - 1)), 0).xyz;
      if (k + i < count) in_front += max(dot(surface.normal, direction), 0.0);
    }
  if (in_front > 0.0) return seen / in_front;
#endif
  return vec3(first_slice ? 1.0 : 0.0);
}

// A point light as seen from a shading point.
struct LightOffset {
  vec3 to_light;
  float distance;
  float facing;
  bool in_front;
};

LightOffset light_offset(vec3 point, Surface surface) {
  vec3 offset = point - surface.origin;
  float distance = sqrt(dot(offset, offset));
  vec3 to_light = offset / distance;
  float facing = dot(surface.normal, to_light);
  return LightOffset(to_light, distance, facing, distance > 0.0 && facing > 0.0);
}

vec3 local_light(Surface surface, bool shadows, int level, vec3 visibility, inout int shadow_rays) {
  int soft_points = used_at_level(light_point_count, level, kFewestLightPoints);
  int first_point = first_at_level(light_point_count, light_point_sets, light_point_set, level, kFewestLightPoints);
  vec3 diffuse = vec3(0.0);
  vec3 specular = vec3(0.0);
  for (int i = light_begin; i < light_end; ++i) {
    vec4 light = texelFetch(lights, texel(2 * i), 0);
    vec3 colour = texelFetch(lights, texel(2 * i + 1), 0).xyz;
    LightOffset centre = light_offset(light.xyz, surface);

    // The light that arrives: traces shadow rays to its centre, or to each of its points.
    bool soft = shadows && light.w > 0.0 && light_point_count > 0;
    int points = soft ? soft_points : 1;
    vec3 facing = vec3(0.0);
    vec3 seen = vec3(0.0);
    int begin = soft ? light_point_begin * points / light_point_count : min(light_point_begin, 1);
    int end = soft ? light_point_end * points / light_point_count : 1;
    for (int k = begin; k < end; ++k) {
      LightOffset to_point = centre;
      if (soft) {
        vec3 point = texelFetch(light_points, texel(first_point + k), 0).xyz;
        to_point = light_offset(light.xyz + light.w * point, surface);
      }
      if (!to_point.in_front) continue;
      vec3 arriving = vec3(1.0);
      if (shadows) {
        Ray shadow = ray_from(surface, to_point.to_light, surface.from_inside);
        shadow.t_max = to_point.distance;
        ++shadow_rays;
        arriving = share(shadow);
      }
      facing += to_point.facing * arriving;
      seen += arriving;
    }
    if (seen == vec3(0.0)) continue;
    facing /= float(points);
    seen /= float(points);
    if (surface.material.bands > 0.0) facing = in_bands(facing, surface.material.bands);
    diffuse += (surface.material.diffuse * facing) * colour;

    if (!centre.in_front) continue;
    vec3 mirrored_light = (2.0 * centre.facing) * surface.normal - centre.to_light;
    float highlight = -dot(mirrored_light, surface.incoming);
    if (highlight > 0.0)
      specular += (surface.material.specular * seen * portable_pow(highlight, surface.material.power)) * colour;
  }
  if (surface.material.tint > 0.0) specular *= tinted(surface.material);
  vec3 light = (surface.material.ambient * visibility) * ambient_light + diffuse;
  if (first_slice) light += surface.material.glow;
  return surface.material.colour * light + specular;
}

Ray reflected_ray(Surface surface) {
  return ray_from(surface, mirrored(surface), surface.from_inside);
}

Ray transmitted_ray(Surface surface) {
  if (surface.sphere == kPlane) return ray_from(surface, surface.incoming, false);
  float index = surface.material.refraction_index;
  float ratio = surface.from_inside ? index : 1.0 / index;
  float cosine = -dot(surface.incoming, surface.normal);
  float cosine_beyond_squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
  if (cosine_beyond_squared < 0.0) return ray_from(surface, mirrored(surface), surface.from_inside);
  float along_normal = ratio * cosine - sqrt(cosine_beyond_squared);
  return ray_from(surface, ratio * surface.incoming + along_normal * surface.normal, !surface.from_inside);
}
