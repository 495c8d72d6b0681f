// Twin of image/tone.h.
#include "common"

uniform int tone_curve;  // 0 none, 1 soft, 2 filmic
uniform float exposure_factor;

const float kSoftWhite = 4.0;
const float kFilmicWhite = 7.25;

float soft_curve(float x) {
  const float white = 2.0 * (kSoftWhite - 0.5);
  float s = 2.0 * (min(x, kSoftWhite) - 0.5);
  return 0.5 + 0.5 * (s * (1.0 + s / (white * white)) / (1.0 + s));
}

vec3 filmic_curve(vec3 x) {
  vec3 light = clamp(x, 0.0, kFilmicWhite);
  return min(light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14), vec3(1.0));
}

vec3 toned(vec3 light) {
  vec3 exposed = exposure_factor * light;
  if (tone_curve == 0) return exposed;
  if (tone_curve == 2) return filmic_curve(exposed);
  float largest = max(max(exposed.x, exposed.y), exposed.z);
  return largest > 0.5 ? soft_curve(largest) / largest * exposed : exposed;
}
