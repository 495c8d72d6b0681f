// Turns a camera around the place that it looks at.
#pragma once

#include "bihive/scene/camera.h"
#include "bihive/scene/framing.h"

namespace bihive {

/// Degrees, applied in this order. Each is finite.
struct Turn {
  double azimuth = 0;    ///< the eye goes to the right around the picture's vertical; what it sees turns to the left
  double elevation = 0;  ///< the eye goes up; what it sees tips down towards the viewer
  double roll = 0;       ///< the picture turns counter-clockwise
};

/// Neither distance nor lens changes. `up` turns along, so the eye may go over the poles.
Side turned(const Side& side, const Turn& turn);
Camera turned(const Camera& camera, const Turn& turn);

}  // namespace bihive
