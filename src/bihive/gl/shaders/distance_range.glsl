// The range of distances for the distance view: the nearest and the farthest sample of a pixel up to now.
#include "film"
#include "scene_hit"

void main() {
  Ray ray = sample_ray();
  Hit hit = scene_hit(ray);
  float distance = hit.t * length(ray.direction);
  vec2 range = hit.sphere == kNothing ? vec2(kNever, -kNever) : vec2(distance);
  if (sample_index > 0) {
    vec2 before = numbers_before().xy;
    range = vec2(min(before.x, range.x), max(before.y, range.y));
  }
  film_after = film_texel(vec4(range, 0.0, 0.0));
}
