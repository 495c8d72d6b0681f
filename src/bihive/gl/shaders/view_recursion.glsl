// View::recursion. Twin of recursion_colour() in render/views.h.
#include "film"
#include "integrator"

vec3 recursion_colour(int deepest_hit) {
  switch (deepest_hit) {
    case 0:
      return vec3(0.0, 0.0, 0.0);
    case 1:
      return vec3(1.0, 0.0, 0.0);
    case 2:
      return vec3(0.0, 1.0, 0.0);
    case 3:
      return vec3(0.0, 0.0, 1.0);
    case 4:
      return vec3(1.0, 1.0, 0.0);
    case 5:
      return vec3(1.0, 0.0, 1.0);
  }
  return vec3(1.0);
}

void main() {
  Light light = radiance(sample_ray(), false);
  float rays = float(light.other_rays) + (loops_run() ? 0.0 : kLoopsStopped);
  add_to_film(vec4(recursion_colour(light.deepest_hit), rays));
}
