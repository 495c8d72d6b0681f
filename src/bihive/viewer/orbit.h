// How the pointer moves a camera. Pure functions: a camera in, a camera out, in worlds of any size.
//
// Pixels count as in PixelRays (scene/camera.h), dy downwards. All cameras must pass check_camera(), and those returned
// do.
#pragma once

#include "bihive/math/vec3.h"
#include "bihive/scene/camera.h"

namespace bihive {

struct PictureSizePx {
  int width, height;
};

/// Turns the eye around what is looked at, so that the scene follows the pointer: along the picture's shorter side by
/// half a turn. `up` stays; towards it and away from it the eye stops a degree before the pole. The distance stays.
Camera orbited(const Camera& camera, double dx_px, double dy_px, PictureSizePx size);

/// Shifts eye and look_at alike, so that what lies as far away as look_at follows the pointer. Where the eye would
/// leave binary32's range the camera stays.
Camera panned(const Camera& camera, double dx_px, double dy_px, PictureSizePx size);

/// The point under (x, y) that lies as far along the view as look_at.
Vec3d point_under(const Camera& camera, double x_px, double y_px, PictureSizePx size);

/// How far from look_at the eye may be.
struct DistanceLimits {
  double nearest, farthest;
};
/// For a set whose box has this diagonal, seen by a camera: from where a pixel is no finer than an eye in binary32 can
/// be placed, to where the set is a dot.
DistanceLimits distance_limits(const Camera& camera, double diagonal);

/// Above 1 comes closer: the distances of eye and look_at from the anchor are divided by `factor`, so that the anchor,
/// wherever it is seen, stays there. Ends at the limits; a camera beyond one may come back. `factor` must be finite and
/// above 0.
Camera zoomed(const Camera& camera, double factor, Vec3d anchor, DistanceLimits limits);

}  // namespace bihive
