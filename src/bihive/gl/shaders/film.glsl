// One sample of every pixel: the previous film plus the light of the sample. Rows count from the top. Alpha adds up the
// rays that are not primary rays.
#include "film_texel"
#include "sample"

uniform FILM_SAMPLER film_before;
uniform int sample_index;  // 0: there is no film before
out FILM_TEXEL film_after;

vec4 numbers_before() {
  return film_numbers(texelFetch(film_before, ivec2(gl_FragCoord.xy), 0));
}

// Added to alpha where a driver has stopped the loops of a pixel (gl/light_slices.h).
const float kLoopsStopped = 1.0e12;

// Do loops still run as often as they should?
bool loops_run() {
  int turns = 0;
  for (int i = 0; i < 3 + int(zero_bits); ++i) turns += 1 + int(zero_bits);
  return turns == 3;
}

void add_to_film(vec4 value) {
  film_after = film_texel(sample_index > 0 ? numbers_before() + value : value);
}
