// Twin of geometry/ray.h and geometry/scaled_ray.h.
#include "common"

// Points origin + t direction with 0 <= t <= t_max. `leaves`: position in leaf order of the sphere on which the ray
// starts, kPlane or kNothing. `left`: centre and radius of that sphere, -1 for none; the ray also exits spheres that
// coincide with it. With LAYERS the ray has advanced to t_passed, through sphere id_passed: later hits follow in the
// order of t, then of id, and not of the classes in classes_passed.
struct Ray {
  vec3 origin;
  vec3 direction;
  float over_direction_squared;  // 1 / direction . direction
  float t_max;
  int leaves;
  bool inside;
  vec4 left;
#ifdef LAYERS
  float t_passed;
  int id_passed;
  uint classes_passed;  // class_bit() of spheres
#endif
};

Ray make_ray(vec3 origin, vec3 direction) {
  Ray ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.over_direction_squared = 1.0 / dot(direction, direction);
  ray.t_max = kNever;
  ray.leaves = kNothing;
  ray.inside = false;
  ray.left = vec4(0.0, 0.0, 0.0, -1.0);
#ifdef LAYERS
  ray.t_passed = 0.0;
  ray.id_passed = -1;
  ray.classes_passed = 0u;
#endif
  return ray;
}
