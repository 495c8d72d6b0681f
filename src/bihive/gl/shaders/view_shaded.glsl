// View::shaded.
#include "film"
#include "integrator"

void main() {
  Light light = radiance(sample_ray(), true);
  add_to_film(vec4(light.radiance, light.other_rays));
}
