#include "bihive/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/math/elementary.h"

namespace bihive {
namespace {

// The length of one pixel in the world: for parallel rays, or on the plane at distance 1. The shorter side of the
// picture spans the camera's angle or length.
double pixel_of(const Camera& camera, int width_px, int height_px) {
  const bool parallel = camera.projection == Projection::orthographic;
  const double shorter_side = parallel ? camera.shorter_side : 2 * tan_deg(camera.fov_deg / 2);
  return shorter_side / std::min(width_px, height_px);
}

}  // namespace

Status check_camera(const Camera& camera) {
  const auto bad = [](const std::string& message, const std::string& hint) {
    return Error{"camera: " + message, "", 0, 0, hint};
  };
  if (!is_finite(camera.eye) || !is_finite(camera.look_at) || !is_finite(camera.up))
    return bad("eye, look_at and up must be finite", "");
  constexpr double kLargest = std::numeric_limits<float>::max();
  if (std::max({std::abs(camera.eye.x), std::abs(camera.eye.y), std::abs(camera.eye.z)}) > kLargest)
    return bad("eye must fit single precision (3.4e38)", "");
  if (!(camera.fov_deg > 0 && camera.fov_deg < 180)) return bad("fov must be above 0 and below 180 degrees", "");
  if (camera.projection == Projection::orthographic && !(camera.shorter_side > 0 && camera.shorter_side <= kLargest))
    return bad("the shorter side of an orthographic picture must be above 0 and fit single precision (3.4e38)", "");
  if (!(camera.aperture >= 0 && camera.aperture <= kLargest))
    return bad("the aperture must be at least 0 and fit single precision (3.4e38)", "");
  if (!(camera.focus >= 0 && camera.focus <= kLargest))
    return bad("the focus must be at least 0 and fit single precision (3.4e38)", "");
  if (camera.projection == Projection::orthographic && camera.aperture > 0)
    return bad("an orthographic camera has no lens, so nothing is out of focus",
               "draw in perspective, or set the aperture to 0");
  const Vec3d view = camera.look_at - camera.eye;
  if (!(length(view) > 0)) return bad("eye and look_at are the same point", "move one of them");
  if (!(length(camera.up) > 0)) return bad("up is zero", "give a direction such as 0,1,0");
  // If the cross product of two unit vectors is shorter than 1e-9, the picture's horizontal is undecided.
  if (!(length(cross(normalized(view), normalized(camera.up))) > 1e-9))
    return bad("up is parallel to the direction of view", "give another up");
  return Done{};
}

Camera with_projection(const Camera& camera, Projection projection) {
  Camera changed = camera;
  changed.projection = projection;
  if (projection == camera.projection) return changed;
  const double distance = length(camera.look_at - camera.eye);
  if (projection == Projection::orthographic)
    changed.shorter_side = 2 * distance * tan_deg(camera.fov_deg / 2);
  else
    changed.fov_deg = 2 * atan_deg(camera.shorter_side / (2 * distance));
  return changed;
}

Camera enlarged(const Camera& camera, double factor) {
  Camera changed = camera;
  if (factor == 1) return changed;
  if (camera.projection == Projection::orthographic)
    changed.shorter_side = camera.shorter_side / factor;
  else
    changed.fov_deg = 2 * atan_deg(tan_deg(camera.fov_deg / 2) / factor);
  return changed;
}

Camera relative_to(const Camera& camera, Vec3d origin) {
  Camera local = camera;
  local.eye = camera.eye - origin;
  local.look_at = camera.look_at - origin;
  return local;
}

double focus_distance(const Camera& camera) {
  return camera.focus > 0 ? camera.focus : length(camera.look_at - camera.eye);
}

PixelRays::PixelRays(const Camera& camera, int width_px, int height_px)
    : parallel_(camera.projection == Projection::orthographic),
      has_lens_(!parallel_ && camera.aperture > 0),
      eye_(to_float(camera.eye)),
      centre_(camera.eye),
      forward_(normalized(camera.look_at - camera.eye)) {
  const double pixel = pixel_of(camera, width_px, height_px);
  const Vec3d right = normalized(cross(forward_, normalized(camera.up)));
  right_ = right * pixel;
  const Vec3d down = cross(forward_, right);
  down_ = down * pixel;
  lens_right_ = right * camera.aperture;
  lens_down_ = down * camera.aperture;
  const double tilt = camera.aperture / focus_distance(camera);
  tilt_right_ = right * tilt;
  tilt_down_ = down * tilt;
  half_width_ = 0.5 * width_px;
  half_height_ = 0.5 * height_px;
}

Ray PixelRays::at(double x_px, double y_px) const {
  Ray ray;
  if (parallel_) {
    ray.origin = to_float(centre_ + (x_px - half_width_) * right_ + (y_px - half_height_) * down_);
    ray.direction = to_float(forward_);
    return ray;
  }
  const Vec3d direction = forward_ + (x_px - half_width_) * right_ + (y_px - half_height_) * down_;
  ray.origin = eye_;
  ray.direction = to_float(normalized(direction));
  return ray;
}

Ray PixelRays::at(double x_px, double y_px, LensPlace place) const {
  if (!has_lens_) return at(x_px, y_px);
  const Vec3d direction = forward_ + (x_px - half_width_) * right_ + (y_px - half_height_) * down_;
  Ray ray;
  ray.origin = to_float(centre_ + (place.x * lens_right_ + place.y * lens_down_));
  ray.direction = to_float(normalized(direction - (place.x * tilt_right_ + place.y * tilt_down_)));
  return ray;
}

PixelPlaces::PixelPlaces(const Camera& camera, int width_px, int height_px)
    : parallel_(camera.projection == Projection::orthographic),
      eye_(to_float(camera.eye)),
      forward_(normalized(camera.look_at - camera.eye)) {
  const double pixel = pixel_of(camera, width_px, height_px);
  const Vec3d right = normalized(cross(forward_, normalized(camera.up)));
  right_ = right / pixel;
  down_ = cross(forward_, right) / pixel;
  half_width_ = 0.5 * width_px;
  half_height_ = 0.5 * height_px;
}

Vec3d PixelPlaces::from_eye(Vec3d world) const {
  const Vec3d offset = world - to_double(eye_);
  return {dot(offset, right_), dot(offset, down_), dot(offset, forward_)};
}

}  // namespace bihive
