// Twin of render/query/brute_force.h: every sphere, one after the other, in the order of ids.
#include "hit"
#include "sphere"

Hit test_all_spheres(Ray ray, bool any_hit) {
  Hit best = Hit(kNever, kNothing);
  for (int i = 0; i < sphere_count; ++i) {
    float t = sphere_hit(ray, stored_sphere(i));
#ifdef LAYERS
    if (any_hit) {
      if (t < kNever) light_passed *= arriving_behind(i, classes_crossed);
      if (light_passed == vec3(0.0)) return best;
      continue;
    }
#endif
    if (is_nearer(ray, t, i, best)) best = Hit(t, i);
    if (any_hit && best.sphere != kNothing) return best;
  }
  return best;
}
