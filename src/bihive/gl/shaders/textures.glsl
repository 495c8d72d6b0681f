// Twin of gl/tree_textures.h: the content of its textures.
#include "common"

uniform sampler2D spheres;       // a texel per sphere in leaf order: centre, radius
uniform usampler2D sphere_info;  // a texel per sphere: id, look, group, bits of its own outline
uniform usampler2D nodes;        // two texels per node: planes; kind, axis and count, first
uniform sampler2D looks;         // four texels per look (a material); the plane's is look 0
uniform sampler2D lights;        // two texels per light: position, radius; colour
uniform int sphere_count;

ivec2 texel(int i) {
  return ivec2(i & 2047, i >> 11);
}

vec4 stored_sphere(int i) {
  return texelFetch(spheres, texel(i), 0);
}

uint sphere_id(int i) {
  return texelFetch(sphere_info, texel(i), 0).x;
}
