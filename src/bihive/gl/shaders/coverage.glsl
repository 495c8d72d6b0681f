// The coverage of each sample: 1 if it hits something opaque, and less if everything it meets transmits light. For
// transparent backgrounds.
#include "film"
#include "scene_hit"

void main() {
  Ray ray = sample_ray();
  float behind = 1.0;
  Hit hit = scene_hit(ray);
#ifdef LAYERS
  while (is_layer(hit.sphere)) {
    behind *= passing(hit.sphere).x;
    ray.t_passed = hit.t;
    ray.id_passed = int(sphere_id(hit.sphere));
    ray.classes_passed |= class_bit(hit.sphere);
    hit = scene_hit(ray);
  }
#endif
  if (hit.sphere != kNothing) behind = 0.0;
  add_to_film(vec4(1.0 - behind, 0.0, 0.0, 0.0));
}
