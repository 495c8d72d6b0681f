// View::normal, View::distance and View::id. Twins of normal_colour(), distance_colour() and id_colour() in
// render/views.h.
#include "film"
#include "surface"

uniform int view;  // 0 normal, 1 distance, 2 id
uniform float nearest;
uniform float farthest;

float distance_of(Ray ray, Hit hit) {
  return hit.t * length(ray.direction);
}

vec3 normal_colour(Ray ray, Hit hit) {
  return 0.5 * (shape_at(ray, hit).normal + vec3(1.0));
}

vec3 distance_colour(Ray ray, Hit hit) {
  float depth = farthest - nearest;
  return vec3(depth > 0.0 ? (farthest - distance_of(ray, hit)) / depth : 1.0);
}

// Arithmetic of 64 bits: x the upper half, y the lower.
uvec2 add64(uvec2 a, uvec2 b) {
  uint lower = a.y + b.y;
  return uvec2(a.x + b.x + (lower < a.y ? 1u : 0u), lower);
}

uvec2 multiply64(uvec2 a, uvec2 b) {
  // The whole product of the lower halves by parts of 16 bits.
  uint a0 = a.y & 0xFFFFu, a1 = a.y >> 16;
  uint b0 = b.y & 0xFFFFu, b1 = b.y >> 16;
  uint middle = a1 * b0 + (a0 * b0 >> 16);
  uint other_middle = a0 * b1 + (middle & 0xFFFFu);
  uint upper = a1 * b1 + (middle >> 16) + (other_middle >> 16);
  return uvec2(upper + a.x * b.y + a.y * b.x, a.y * b.y);
}

uvec2 xor_shifted64(uvec2 a, int shift) {  // a ^ a >> shift, 0 < shift < 32
  return a ^ uvec2(a.x >> shift, a.y >> shift | a.x << (32 - shift));
}

// splitmix64 of math/rng.h.
vec3 id_colour(uvec2 id) {
  uvec2 z = add64(id, uvec2(0x9E3779B9u, 0x7F4A7C15u));
  z = multiply64(xor_shifted64(z, 30), uvec2(0xBF58476Du, 0x1CE4E5B9u));
  z = multiply64(xor_shifted64(z, 27), uvec2(0x94D049BBu, 0x133111EBu));
  uint hash = xor_shifted64(z, 31).y;
  return (64.0 + 0.75 * vec3(uvec3(hash, hash >> 8, hash >> 16) & 0xFFu)) / 256.0;
}

void main() {
  Ray ray = sample_ray();
  Hit hit = scene_hit(ray);
  vec3 colour = vec3(0.0);
  if (hit.sphere != kNothing) {
    if (view == 0) colour = normal_colour(ray, hit);
    if (view == 1) colour = distance_colour(ray, hit);
    if (view == 2)
      colour = id_colour(hit.sphere == kPlane ? uvec2(0xFFFFFFFFu, 0xFFFFFFFEu) : uvec2(0u, sphere_id(hit.sphere)));
  }
  add_to_film(vec4(colour, 0.0));
}
