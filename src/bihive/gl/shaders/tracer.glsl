// Twin of render/tracer.h: traverses the tree if TREE is defined, else tests every sphere. share() is LightPaths' of
// render/transparency.h.
#include "hit"
#include "sphere"

#ifdef LAYERS
vec3 light_passed = vec3(1.0);  // transmittance along the last shadow ray
uint classes_crossed = 0u;      // by it
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

// Transmittance along a shadow ray: 0 behind an opaque sphere, else the product over the crossed spheres.
vec3 share(Ray ray) {
#ifdef LAYERS
  light_passed = vec3(1.0);
  classes_crossed = 0u;
  occluded(ray);
  return light_passed;
#else
  return vec3(occluded(ray) ? 0.0 : 1.0);
#endif
}
