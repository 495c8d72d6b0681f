// Twin of render/picture/post_processing.h. The first hits of the sample, on opaque spheres and the plane, are in a texture with a
// border around the picture (shaders/first_hits.glsl).
#include "camera"
#include "textures"

const float kWidestLinePx = 255.0;

uniform bool has_lines;
uniform usampler2D first_hits;  // bits of the depth; position in leaf order, kPlane or kNothing; group
uniform int border;             // of the texture around the picture, in pixels
uniform float pixel_length;     // of one pixel; with one eye, at distance 1
uniform float picture_outline_px;
uniform bool has_creases;
uniform float line_unit_px;
uniform float outline_step;
uniform vec3 outline_colour;
uniform float fog_strength;  // 0: no fog
uniform vec2 fog_depths;     // where it begins and where it is full

struct Line {
  float width_px;
  bool is_outline;
};

Line line_of(int sphere) {
  float own = uintBitsToFloat(texelFetch(sphere_info, texel(sphere), 0).w);
  float outline = own >= 0.0 ? own : picture_outline_px;
  float width = (outline > 0.0 || !has_creases ? outline : 1.0) * line_unit_px;
  return Line(min(width, kWidestLinePx), outline > 0.0);
}

// The share of the line's colour in this sample.
float outline_at(ivec2 place) {
  uvec4 here = texelFetch(first_hits, place, 0);
  int sphere = int(here.y);
  if (sphere < 0) return 0.0;
  Line line = line_of(sphere);
  if (!(line.width_px > 0.0)) return 0.0;
  float depth = uintBitsToFloat(here.x);
  float radius = stored_sphere(sphere).w;
  float pixel = pixel_length * (has_parallel_rays ? 1.0 : depth);
  float width = min(line.width_px, radius / (6.0 * pixel));
  float wide = max(width, 1.0);

  // Search for something deeper nearby.
  float limit = line.is_outline ? depth + outline_step * radius : kNever;
  int reach = int(wide);
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      if (float(x * x + y * y) > wide * wide) continue;
      uvec4 beside = texelFetch(first_hits, place + ivec2(x, y), 0);
      if (int(beside.y) == sphere) continue;
      float its_depth = uintBitsToFloat(beside.x);
      bool touches = int(beside.y) >= 0 && beside.z != here.z && its_depth > depth;
      if (touches || its_depth > limit) return min(width, 1.0);
    }
  return 0.0;
}

float fog_at(float depth) {
  return fog_strength * clamp((depth - fog_depths.x) / (fog_depths.y - fog_depths.x), 0.0, 1.0);
}

// `weight`: the share of light transmitted by what is transparent in front of the surface at this depth.
vec3 applied(vec3 light, float depth, float weight, vec3 background) {
  if (has_lines) light = mix(light, outline_colour, outline_at(ivec2(gl_FragCoord.xy) + border) * weight);
  if (fog_strength > 0.0 && depth < kNever) light = mix(light, background, fog_at(depth) * weight);
  return light;
}
