// The light of a sample in slices: each samples some directions of ambient occlusion and some lights, and the sum is
// the sample's light.
//
// A pixel that samples hundreds of directions takes long in one draw, and some drivers limit that: Mesa's llvmpipe ends
// all loops of a pixel after 65,535 iterations in total, others reset the GPU after seconds. Every slice follows the
// primary ray and its reflections again, so slices are not too small either; where loops were stopped, the renderer
// tries smaller ones.
#pragma once

#include <algorithm>
#include <vector>

namespace bihive {

/// Half-open ranges. Lights between light_begin and light_end use all of these points. A faint layer, which uses fewer
/// (scene/faint_level.h), takes the same fractions of its own numbers.
struct LightSlice {
  int direction_begin = 0, direction_end = 0;
  int light_begin = 0, light_end = 0;
  int point_begin = 0, point_end = 0;
};

/// The maximum rays of a surface per slice: if a primary ray meets one surface, and if it may meet many layers. A ray
/// takes some hundred loop iterations in a set of a million spheres.
constexpr int kRaysOfSlice = 64;
constexpr int kRaysOfLayerSlice = 12;
constexpr int kSmallerSlices = 4;

struct LightWork {
  int directions = 0;          ///< 0: no ambient occlusion
  int lights = 0, points = 1;  ///< per light; 1: no soft shadows
  bool whole_lights = false;   ///< the points of a light must stay together: bands of light
};

/// At least one slice; together they have every direction and every point of every light once. Of the directions half
/// lie behind a surface and cost no ray.
inline std::vector<LightSlice> light_slices(const LightWork& work, int most_rays) {
  std::vector<LightSlice> slices;
  const int rays_of_lights = work.lights * work.points;
  if (work.directions / 2 + rays_of_lights <= most_rays) return {{0, work.directions, 0, work.lights, 0, work.points}};
  for (int begin = 0; begin < work.directions; begin += 2 * most_rays)
    slices.push_back({begin, std::min(begin + 2 * most_rays, work.directions), 0, 0, 0, 0});

  // Several lights per slice, or some points of one light.
  const int lights_at_once = std::max(1, most_rays / work.points);
  const int points_at_once = work.whole_lights ? work.points : std::min(work.points, most_rays);
  for (int light = 0; light < work.lights; light += lights_at_once)
    for (int point = 0; point < work.points; point += points_at_once)
      slices.push_back({0, 0, light, std::min(light + lights_at_once, work.lights), point,
                        std::min(point + points_at_once, work.points)});
  if (slices.empty()) slices.emplace_back();
  return slices;
}

}  // namespace bihive
