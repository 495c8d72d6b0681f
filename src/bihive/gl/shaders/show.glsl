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
uniform bool transparent;  // grey checks show through, or the page behind
uniform bool checks;
uniform FILM_SAMPLER coverage;
out vec4 shown;

float srgb_from_linear(float linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * portable_pow(linear, 1.0 / 2.4) - 0.055;
}

// As image_to_show() of viewer/shown_image.h.
float check_at(ivec2 pixel) {
  ivec2 check = pixel / 12;
  return ((check.x + check.y) % 2 == 0 ? 235.0 : 205.0) / 255.0;
}

void main() {
  vec2 place = (gl_FragCoord.xy - corner) / size;
  ivec2 pixel = ivec2(clamp(vec2(place.x, 1.0 - place.y) * film_size, vec2(0.0), film_size - 1.0));
  float covered = transparent ? film_numbers(texelFetch(coverage, pixel, 0)).x : samples;
  vec3 radiance = only_background ? background : film_numbers(texelFetch(film, pixel, 0)).xyz / max(covered, 1.0e-6);
  radiance = clamp(radiance, 0.0, 1.0);
  if (srgb)
    radiance = vec3(srgb_from_linear(radiance.x), srgb_from_linear(radiance.y), srgb_from_linear(radiance.z));
  float opacity = transparent ? covered / samples : 1.0;
  // Browsers expect colours multiplied by their opacity.
  shown = checks ? vec4(mix(vec3(check_at(pixel)), radiance, opacity), 1.0) : vec4(radiance * opacity, opacity);
}
