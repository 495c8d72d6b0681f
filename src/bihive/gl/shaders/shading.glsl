// Twin of render/shading.h, by the plain formulas: it divides the offset to a light by its length, and builds R.
#include "elementary"
#include "surface"

uniform vec3 ambient_light;

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

float in_bands(float facing, float bands) {
  return floor(facing * bands + 0.5) / bands;
}

// The colour of a highlight in white light.
vec3 tinted(Material material) {
  return vec3(1.0 - material.tint) + material.tint * material.colour;
}

vec3 local_light(Surface surface, bool shadows, inout int shadow_rays) {
  vec3 diffuse = vec3(0.0);
  vec3 specular = vec3(0.0);
  for (int i = 0; i < light_count; ++i) {
    // Leave out lights behind the surface.
    vec3 offset = texelFetch(lights, texel(2 * i), 0).xyz - surface.origin;
    vec3 colour = texelFetch(lights, texel(2 * i + 1), 0).xyz;
    float distance = sqrt(dot(offset, offset));
    if (!(distance > 0.0)) continue;
    vec3 to_light = offset / distance;
    float facing = dot(surface.normal, to_light);
    if (!(facing > 0.0)) continue;

    // Leave out lights behind a sphere.
    if (shadows) {
      Ray shadow = ray_from(surface, to_light, surface.from_inside);
      shadow.t_max = distance;
      ++shadow_rays;
      if (occluded(shadow)) continue;
    }

    float share = surface.material.bands > 0.0 ? in_bands(facing, surface.material.bands) : facing;
    diffuse += (surface.material.diffuse * share) * colour;
    vec3 mirrored_light = (2.0 * facing) * surface.normal - to_light;
    float highlight = -dot(mirrored_light, surface.incoming);
    if (highlight > 0.0)
      specular += (surface.material.specular * portable_pow(highlight, surface.material.power)) * colour;
  }
  if (surface.material.tint > 0.0) specular *= tinted(surface.material);
  vec3 light = surface.material.ambient * ambient_light + diffuse + surface.material.glow;
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
