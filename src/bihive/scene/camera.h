// A camera, and the rays through its pixels.
#pragma once

#include "bihive/base/result.h"
#include "bihive/geometry/ray.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// perspective: all rays start at the eye. orthographic: all rays are parallel, and start on the plane through the eye
/// at right angles to the view; equal spheres look equally large at any distance. Nothing behind that plane is visible.
enum class Projection { perspective, orthographic };

/// World units.
struct Camera {
  Vec3d eye{0, 0, 100};
  Vec3d look_at{0, 0, 0};
  Vec3d up{0, 1, 0};
  double fov_deg = 30;  ///< perspective: the full angle along the picture's shorter side, above 0 and below 180
  Projection projection = Projection::perspective;
  double shorter_side = 50;  ///< orthographic: the length in the world along the picture's shorter side, above 0
  double aperture = 0;       ///< the radius of a thin lens, at least 0; 0 shows everything sharply. Perspective alone.
  double focus = 0;          ///< with an aperture: distance of sharp focus along the view; 0: at look_at
};

inline bool operator==(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.look_at == b.look_at && a.up == b.up && a.fov_deg == b.fov_deg &&
         a.projection == b.projection && a.shorter_side == b.shorter_side && a.aperture == b.aperture &&
         a.focus == b.focus;
}

/// An error if eye and look_at coincide, up is parallel to the view or zero, a number is not finite, the angle, the
/// shorter side, the aperture or the focus is out of range, or an orthographic camera has an aperture.
Status check_camera(const Camera& camera);

/// The same camera with this projection. Objects at the distance of look_at keep their size in the picture.
Camera with_projection(const Camera& camera, Projection projection);

/// The same camera with a picture `factor` times as large, above 0: it changes the angle or the shorter side. The eye
/// stays, so nothing that was in front of it is cut off.
Camera enlarged(const Camera& camera, double factor);

/// The same camera, given from another origin: rays are local (geometry/sphere_set.h).
Camera relative_to(const Camera& camera, Vec3d origin);

/// The distance along the view that is sharp.
double focus_distance(const Camera& camera);

/// A point of the lens, in units of its radius: at most 1 from the middle; to the right and down, as the camera sees
/// it.
struct LensPlace {
  double x = 0, y = 0;
};

/// A camera prepared for a picture of width x height pixels.
class PixelRays {
 public:
  /// The camera must pass check_camera().
  PixelRays(const Camera& camera, int width_px, int height_px);

  /// The ray through picture position (x, y) in pixels: (0, 0) is the top left corner, (0.5, 0.5) the first pixel's
  /// centre. Its direction has length 1 up to binary32 rounding. Parallel rays: all directions have the same bits, and
  /// each origin is rounded once.
  Ray at(double x_px, double y_px) const;

  /// The ray through a point of the lens that meets the ray above in the plane of focus. Its origin is rounded once.
  /// Without a lens it is the ray above.
  Ray at(double x_px, double y_px, LensPlace place) const;

  /// The vectors of at(), for code that makes many rays at once. Let step be (x - half_width) right + (y - half_height)
  /// down. Rays from one eye: the direction through (x, y) is that of forward + step. Parallel rays: the origin is
  /// centre + step, and the direction is that of forward. Rays through point p of a lens: the origin is centre + p.x
  /// lens_right + p.y lens_down, and the direction is that of forward + step - (p.x tilt_right + p.y tilt_down).
  bool parallel() const { return parallel_; }
  bool has_lens() const { return has_lens_; }
  Vec3d lens_right() const { return lens_right_; }
  Vec3d lens_down() const { return lens_down_; }
  Vec3d tilt_right() const { return tilt_right_; }
  Vec3d tilt_down() const { return tilt_down_; }
  Vec3f eye() const { return eye_; }
  Vec3d centre() const { return centre_; }
  Vec3d forward() const { return forward_; }
  Vec3d right() const { return right_; }
  Vec3d down() const { return down_; }
  double half_width() const { return half_width_; }
  double half_height() const { return half_height_; }

 private:
  bool parallel_, has_lens_;
  Vec3f eye_;
  Vec3d centre_;                  // the eye before it is rounded
  Vec3d forward_, right_, down_;  // right_ and down_ span one pixel; with one eye, on the plane at distance 1
  Vec3d lens_right_, lens_down_;  // from the middle of the lens to its rim
  Vec3d tilt_right_, tilt_down_;  // the same at distance 1, seen from the plane of focus
  double half_width_, half_height_;
};

/// The inverse: the picture positions of points of the world, for width x height pixels.
class PixelPlaces {
 public:
  /// The camera must pass check_camera().
  PixelPlaces(const Camera& camera, int width_px, int height_px);

  /// Steps to the right and down, and the distance along the view, measured from the eye; the steps in pixels, with one
  /// eye in pixels at distance 1.
  Vec3d from_eye(Vec3d world) const;

  /// Picture position in pixels, as in PixelRays::at(), of a point given from the eye at a distance above 0.
  double x_px(Vec3d point) const { return half_width_ + (parallel_ ? point.x : point.x / point.z); }
  double y_px(Vec3d point) const { return half_height_ + (parallel_ ? point.y : point.y / point.z); }

 private:
  bool parallel_;
  // binary32 as in PixelRays. The conversions stay apart: GCC 12 drops the rounding if it sees both at once.
  Vec3f eye_;
  Vec3d right_, down_, forward_;
  double half_width_, half_height_;
};

}  // namespace bihive
