// Twin of scene/camera.h's PixelRays.
#include "pairs"
#include "ray"

uniform bool has_parallel_rays;
uniform vec3 eye;
uniform vec3 eye_lower;
uniform vec3 forward;
uniform vec3 forward_lower;
uniform vec3 right;
uniform vec3 right_lower;
uniform vec3 down;
uniform vec3 down_lower;
uniform vec2 half_size;
uniform vec3 view_forward;  // as `forward`, without the tilt for a point of the lens

// The depth of a point of the ray along the view.
float depth_of(Ray ray, float t) {
  return t * dot(ray.direction, view_forward);
}

// The ray through a picture position in pixels from the top left corner. Its direction, or for parallel rays its
// origin, nearly always equals the CPU's to the last bit. Edges of a checker pass through the centres of many pixels,
// and that bit decides where such an edge lies.
Ray camera_ray(vec2 position) {
  vec2 steps = position - half_size;
  Pair3 start = Pair3(forward, forward_lower);
  if (has_parallel_rays) start = Pair3(eye, eye_lower);
  Pair3 across = sum_of(start, product_of(vec3(steps.x), Pair3(right, right_lower)));
  Pair3 reached = sum_of(across, product_of(vec3(steps.y), Pair3(down, down_lower)));
  if (has_parallel_rays) return make_ray(reached.upper, forward);
  return make_ray(eye, normalized(reached));
}
