// Twin of geometry/ray.h and geometry/scaled_ray.h.
#include "common"

// Points origin + t direction with 0 <= t <= t_max. `leaves`: position in leaf order of the sphere on which the ray
// starts, kPlane or kNothing. `left`: centre and radius of that sphere, -1 for none; the ray also leaves spheres that
// coincide with it.
struct Ray {
  vec3 origin;
  vec3 direction;
  float over_direction_squared;  // 1 / direction . direction
  float t_max;
  int leaves;
  bool inside;
  vec4 left;
};

Ray make_ray(vec3 origin, vec3 direction) {
  return Ray(origin, direction, 1.0 / dot(direction, direction), kNever, kNothing, false, vec4(0.0, 0.0, 0.0, -1.0));
}
