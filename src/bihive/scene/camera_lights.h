// Lights fixed to the camera.
#pragma once

#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/names.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// A light far away whose direction turns with the camera.
struct CameraLight {
  Vec3d direction{0, 0, 1};  ///< towards the light: right, up and towards the viewer; any length above 0
  Vec3d colour{1, 1, 1};     ///< linear, each >= 0
  double angle_deg = 0;      ///< angular size of the light, 0 to 90; 0 casts sharp shadows
};

struct LightRig {
  Vec3d ambient_light{1, 1, 1};  ///< strength of the ambient term
  bool light_behind = true;      ///< the light of light_behind(), before `lights`
  std::vector<CameraLight> lights;
  std::vector<PointLight> placed;  ///< lights fixed in the world, after `lights`
};

/// thesis: one point light behind the camera. studio: soft key from above left, fill from the right, rim from behind.
/// cloudy: most light from everywhere, and a very wide one from above. headlight: one at the camera.
const Names<LightRig>& light_presets();

/// The lights of the rig for a camera that passes check_camera().
std::vector<PointLight> lights_around(const LightRig& rig, const Camera& camera);

}  // namespace bihive
