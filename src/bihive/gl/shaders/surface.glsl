// Twin of render/surface.h.
#include "pairs"
#include "scene_hit"

uniform bool has_checker;
uniform vec3 plane_u;
uniform vec3 plane_v;
uniform vec3 second_colour;
uniform float checker_size;
uniform float fade_distance;

struct Material {
  vec3 colour;
  float ambient;
  float diffuse;
  float reflective;
  float specular;
  float power;
  float transmissive;
  float refraction_index;
  float tint;
  float glow;
  float bands;
};

struct Surface {
  int sphere;        // or kPlane
  vec4 stored;       // the sphere
  vec3 origin;       // origin of the next rays
  vec3 incoming;     // length 1
  vec3 normal;       // length 1, turned against the ray
  bool from_inside;  // the ray comes from inside the sphere
  Material material;
};

Material material_of(int look) {
  vec4 a = texelFetch(looks, texel(4 * look), 0);
  vec4 b = texelFetch(looks, texel(4 * look + 1), 0);
  vec4 c = texelFetch(looks, texel(4 * look + 2), 0);
  vec4 d = texelFetch(looks, texel(4 * look + 3), 0);
  return Material(a.xyz, a.w, b.x, b.y, b.z, b.w, c.x, c.y, c.z, c.w, d.x);
}

// The number of whole squares along an axis of the plane. Close to an edge the ray itself decides: the edges of a
// checker may pass through the centres of many pixels, and the rounding of the hit point would change their colours.
float squares_along(vec3 axis, Ray ray, vec3 point) {
  float squares = dot(point, axis) / checker_size;
  float edge = floor(squares + 0.5);
  if (abs(squares - edge) > 1.0e-5 * max(1.0, abs(edge))) return floor(squares);
  float height = plane_offset - dot(plane_normal, ray.origin);
  float speed = dot(plane_normal, ray.direction);
  float beyond = sum_of_products(dot(ray.origin, axis) - edge * checker_size, speed, height, dot(ray.direction, axis));
  return (beyond < 0.0) == (speed > 0.0) && beyond != 0.0 ? edge - 1.0 : edge;
}

vec3 checker_colour(vec3 first, Ray ray, vec3 point) {
  if (dot(point, point) > fade_distance * fade_distance) return 0.5 * (first + second_colour);
  float squares = squares_along(plane_u, ray, point) + squares_along(plane_v, ray, point);
  return squares - 2.0 * floor(squares / 2.0) != 0.0 ? second_colour : first;
}

// The geometry alone; the material is not set.
Surface shape_at(Ray ray, Hit hit) {
  Surface surface;
  surface.sphere = hit.sphere;
  surface.stored = vec4(0.0);
  surface.incoming = normalized(ray.direction);
  if (hit.sphere == kPlane) {
    // Not origin + t direction: the quotients of symmetric directions are exact, so the edges of a checker through many
    // pixels' centres stay exact. Then move the point onto the plane.
    float height = plane_offset - dot(plane_normal, ray.origin);
    vec3 point = ray.origin + height * (ray.direction / dot(plane_normal, ray.direction));
    surface.origin = point - (dot(plane_normal, point) - plane_offset) * plane_normal;
    surface.from_inside = dot(surface.incoming, plane_normal) > 0.0;
    surface.normal = surface.from_inside ? -plane_normal : plane_normal;
    return surface;
  }
  // From the centre to the hit along perpendicular and half chord. The error is then relative to the radius; the error
  // of origin + t direction is not.
  surface.stored = stored_sphere(hit.sphere);
  SphereRoots roots = sphere_roots(ray, surface.stored);
  surface.from_inside = hit.t > roots.t_closest;
  float along = surface.from_inside ? roots.half_chord : -roots.half_chord;
  vec3 outward = normalized(along * ray.direction - roots.perpendicular);
  surface.origin = surface.stored.xyz + surface.stored.w * outward;
  surface.normal = surface.from_inside ? -outward : outward;
  return surface;
}

Surface surface_at(Ray ray, Hit hit) {
  Surface surface = shape_at(ray, hit);
  bool plane = hit.sphere == kPlane;
  surface.material = material_of(plane ? 0 : int(texelFetch(sphere_info, texel(hit.sphere), 0).y));
  if (plane && has_checker) surface.material.colour = checker_colour(surface.material.colour, ray, surface.origin);
  return surface;
}
