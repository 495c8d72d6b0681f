#include "bihive/scene/camera_lights.h"

#include "bihive/math/elementary.h"
#include "bihive/scene/framing.h"

namespace bihive {
namespace {

// Distance of camera lights from look_at, in distances of the camera.
constexpr double kFarAway = 8;

constexpr Vec3d grey(double strength) {
  return {strength, strength, strength};
}

}  // namespace

const Names<LightRig>& light_presets() {
  static const Names<LightRig> presets{
      {"thesis", {}},
      {"studio",
       {grey(0.55),
        false,
        {{{-0.55, 0.75, 0.65}, grey(0.58), 14}, {{0.9, 0.1, 0.5}, grey(0.10), 40}, {{0.5, 0.5, -0.9}, grey(0.25), 10}},
        {}}},
      {"cloudy", {grey(0.85), false, {{{-0.1, 1, 0.35}, grey(0.30), 70}}, {}}},
      {"headlight", {grey(0.45), false, {{{0, 0, 1}, grey(0.65), 0}}, {}}},
  };
  return presets;
}

std::vector<PointLight> lights_around(const LightRig& rig, const Camera& camera) {
  std::vector<PointLight> lights;
  if (rig.light_behind) lights.push_back(light_behind(camera));
  const Vec3d view = camera.look_at - camera.eye;
  const double distance = length(view);
  const Vec3d forward = view / distance;
  const Vec3d right = normalized(cross(forward, camera.up));
  const Vec3d up = cross(right, forward);
  for (const CameraLight& light : rig.lights) {
    const Vec3d direction =
        normalized(light.direction.x * right + light.direction.y * up - light.direction.z * forward);
    const double away = kFarAway * distance;
    lights.push_back({camera.look_at + away * direction, light.colour, away * tan_deg(light.angle_deg / 2)});
  }
  lights.insert(lights.end(), rig.placed.begin(), rig.placed.end());
  return lights;
}

}  // namespace bihive
