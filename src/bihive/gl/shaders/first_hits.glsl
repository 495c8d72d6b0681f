// The first hits of one sample on opaque spheres and the plane, for outlines: see post_processing.glsl.
#include "sample"
#include "scene_hit"

out uvec4 first_hit;

void main() {
  Ray ray = sample_ray();
  Hit hit = closest_opaque(ray);
  float depth = hit.sphere == kNothing ? kNever : depth_of(ray, hit.t);
  uint group = hit.sphere >= 0 ? texelFetch(sphere_info, texel(hit.sphere), 0).z : 0u;
  first_hit = uvec4(floatBitsToUint(depth), uint(hit.sphere), group, 0u);
}
