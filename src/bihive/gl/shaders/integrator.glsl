// Twin of render/shade/integrator.h, depth first: while a reflected ray is followed, the transmitted ray waits, or with LAYERS
// the ray itself that goes on behind a transparent sphere. So at most one ray of each generation waits. PENDING_RAYS: at
// least recursion - 1.
#include "shading"

uniform int recursion;
uniform bool shadows;
uniform vec3 background;
uniform float faintest_ray;      // a weaker one is not traced
uniform bool without_background;  // leave it out straight behind whatever the primary ray meets

const int kPrimary = 1;  // generation

struct Light {
  vec3 radiance;
  int deepest_hit;  // generation
  int other_rays;   // not the primary ray
  // For the primary ray: its t behind all layers, and the share of light that they transmit.
  float t;
  float passing;
};

Light radiance(Ray primary, bool lit) {
  vec3 pending_origin[PENDING_RAYS];
  vec3 pending_direction[PENDING_RAYS];
  float pending_weight[PENDING_RAYS];
  vec3 pending_tint[PENDING_RAYS];
  int pending_leaves[PENDING_RAYS];
  int pending_depth[PENDING_RAYS];  // negative: inside
#ifdef LAYERS
  float pending_t_passed[PENDING_RAYS];
  int pending_id_passed[PENDING_RAYS];
  uint pending_classes_passed[PENDING_RAYS];
#endif
  int pending_count = 0;

  Light light = Light(vec3(0.0), 0, 0, kNever, 1.0);
  Ray ray = primary;
  float weight = 1.0;
  vec3 tint = vec3(1.0);  // of everything between the ray and the eye
  int depth = kPrimary;
  for (;;) {
    bool goes_on = false;
    Hit hit = scene_hit(ray);
#ifdef LAYERS
    float through = hit.sphere >= 0 ? passing(hit.sphere).x : 0.0;
#else
    const float through = 0.0;
#endif
    if (depth == kPrimary && through == 0.0) {
      light.t = hit.t;
      light.passing = weight;
    }
    if (hit.sphere == kNothing) {
      if (first_slice && !(without_background && depth == kPrimary)) light.radiance += weight * tint * background;
    } else {
      light.deepest_hit = max(light.deepest_hit, depth);
      Surface surface = surface_at(ray, hit);
      if (lit && !(through > 0.0 && weight < faintest_ray)) {
        int level = faintest_ray > 0.0 ? faint_level(weight * (1.0 - through)) : 0;
        vec3 visibility = ambient_visibility(surface, level, light.other_rays);
        light.radiance += weight * tint * local_light(surface, shadows, level, visibility, light.other_rays);
      }

      // Follow the reflected light, and the transmitted light or the ray itself; a share of exactly 0 makes no ray, nor
      // does a faint one.
      bool deeper = depth < recursion;
      float reflected = weight * surface.material.reflective;
      float transmitted = weight * (through > 0.0 ? through : surface.material.transmissive);
      bool reflects = deeper && reflected != 0.0 && reflected >= faintest_ray;
      bool transmits = through > 0.0 || (deeper && transmitted != 0.0 && transmitted >= faintest_ray);
      Ray mirror = ray;
      vec3 tint_beyond = tint;
      if (reflects) {
        if (first_slice) ++light.other_rays;
        mirror = reflected_ray(surface);
      }
      goes_on = reflects || transmits;
      if (transmits) {
#ifdef LAYERS
        if (through > 0.0) {
          uint its_class = class_bit(hit.sphere);
          if (its_class == 0u) tint_beyond *= passing_tint(hit.sphere, through);
          ray.classes_passed |= its_class;
          ray.t_passed = hit.t;
          ray.id_passed = int(sphere_id(hit.sphere));
        }
#endif
        int its_depth = depth;
        if (through == 0.0) {
          if (first_slice) ++light.other_rays;
          ++its_depth;
          ray = transmitted_ray(surface);
        }
        if (reflects) {
          pending_origin[pending_count] = ray.origin;
          pending_direction[pending_count] = ray.direction;
          pending_weight[pending_count] = transmitted;
          pending_tint[pending_count] = tint_beyond;
          pending_leaves[pending_count] = ray.leaves;
          pending_depth[pending_count] = ray.inside ? -its_depth : its_depth;
#ifdef LAYERS
          pending_t_passed[pending_count] = ray.t_passed;
          pending_id_passed[pending_count] = ray.id_passed;
          pending_classes_passed[pending_count] = ray.classes_passed;
#endif
          ++pending_count;
        } else {
          depth = its_depth;
          weight = transmitted;
          tint = tint_beyond;
        }
      }
      if (reflects) {
        ray = mirror;
        weight = reflected;
        ++depth;
      }
    }

    // Continue with that ray, or with the ray that began to wait last.
    if (goes_on) continue;
    if (pending_count == 0) return light;
    --pending_count;
    ray = make_ray(pending_origin[pending_count], pending_direction[pending_count]);
    ray.leaves = pending_leaves[pending_count];
    ray.inside = pending_depth[pending_count] < 0;
    if (ray.leaves >= 0) ray.left = stored_sphere(ray.leaves);
#ifdef LAYERS
    ray.t_passed = pending_t_passed[pending_count];
    ray.id_passed = pending_id_passed[pending_count];
    ray.classes_passed = pending_classes_passed[pending_count];
#endif
    weight = pending_weight[pending_count];
    tint = pending_tint[pending_count];
    depth = abs(pending_depth[pending_count]);
  }
  return light;
}
