// Twins of geometry/plane.h and render/scene_hit.h.
#include "tracer"

uniform bool has_plane;
uniform vec3 plane_normal;
uniform float plane_offset;  // normal . point

float plane_hit(Ray ray) {
  if (!has_plane || ray.leaves == kPlane) return kNever;
  float speed = dot(plane_normal, ray.direction);
  if (speed == 0.0) return kNever;
  float t = (plane_offset - dot(plane_normal, ray.origin)) / speed;
  return t >= 0.0 && t <= ray.t_max ? t : kNever;
}

// `sphere` may be kPlane too. If the ray meets a sphere and the plane at the same t, it hits the sphere.
Hit scene_hit(Ray ray) {
  Hit hit = closest_hit(ray);
  float t = plane_hit(ray);
  if (t < hit.t) hit = Hit(t, kPlane);
  return hit;
}
