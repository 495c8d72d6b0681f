// Twin of render/integrator.h, depth first: a transmitted ray waits while the reflected ray is followed, so at most one
// ray of each generation waits. PENDING_RAYS: at least recursion - 1.
#include "shading"

uniform int recursion;
uniform bool shadows;
uniform vec3 background;

struct Light {
  vec3 radiance;
  int deepest_hit;  // generation
  int other_rays;   // not the primary ray
};

Light radiance(Ray primary, bool lit) {
  vec3 pending_origin[PENDING_RAYS];
  vec3 pending_direction[PENDING_RAYS];
  float pending_weight[PENDING_RAYS];
  int pending_leaves[PENDING_RAYS];
  int pending_depth[PENDING_RAYS];  // negative: inside
  int pending_count = 0;

  Light light = Light(vec3(0.0), 0, 0);
  Ray ray = primary;
  float weight = 1.0;
  int depth = 1;
  for (;;) {
    bool goes_on = false;
    Hit hit = scene_hit(ray);
    if (hit.sphere == kNothing) {
      light.radiance += weight * background;
    } else {
      light.deepest_hit = max(light.deepest_hit, depth);
      Surface surface = surface_at(ray, hit);
      if (lit) light.radiance += weight * local_light(surface, shadows, light.other_rays);

      // Follow the reflected and the transmitted light; a share of exactly 0 makes no ray.
      if (depth < recursion) {
        float reflective = surface.material.reflective;
        float transmissive = surface.material.transmissive;
        goes_on = reflective != 0.0 || transmissive != 0.0;
        if (transmissive != 0.0) {
          ++light.other_rays;
          Ray transmitted = transmitted_ray(surface);
          if (reflective != 0.0) {
            pending_origin[pending_count] = transmitted.origin;
            pending_direction[pending_count] = transmitted.direction;
            pending_weight[pending_count] = weight * transmissive;
            pending_leaves[pending_count] = transmitted.leaves;
            pending_depth[pending_count] = transmitted.inside ? -(depth + 1) : depth + 1;
            ++pending_count;
          } else {
            ray = transmitted;
            weight *= transmissive;
          }
        }
        if (reflective != 0.0) {
          ++light.other_rays;
          ray = reflected_ray(surface);
          weight *= reflective;
        }
      }
    }

    // Continue with the child, or with the ray that began to wait last.
    if (goes_on) {
      ++depth;
      continue;
    }
    if (pending_count == 0) return light;
    --pending_count;
    ray = make_ray(pending_origin[pending_count], pending_direction[pending_count]);
    ray.leaves = pending_leaves[pending_count];
    ray.inside = pending_depth[pending_count] < 0;
    if (ray.leaves >= 0) ray.left = stored_sphere(ray.leaves);
    weight = pending_weight[pending_count];
    depth = abs(pending_depth[pending_count]);
  }
  return light;
}
