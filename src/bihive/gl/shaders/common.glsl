// Functions for every chunk. All lengths are in stored units (geometry/sphere_set.h).
precision highp float;
precision highp int;
precision highp sampler2D;
precision highp usampler2D;

const float kNever = 3.0e38;  // the t of no hit
const int kNothing = -1;
const int kPlane = -2;

// a / |a|, by one square root and a division, because inversesqrt() may be coarse.
vec3 normalized(vec3 a) {
  return a / sqrt(dot(a, a));
}
