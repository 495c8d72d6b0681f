// Twin of geometry/sphere.h: the perpendicular form, which stays accurate in binary32 for small spheres far away.
#include "ray"

// The point of the line that is closest to the centre, the vector from it to the centre, and half of the chord.
struct SphereRoots {
  bool met;
  float t_closest;
  float half_chord;
  vec3 perpendicular;
};

SphereRoots sphere_roots(Ray ray, vec4 sphere) {
  vec3 oc = sphere.xyz - ray.origin;
  float t_closest = dot(oc, ray.direction) * ray.over_direction_squared;
  vec3 perpendicular = oc - t_closest * ray.direction;
  float discriminant = sphere.w * sphere.w - dot(perpendicular, perpendicular);
  bool met = discriminant >= 0.0 && sphere.w > 0.0;
  return SphereRoots(met, t_closest, met ? sqrt(discriminant * ray.over_direction_squared) : 0.0, perpendicular);
}

// The t at which the ray hits the sphere, kNever if it does not.
float sphere_hit(Ray ray, vec4 sphere) {
  bool own = sphere == ray.left;
  if (own && !ray.inside) return kNever;
  SphereRoots roots = sphere_roots(ray, sphere);
  if (!roots.met) return kNever;
  float t_near = roots.t_closest - roots.half_chord;
  float t_far = roots.t_closest + roots.half_chord;
  if (!own && t_near >= 0.0 && t_near <= ray.t_max) return t_near;
  if (t_far >= 0.0 && t_far <= ray.t_max) return t_far;
  return kNever;
}
