// A pinhole camera, and the rays through its pixels.
#pragma once

#include "bihive/base/result.h"
#include "bihive/geometry/ray.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// World units. `fov_deg` is the full angle along the picture's shorter side, above 0 and below 180.
struct Camera {
  Vec3d eye{0, 0, 100};
  Vec3d look_at{0, 0, 0};
  Vec3d up{0, 1, 0};
  double fov_deg = 30;
};

/// An error if eye and look_at coincide, up is parallel to the view or zero, a number is not finite, or the angle is
/// out of range.
Status check_camera(const Camera& camera);

/// A camera prepared for a picture of width x height pixels.
class PixelRays {
 public:
  /// The camera must pass check_camera().
  PixelRays(const Camera& camera, int width_px, int height_px);

  /// The ray through picture position (x, y) in pixels: (0, 0) is the top left corner, (0.5, 0.5) the first pixel's
  /// centre. Its direction has length 1 up to binary32 rounding.
  Ray at(double x_px, double y_px) const;

  /// The vectors of at(), for code that makes many rays at once: the direction through (x, y) is that of forward + (x -
  /// half_width) right + (y - half_height) down.
  Vec3f eye() const { return eye_; }
  Vec3d forward() const { return forward_; }
  Vec3d right() const { return right_; }
  Vec3d down() const { return down_; }
  double half_width() const { return half_width_; }
  double half_height() const { return half_height_; }

 private:
  Vec3f eye_;
  Vec3d forward_, right_, down_;  // right_ and down_ span one pixel on the plane at distance 1
  double half_width_, half_height_;
};

/// The inverse: the places of the world's points in a picture of width x height pixels.
class PixelPlaces {
 public:
  /// The camera must pass check_camera().
  PixelPlaces(const Camera& camera, int width_px, int height_px);

  /// Steps to the right and down, and the distance along the view, measured from the eye; the steps in pixels at
  /// distance 1.
  Vec3d from_eye(Vec3d world) const;

  /// Picture position in pixels, as in PixelRays::at(), of a point given from the eye at a distance above 0.
  double x_px(Vec3d point) const { return half_width_ + point.x / point.z; }
  double y_px(Vec3d point) const { return half_height_ + point.y / point.z; }

 private:
  // binary32 as in PixelRays. The conversions stay apart: GCC 12 drops the rounding if it sees both at once.
  Vec3f eye_;
  Vec3d right_, down_, forward_;
  double half_width_, half_height_;
};

}  // namespace bihive
