// Twin of render/transparency.h, on one tree of all spheres: a sphere's look says what it lets through. With LAYERS
// transparent spheres are passed straight and count once (OpacityRule::once); else all spheres are opaque here.
#include "textures"

#ifdef LAYERS
// The share that a sphere lets through: x for rays that see, y for rays that ask for light.
vec2 passing(int sphere) {
  int look = int(texelFetch(sphere_info, texel(sphere), 0).y);
  return texelFetch(looks, texel(4 * look + 3), 0).yz;
}

// Does a ray that sees go on behind this?
bool is_layer(int sphere) {
  return sphere >= 0 && passing(sphere).x > 0.0;
}
#endif
