// Twin of render/tracer.h: walks the tree if TREE is defined, else tests every sphere. share() is LightPaths' of
// render/transparency.h.
#include "hit"
#include "sphere"

#ifdef LAYERS
vec3 light_passed = vec3(1.0);  // of the last ray that asked for light
#endif

#ifdef TREE
#include "traversal"

Hit closest_hit(Ray ray) {
  return traverse(ray, false);
}

bool occluded(Ray ray) {
  return traverse(ray, true).sphere != kNothing;
}
#else
#include "brute_force"

Hit closest_hit(Ray ray) {
  return test_all_spheres(ray, false);
}

bool occluded(Ray ray) {
  return test_all_spheres(ray, true).sphere != kNothing;
}
#endif

// What arrives at the ray's end: 0 behind an opaque sphere, else the product of what the crossed spheres let through.
vec3 share(Ray ray) {
#ifdef LAYERS
  light_passed = vec3(1.0);
  occluded(ray);
  return light_passed;
#else
  return vec3(occluded(ray) ? 0.0 : 1.0);
#endif
}
