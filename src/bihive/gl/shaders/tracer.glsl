// Twin of render/tracer.h: walks the tree if TREE is defined, else tests every sphere.
#include "hit"
#include "sphere"

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
