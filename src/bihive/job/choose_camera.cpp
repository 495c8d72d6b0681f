#include "bihive/job/choose_camera.h"

#include <optional>
#include <string>
#include <variant>

#include "bihive/base/setting_name.h"
#include "bihive/job/best_side.h"
#include "bihive/job/failure.h"
#include "bihive/job/zoom_camera.h"
#include "bihive/render/frame_picture.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/focus.h"
#include "bihive/scene/principal_side.h"
#include "bihive/scene/wide_angle.h"

namespace bihive {
namespace {

bool parallel(Vec3d a, Vec3d b) {
  return length(cross(a, b)) <= 1e-9 * length(a) * length(b);
}

Vec3d target_of(const LookAt& wanted, const Scene& scene, const CameraSelections& selections) {
  if (const Vec3d* const point = std::get_if<Vec3d>(&wanted)) return *point;
  return middle_of(scene.spheres.part(selections.visible(scene, "look_at")).bounds());
}

// A camera that the user places is aimed at the centre of the set, unless the scene or the user states otherwise.
Camera placed(const Camera& before, const Input& input, const PictureRequest& request,
              const CameraSelections& selections, const WholeSet* whole) {
  Camera camera = before;
  const SphereSet::Bounds bounds = whole != nullptr ? whole->bounds : RemainingSpheres(input.scene).set().bounds();
  if (request.eye && !input.has_camera) camera.look_at = 0.5 * bounds.lo + 0.5 * bounds.hi;
  camera.eye = request.eye.value_or(camera.eye);
  if (request.look_at) camera.look_at = target_of(*request.look_at, input.scene, selections);
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

double focus_of(const Focus& wanted, const SphereSet& spheres, const Camera& camera) {
  if (const double* const distance = std::get_if<double>(&wanted)) return *distance;
  const Result<double> distance = focus_on(spheres, camera, std::get<std::string>(wanted));
  if (!distance) fail_setting("focus", ": " + distance.error().message, distance.error().hint);
  return *distance;
}

// The spheres of `fit` or `zoom_to`.
std::optional<SphereSet> spheres_to_fill(const Scene& scene, const PictureRequest& request,
                                         const CameraSelections& selections, const RenderSettings& settings) {
  if (!request.fit && !request.zoom_to) return std::nullopt;
  const std::string id = request.fit ? "fit" : "zoom_to";
  if (settings.view == View::tree)
    fail_setting(id, " is for pictures of spheres, and " + setting_name("view") + " tree is a drawing of the tree",
                 "leave one of them out");
  return scene.spheres.part(selections.visible(scene, id));
}

// The direction of view of a camera that is fitted.
Side side_for(const Scene& scene, const PictureRequest& request, const RenderSettings& settings,
              const CameraSelections& selections, const std::optional<SphereSet>& selected) {
  if (!request.view_of) return side_of(request.view_from.value_or(ViewFrom::front));
  if (!request.view_of->best_of.empty())
    return best_side(scene, selections.visible(scene, "view_from"), static_cast<int>(request.threads));
  const bool is_upright = settings.height_px > settings.width_px;
  return principal_side(selected ? *selected : RemainingSpheres(scene).set(), is_upright);
}

// The side with another up vector. If that is parallel to the direction of view, the view is tipped by 90 degrees: with
// z up, the front is seen along +y.
Side with_up(Side side, Vec3d up, bool side_is_given) {
  if (parallel(up, side.back)) {
    if (side_is_given)
      fail_setting("up", " is the direction of view",
                   "give another one, or turn the camera by " + setting_name("turn"));
    side.back = dot(up, side.back) > 0 ? -side.up : side.up;
  }
  side.up = up;
  return side;
}

}  // namespace

Camera choose_camera(const Input& input, const PictureRequest& request, const RenderSettings& settings,
                     const CameraSelections& selections, const WholeSet* whole) {
  Camera camera = input.scene.camera;
  camera.fov_deg = request.fov_deg.value_or(camera.fov_deg);
  const Projection projection = request.projection.value_or(camera.projection);
  const bool fitted = !input.has_camera || request.view_from || request.view_of || request.fit;
  // A direction that is up turns a camera that is fitted.
  const bool user_places = request.eye || request.look_at || (request.up && !fitted);
  if (request.picture.has("fit_share") && (!fitted || user_places || request.fit || settings.view == View::tree))
    fail_setting("fit_share", " is for a camera that bihive places over all spheres", "leave it out");
  const std::optional<SphereSet> selected = spheres_to_fill(input.scene, request, selections, settings);
  if (fitted) {
    // The fit uses the direction after the turn. A camera that the user places is turned below.
    Side side = side_for(input.scene, request, settings, selections, selected);
    if (request.up && !user_places) side = with_up(side, *request.up, request.view_from.has_value());
    if (request.turn && !user_places) side = turned(side, *request.turn);
    // With the user's own eye point, the angle decides how much is visible.
    if (!request.fov_deg && !user_places)
      camera.fov_deg = angle_for_picture(camera.fov_deg, settings.width_px, settings.height_px);
    const Lens lens{camera.fov_deg, request.eye ? Projection::perspective : projection};
    // An orthographic picture is the same from any distance; before all spheres nothing is cut open.
    const bool goes_near = request.fit && projection == Projection::perspective;
    camera = whole != nullptr ? whole->frame(input.scene, side, lens, settings)
             : goes_near      ? frame_selected(input.scene, *selected, side, lens, settings)
                              : frame_picture(input.scene, side, lens, settings);
    if (request.fit && !goes_near) camera = zoomed_to(input.scene, *selected, camera, settings);
  } else if (request.fov_deg) {
    camera.projection = Projection::perspective;
  }
  if (user_places) camera = placed(camera, input, request, selections, whole);
  refuse_bad(camera, request);
  camera = with_projection(camera, projection);
  if (request.turn && (user_places || !fitted)) camera = turned(camera, *request.turn);
  if (request.zoom_to) camera = zoomed_to(input.scene, *selected, camera, settings);
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
