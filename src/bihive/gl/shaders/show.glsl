// The film on a screen. Twin of image/transfer.h. The film's rows count from the top, the screen's from below.
#include "common"
#include "elementary"
#include "film_texel"

uniform FILM_SAMPLER film;
uniform vec2 film_size;
uniform vec2 corner;  // of the viewport
uniform vec2 size;
uniform float samples;
uniform bool srgb;
uniform bool only_background;
uniform vec3 background;
out vec4 shown;

float srgb_from_linear(float linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * portable_pow(linear, 1.0 / 2.4) - 0.055;
}

void main() {
  vec2 place = (gl_FragCoord.xy - corner) / size;
  ivec2 pixel = ivec2(clamp(vec2(place.x, 1.0 - place.y) * film_size, vec2(0.0), film_size - 1.0));
  vec3 radiance = only_background ? background : film_numbers(texelFetch(film, pixel, 0)).xyz / samples;
  radiance = clamp(radiance, 0.0, 1.0);
  if (srgb)
    radiance = vec3(srgb_from_linear(radiance.x), srgb_from_linear(radiance.y), srgb_from_linear(radiance.z));
  shown = vec4(radiance, 1.0);
}
