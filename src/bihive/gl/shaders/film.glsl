// One sample of every pixel: the film before and what the sample adds. Rows count from the top. Alpha adds up the rays
// that were traced besides primary ones.
#include "camera"

uniform sampler2D film_before;
uniform int sample_index;  // 0: there is no film before
uniform vec2 sample_place;
out vec4 film_after;

Ray sample_ray() {
  return camera_ray(floor(gl_FragCoord.xy) + sample_place);
}

void add_to_film(vec4 value) {
  vec4 before = sample_index > 0 ? texelFetch(film_before, ivec2(gl_FragCoord.xy), 0) : vec4(0.0);
  film_after = before + value;
}
