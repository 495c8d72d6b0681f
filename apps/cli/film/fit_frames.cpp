#include "film/fit_frames.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/render/frame_picture.h"
#include "bihive/scene/framed_spheres.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/framing_cell.h"
#include "support/interrupt.h"

namespace bihive::cli {
namespace {

void widen_reach(ViewReach& reach, const ViewReach& other) {
  for (double ViewReach::*const end :
       {&ViewReach::across_low, &ViewReach::across_high, &ViewReach::along_low, &ViewReach::along_high,
        &ViewReach::left, &ViewReach::right, &ViewReach::below, &ViewReach::above, &ViewReach::front})
    reach.*end = std::max(reach.*end, other.*end);
}

}  // namespace

Camera camera_over_frames(const FrameSource& source, const FilmPlan& plan, const FilmOptions& options,
                          const Style& style, const Input& first, const RenderSettings& settings) {
  const FilmPlan::Fixed& fixed = plan.fixed;
  const double zoom = options.picture.zoom.value_or(1);
  const Camera before = enlarged(fixed.camera, 1 / zoom);
  const Side side{normalized(before.eye - before.look_at), before.up};
  const Framing framing{side,
                        {before.fov_deg, before.projection},
                        settings.width_px,
                        settings.height_px,
                        insets_of_labels(first.scene, before, settings),
                        middle_of(FramedSpheres(first.scene, settings.fit_share).set().bounds())};
  ViewReach reach;
  SphereSet::Bounds bounds = FramedSpheres(first.scene, settings.fit_share).set().bounds();
  Progress progress("the camera of all frames");
  for (std::int64_t k = 0; k < plan.asked.frames.count; ++k) {
    CancellableSection::leave_if_cancelled();
    const auto position = static_cast<std::size_t>(k);
    Input input = source.load(plan.asked.frames.frame(k), style);
    if (!fixed.motions.empty())
      if (const Status status = move_spheres(input.scene.spheres, fixed.motions[position]); !status)
        fail(status.error());
    look(input, options.picture.looks, {}, /*may_be_empty=*/true);
    // A camera that moves sees the spheres of a frame from where it then is.
    const Vec3d shift = fixed.shifts.empty() ? Vec3d{} : fixed.shifts[position];
    Framing here = framing;
    here.middle = here.middle + shift;
    const FramedSpheres framed(input.scene, settings.fit_share);
    const std::vector<Vec3d> corners = settings.cell_lines ? cell_corners(framed.set()) : std::vector<Vec3d>();
    widen_reach(reach, reach_in_view(framed.set(), corners, here));
    const SphereSet::Bounds own = framed.set().bounds();
    for (int axis = 0; axis < 3; ++axis) {
      bounds.lo[axis] = std::min(bounds.lo[axis], own.lo[axis] - shift[axis]);
      bounds.hi[axis] = std::max(bounds.hi[axis], own.hi[axis] - shift[axis]);
    }
    progress.update(static_cast<double>(k + 1) / static_cast<double>(plan.asked.frames.count));
  }
  Camera camera = enlarged(camera_for(framing, reach), zoom);
  // It looks at the middle of all frames rather than of the first one.
  camera.look_at = camera.look_at + dot(middle_of(bounds) - camera.look_at, side.back) * side.back;
  camera.aperture = before.aperture;
  if (options.picture.focus && std::holds_alternative<double>(*options.picture.focus)) camera.focus = before.focus;
  return camera;
}

}  // namespace bihive::cli
