// What a picture gets beyond plain rays, as the user has it now: what the options --samples auto, --ao, --light-points,
// --opacity-rule, --fog, --outline, --exposure, --tone, --legend, --scale-bar, --axes, --title and --length-unit are
// for `bihive render`.
#pragma once

#include <limits>

#include "bihive/base/result.h"
#include "bihive/image/tone.h"
#include "bihive/scene/labels.h"
#include "bihive/scene/opacity_rule.h"
#include "bihive/scene/render_settings.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// Plain data. Every member has a value: the scene's own until the user changes it.
struct ViewerEffects {
  bool adaptive_samples = false;  ///< more samples on edges; the number of samples does not count then
  bool ambient_occlusion = false;
  double ambient_distance = std::numeric_limits<double>::infinity();  ///< world units, > 0
  int ambient_directions = 64;                                        ///< 1 to kMostAmbientDirections
  int light_points = 8;                                               ///< 1 to kMostLightPoints
  OpacityRule opacity_rule = OpacityRule::each_surface;
  double fog = 0;         ///< strength, 0 (none) to 1
  double outline_px = 0;  ///< 0 (none), or 1 to kWidestOutlinePx
  Tone tone;
  Labels labels;
};

/// Error: a number is out of range.
Status check_effects(const ViewerEffects& effects);

/// Those of a scene's own picture.
ViewerEffects effects_of(const PictureDefaults& defaults);

/// The scene's own picture is another one: each member that was as before becomes what it is now; what the user has
/// changed stays.
void follow_effects(const PictureDefaults& before, const PictureDefaults& now, ViewerEffects& effects);

/// Replaces the effects of settings that come from a scene's defaults, as the options of `bihive render` do: what has
/// no option (the reach of fog, the colour of outlines) stays the scene's.
void put_effects(const ViewerEffects& effects, RenderSettings& settings);

}  // namespace bihive
