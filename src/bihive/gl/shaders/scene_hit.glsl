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

// `sphere` may be kPlane too. If the ray meets an opaque sphere and the plane at the same t, it hits the sphere.
Hit scene_hit(Ray ray) {
  Hit hit = closest_hit(ray);
  float t = plane_hit(ray);
#ifdef LAYERS
  if (t == hit.t && is_layer(hit.sphere)) hit = Hit(t, kPlane);
#endif
  if (t < hit.t) hit = Hit(t, kPlane);
  return hit;
}

// The first hit behind all layers.
Hit closest_opaque(Ray ray) {
  Hit hit = scene_hit(ray);
#ifdef LAYERS
  while (is_layer(hit.sphere)) {
    ray.t_passed = hit.t;
    ray.id_passed = int(sphere_id(hit.sphere));
    ray.classes_passed |= class_bit(hit.sphere);
    hit = scene_hit(ray);
  }
#endif
  return hit;
}
