// Lights as users write them: `bihive render --light`.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/scene/camera_lights.h"

namespace bihive {

/// The lights that several texts ask for: at most one preset, and any number of single lights.
struct LightChoice {
  std::optional<LightRig> preset;
  std::vector<CameraLight> around;
  std::vector<PointLight> placed;

  bool empty() const { return !preset && around.empty() && placed.empty(); }
};

/// Adds a text to the choice. It is the name of a preset, or a light of its own:
///   from:RIGHT,UP,TOWARDS[:COLOUR[:STRENGTH[:DEG]]]   a CameraLight far away in that direction from the camera
///   at:X,Y,Z[:COLOUR[:STRENGTH[:RADIUS]]]             a PointLight at a point of the world
/// COLOUR: as colour_choice_from_text() takes it, white if it is empty or left out. STRENGTH multiplies it: 0 to
/// 1e6, 1. DEG: 0 to 90, 0. RADIUS: 0 to 1e18, 0. Error: what was expected instead.
Status add_light(const std::string& text, LightChoice& choice);

/// The choice's lights. Single lights without a preset keep `ambient_light`.
LightRig rig_of(const LightChoice& choice, Vec3d ambient_light);

}  // namespace bihive
