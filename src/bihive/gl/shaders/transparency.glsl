// Twin of render/transparency.h, on one tree of all spheres: a sphere's look says what it transmits. With LAYERS rays
// pass straight through transparent spheres, which count once (OpacityRule::once, or first of their class
// with OpacityRule::first); else all spheres are opaque here.
#include "textures"

#ifdef LAYERS
// The share that a sphere transmits: x for viewing rays, y for shadow rays.
vec2 passing(int sphere) {
  int look = int(texelFetch(sphere_info, texel(sphere), 0).y);
  return texelFetch(looks, texel(4 * look + 3), 0).yz;
}

// The tint of the transmitted share. Twin of passing_tint().
vec3 passing_tint(int sphere, float share) {
  int look = int(texelFetch(sphere_info, texel(sphere), 0).y);
  vec3 colour = texelFetch(looks, texel(4 * look), 0).xyz;
  float largest = max(max(colour.x, colour.y), colour.z);
  return largest > 0.0 ? 1.0 - (1.0 - share) * (1.0 - max(colour, 0.0) / largest) : vec3(1.0);
}

uniform bool first_surfaces;  // OpacityRule::first

// The bit of its opacity_class() for a sphere that viewing rays pass straight; 0: it is in no class.
uint class_bit(int sphere) {
  float share = passing(sphere).x;
  return first_surfaces && share > 0.0 ? 1u << uint(min(int(16.0 * share), 15)) : 0u;
}

// Light that arrives behind a sphere, for shadow rays. Of a class that the ray has `crossed`, nothing more is lost.
vec3 arriving_behind(int sphere, inout uint crossed) {
  float share = passing(sphere).y;
  if (!(share > 0.0)) return vec3(0.0);
  uint bit = class_bit(sphere);
  if (bit == 0u) return share * passing_tint(sphere, share);
  bool again = (crossed & bit) != 0u;
  crossed |= bit;
  return vec3(again ? 1.0 : share);
}

// Does a viewing ray continue behind this?
bool is_layer(int sphere) {
  return sphere >= 0 && passing(sphere).x > 0.0;
}
#endif
