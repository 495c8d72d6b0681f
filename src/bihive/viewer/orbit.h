// Moves a camera by the pointer. Pure functions from camera to camera, for worlds of any size.
//
// Pixels count as in PixelRays (scene/camera.h), dy downwards. All cameras must pass check_camera(); the returned
// cameras do.
#pragma once

#include "bihive/math/vec3.h"
#include "bihive/scene/camera.h"

namespace bihive {

struct PictureSizePx {
  int width, height;
};

/// Turns the eye around look_at, so that the scene follows the pointer: half a turn along the picture's shorter side.
/// `up` stays; the eye stops a degree before either pole. The distance stays.
Camera orbited(const Camera& camera, double dx_px, double dy_px, PictureSizePx size);

/// Shifts eye and look_at alike, so that points as far away as look_at follow the pointer. The camera stays if the eye
/// would leave binary32's range.
Camera panned(const Camera& camera, double dx_px, double dy_px, PictureSizePx size);

/// The point under (x, y) that is as far along the view as look_at.
Vec3d point_under(const Camera& camera, double x_px, double y_px, PictureSizePx size);

/// The allowed distances of the eye from look_at; with an orthographic camera the allowed lengths of its shorter side.
struct DistanceLimits {
  double nearest, farthest;
};
/// Limits for a set whose box has this diagonal. Near limit: a pixel is as fine as the steps of an eye in binary32. Far
/// limit: the set is a dot.
DistanceLimits distance_limits(const Camera& camera, double diagonal);

/// A factor above 1 comes closer. It divides the distances of eye and look_at from the anchor, so the anchor keeps its
/// position in the picture. An orthographic camera divides its shorter side instead. Ends at the limits; a camera
/// beyond a limit may come back. `factor` must be finite and above 0.
Camera zoomed(const Camera& camera, double factor, Vec3d anchor, DistanceLimits limits);

}  // namespace bihive
