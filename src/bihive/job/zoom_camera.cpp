#include "bihive/job/zoom_camera.h"

#include <algorithm>
#include <limits>

#include "bihive/base/setting_name.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/job/failure.h"
#include "bihive/math/elementary.h"
#include "bihive/render/frame_picture.h"
#include "bihive/scene/framing.h"

namespace bihive {
namespace {

constexpr double kSmallestAngleDeg = 1e-3, kLargestAngleDeg = 170;
constexpr int kHalvings = 48;  // of the interval of angles

// The end of the spheres along a direction.
double front_of(const SphereSet& spheres, Vec3d direction) {
  double front = -std::numeric_limits<double>::infinity();
  for (std::int64_t id = 0; id < spheres.total_size(); ++id)
    front = std::max(front, dot(spheres.centre(id), direction) + spheres.radius(id));
  return front;
}

}  // namespace

Camera zoomed_to(const Scene& scene, const SphereSet& selected, const Camera& before, const RenderSettings& settings) {
  const Vec3d back = normalized(before.eye - before.look_at);
  const Side side{back, before.up};
  const double plane = dot(before.eye, back);
  const auto framed = [&](double fov_deg) {
    return frame_selected(scene, selected, side, {fov_deg, before.projection}, settings);
  };
  if (before.projection == Projection::orthographic) {
    Camera camera = framed(before.fov_deg);
    camera.eye = camera.eye + std::max(0.0, plane - dot(camera.eye, back)) * back;
    return camera;
  }

  // The smaller the angle, the farther away is the camera that frames the spheres: search the angle for which it stands
  // in the plane of the eye.
  const auto is_too_near = [&](const Camera& camera) { return dot(camera.eye, back) < plane; };
  Camera camera = framed(kLargestAngleDeg);
  if (!(plane > front_of(selected, back)) || !is_too_near(camera))
    fail_setting("zoom_to", ": the camera is not in front of all spheres of the selection",
                 setting_name("fit") + " goes to where it sees them all");
  double low = tan_deg(kSmallestAngleDeg / 2), high = tan_deg(kLargestAngleDeg / 2);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = std::sqrt(low * high);
    camera = framed(2 * atan_deg(middle));
    (is_too_near(camera) ? high : low) = middle;
  }
  camera = framed(2 * atan_deg(high));
  camera.eye = camera.eye + (plane - dot(camera.eye, back)) * back;
  return camera;
}

}  // namespace bihive
