// One sample of every pixel: the film before, plus the light of the sample. Rows count from the top. Alpha adds up the
// rays that are not primary rays.
#include "camera"
#include "film_texel"

uniform FILM_SAMPLER film_before;
uniform int sample_index;  // 0: there is no film before
uniform vec2 sample_place;
out FILM_TEXEL film_after;

Ray sample_ray() {
  return camera_ray(floor(gl_FragCoord.xy) + sample_place);
}

vec4 numbers_before() {
  return film_numbers(texelFetch(film_before, ivec2(gl_FragCoord.xy), 0));
}

void add_to_film(vec4 value) {
  film_after = film_texel(sample_index > 0 ? numbers_before() + value : value);
}
