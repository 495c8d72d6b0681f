// Turns a camera around its look-at point.
#pragma once

#include "bihive/scene/camera.h"
#include "bihive/scene/framing.h"

namespace bihive {

/// Degrees, applied in this order. Each is finite.
struct Turn {
  double azimuth = 0;    ///< the eye moves to the right around the picture's vertical; the scene turns to the left
  double elevation = 0;  ///< the eye moves up; the scene tips down towards the viewer
  double roll = 0;       ///< the picture turns counter-clockwise
};

/// Neither distance nor lens changes. `up` turns along, so the eye may go over the poles.
Side turned(const Side& side, const Turn& turn);
Camera turned(const Camera& camera, const Turn& turn);

/// Turns eye and `up` about an axis through look_at, a unit vector in the world: counter-clockwise, seen from its tip.
Camera turned_about(const Camera& camera, Vec3d axis, double degrees);

}  // namespace bihive
