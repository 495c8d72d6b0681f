// Twin of render/brute_force.h: every sphere, one after the other, in the order of ids.
#include "hit"
#include "sphere"

Hit test_all_spheres(Ray ray, bool any_hit) {
  Hit best = Hit(kNever, kNothing);
  for (int i = 0; i < sphere_count; ++i) {
    float t = sphere_hit(ray, stored_sphere(i));
    if (t < best.t) best = Hit(t, i);
    if (any_hit && best.sphere != kNothing) return best;
  }
  return best;
}
