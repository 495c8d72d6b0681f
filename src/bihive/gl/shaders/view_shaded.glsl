// View::shaded: one slice of a sample. The last slice completes the sample.
#include "post_processing"
#include "film"
#include "integrator"
#include "tone"

uniform FILM_SAMPLER slices_before;  // of this sample
uniform bool last_slice;

void main() {
  Ray ray = sample_ray();
  Light light = radiance(ray, true);
  vec4 sum = vec4(light.radiance, light.other_rays);
  if (!loops_run()) sum.w += kLoopsStopped;
  if (!first_slice) sum += film_numbers(texelFetch(slices_before, ivec2(gl_FragCoord.xy), 0));
  if (!last_slice) {
    film_after = film_texel(sum);
    return;
  }
  if (light.deepest_hit > 0) sum.xyz = toned(sum.xyz);
  float depth = light.t < kNever ? depth_of(ray, light.t) : kNever;
  add_to_film(vec4(applied(sum.xyz, depth, light.passing, background), sum.w));
}
