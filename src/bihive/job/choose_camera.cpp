#include "bihive/job/choose_camera.h"

#include <algorithm>

#include "bihive/base/setting_name.h"
#include "bihive/job/failure.h"
#include "bihive/math/elementary.h"
#include "bihive/render/frame_picture.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/focus.h"

namespace bihive {
namespace {

bool parallel(Vec3d a, Vec3d b) {
  return length(cross(a, b)) <= 1e-9 * length(a) * length(b);
}

// A camera that the user places is aimed at the centre of the set, unless the scene or the user states otherwise.
Camera placed(const Camera& before, const Input& input, const PictureRequest& request, const WholeSet* whole) {
  Camera camera = before;
  const SphereSet::Bounds bounds = whole != nullptr ? whole->bounds : RemainingSpheres(input.scene).set().bounds();
  if (request.eye && !input.has_camera) camera.look_at = 0.5 * bounds.lo + 0.5 * bounds.hi;
  camera.eye = request.eye.value_or(camera.eye);
  camera.look_at = request.look_at.value_or(camera.look_at);
  const Vec3d view = camera.look_at - camera.eye;
  if (request.up)
    camera.up = *request.up;
  else if (parallel(camera.up, view))
    camera.up = parallel({0, 1, 0}, view) ? Vec3d{0, 0, -1} : Vec3d{0, 1, 0};
  return camera;
}

// A camera that shows everything under a tiny angle is too far away for single precision.
void refuse_bad(const Camera& camera, const PictureRequest& request) {
  constexpr double kTinyAngle = 1e-3;
  const Status status = check_camera(camera);
  if (status) return;
  if (request.fov_deg && *request.fov_deg < kTinyAngle && !request.eye)
    fail_setting("fov", ": with such a small angle the camera would be too far away", "choose a larger angle");
  fail_usage(status.error().message, status.error().hint);
}

// Wide pictures have a smaller angle than usual: with 60 degrees along the longer side, spheres at its ends look 15 %
// too wide (1 / cos 30).
double angle_for_wide_pictures(double fov_deg, const RenderSettings& settings) {
  constexpr double kMostDeg = 60;
  const auto [shorter, longer] = std::minmax(settings.width_px, settings.height_px);
  return std::min(fov_deg, 2 * atan_deg(tan_deg(kMostDeg / 2) * shorter / longer));
}

double focus_of(const Focus& wanted, const SphereSet& spheres, const Camera& camera) {
  if (const double* const distance = std::get_if<double>(&wanted)) return *distance;
  const Result<double> distance = focus_on(spheres, camera, std::get<std::string>(wanted));
  if (!distance) fail_setting("focus", ": " + distance.error().message, distance.error().hint);
  return *distance;
}

}  // namespace

Camera choose_camera(const Input& input, const PictureRequest& request, const RenderSettings& settings,
                     const WholeSet* whole) {
  const bool user_places = request.eye || request.look_at || request.up;
  Camera camera = input.scene.camera;
  camera.fov_deg = request.fov_deg.value_or(camera.fov_deg);
  const Projection projection = request.projection.value_or(camera.projection);
  const bool fitted = !input.has_camera || request.view_from;
  if (fitted) {
    // The fit uses the direction after the turn. A camera that the user places is turned below.
    Side side = side_of(request.view_from.value_or(ViewFrom::front));
    if (request.turn && !user_places) side = turned(side, *request.turn);
    // With the user's own eye point, the angle decides how much is visible.
    if (!request.fov_deg && !user_places) camera.fov_deg = angle_for_wide_pictures(camera.fov_deg, settings);
    const Lens lens{camera.fov_deg, request.eye ? Projection::perspective : projection};
    camera = whole != nullptr ? whole->frame(input.scene, side, lens, settings)
                              : frame_picture(input.scene, side, lens, settings);
  } else if (request.fov_deg) {
    camera.projection = Projection::perspective;
  }
  if (user_places) camera = placed(camera, input, request, whole);
  refuse_bad(camera, request);
  camera = with_projection(camera, projection);
  if (request.turn && (user_places || !fitted)) camera = turned(camera, *request.turn);
  camera = enlarged(camera, request.zoom.value_or(1));
  camera.aperture = request.aperture.value_or(input.scene.camera.aperture);
  camera.focus = request.focus ? focus_of(*request.focus, input.scene.spheres, camera) : input.scene.camera.focus;
  if (request.focus && camera.aperture == 0)
    fail_setting("focus", " changes nothing without an aperture",
                 "give the radius of the lens by " + setting_name("aperture"));
  refuse_bad(camera, request);
  return camera;
}

}  // namespace bihive
