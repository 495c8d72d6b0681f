#include "bihive/viewer/orbit.h"

#include <algorithm>
#include <cmath>

#include "bihive/base/check.h"
#include "bihive/math/elementary.h"

namespace bihive {
namespace {

constexpr double kDegreesAcross = 180;       // rotation, along the shorter side
constexpr double kMostDegrees = 80;          // per move: tan_deg() gets half of it
constexpr double kLeastSine = 0.0174524064;  // minimum angle between view and up: 1 degree

struct Angle {
  double cosine, sine;
};

// The angle comes from the tangent of its half, with the same bits on every machine.
Angle angle_of(double degrees) {
  const double t = std::copysign(tan_deg(std::abs(degrees) / 2), degrees);
  const double scale = 1 / (1 + t * t);
  return {(1 - t * t) * scale, 2 * t * scale};
}

double degrees_of(double moved_px, PictureSizePx size) {
  const double degrees = kDegreesAcross * moved_px / std::min(size.width, size.height);
  return std::clamp(degrees, -kMostDegrees, kMostDegrees);
}

// Right and down by one pixel at the distance of look_at. For parallel rays, at any distance.
struct Steps {
  Vec3d right, down;
};

Steps steps_of(const Camera& camera, PictureSizePx size) {
  const PixelRays rays(camera, size.width, size.height);
  const double distance = rays.parallel() ? 1 : length(camera.look_at - camera.eye);
  return {distance * rays.right(), distance * rays.down()};
}

// No move may lead to an invalid camera.
Camera if_good(const Camera& moved, const Camera& before) {
  return check_camera(moved) ? moved : before;
}

}  // namespace

Camera orbited(const Camera& camera, double dx_px, double dy_px, PictureSizePx size) {
  const Vec3d offset = camera.eye - camera.look_at;
  const double distance = length(offset);
  const Vec3d back = offset / distance;
  const Vec3d up = normalized(camera.up);

  // The direction towards the eye as a height above the equator and a horizontal part.
  const double height = dot(back, up);
  const Vec3d level = back - height * up;
  const double across = length(level);
  const Vec3d ahead = level / across;
  const Vec3d aside = cross(up, ahead);

  // Towards the pole, but not over it. A camera that starts nearer to the pole may stay there.
  const Angle tilt = angle_of(degrees_of(dy_px, size));
  double new_across = across * tilt.cosine - height * tilt.sine;
  double new_height = height * tilt.cosine + across * tilt.sine;
  const double least = std::min(kLeastSine, across);
  if (new_across < least) {
    new_across = least;
    new_height = std::copysign(std::sqrt(1 - least * least), new_height);
  }

  // Around the pole: if the pointer moves to the right, the eye moves to the left.
  const Angle turn = angle_of(-degrees_of(dx_px, size));
  const Vec3d direction = normalized(new_height * up + new_across * (turn.cosine * ahead + turn.sine * aside));
  Camera moved = camera;
  moved.eye = camera.look_at + distance * direction;
  return if_good(moved, camera);
}

Camera panned(const Camera& camera, double dx_px, double dy_px, PictureSizePx size) {
  const Steps steps = steps_of(camera, size);
  const Vec3d shift = dx_px * steps.right + dy_px * steps.down;
  Camera moved = camera;
  moved.eye = camera.eye - shift;
  moved.look_at = camera.look_at - shift;
  return if_good(moved, camera);
}

Vec3d point_under(const Camera& camera, double x_px, double y_px, PictureSizePx size) {
  const Steps steps = steps_of(camera, size);
  return camera.look_at + (x_px - 0.5 * size.width) * steps.right + (y_px - 0.5 * size.height) * steps.down;
}

DistanceLimits distance_limits(const Camera& camera, double diagonal) {
  // A pixel at distance d is about d / 1000 wide, and an eye's coordinates have steps of 2^-24 relative.
  constexpr double kNearestByPlace = 1e-4;
  constexpr double kNearestBySize = 1e-5, kFarthestBySize = 1e4;
  const double place = std::max({std::abs(camera.look_at.x), std::abs(camera.look_at.y), std::abs(camera.look_at.z)});
  const double extent = diagonal > 0 ? diagonal : length(camera.look_at - camera.eye);
  return {std::max(kNearestBySize * extent, kNearestByPlace * place), kFarthestBySize * extent};
}

Camera zoomed(const Camera& camera, double factor, Vec3d anchor, DistanceLimits limits) {
  BIHIVE_CHECK(std::isfinite(factor) && factor > 0);
  const bool parallel = camera.projection == Projection::orthographic;
  const double distance = parallel ? camera.shorter_side : length(camera.look_at - camera.eye);

  // A camera beyond a limit goes no further, but may come back.
  if (factor > 1) factor = std::max(1.0, std::min(factor, distance / limits.nearest));
  if (factor < 1) factor = std::min(1.0, std::max(factor, distance / limits.farthest));
  if (factor == 1) return camera;
  Camera moved = camera;
  if (parallel) {
    // The eye's plane stays, so that it enters no sphere.
    const Vec3d forward = normalized(camera.look_at - camera.eye);
    const Vec3d offset = anchor - camera.look_at;
    const Vec3d shift = (1 - 1 / factor) * (offset - dot(offset, forward) * forward);
    moved.eye = camera.eye + shift;
    moved.look_at = camera.look_at + shift;
    moved.shorter_side = camera.shorter_side / factor;
    return if_good(moved, camera);
  }
  moved.eye = anchor + (camera.eye - anchor) / factor;
  moved.look_at = anchor + (camera.look_at - anchor) / factor;
  return if_good(moved, camera);
}

}  // namespace bihive
