#include "film/turning_camera.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "bihive/job/failure.h"
#include "bihive/render/frame_picture.h"
#include "bihive/render/stereo.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/framing.h"
#include "bihive/scene/framing_cell.h"

namespace bihive::cli {
namespace {

std::vector<Vec3d> corners_of_cell(const SphereSet& spheres, const RenderSettings& settings) {
  return settings.cell_lines ? cell_corners(spheres) : std::vector<Vec3d>();
}

}  // namespace

Camera camera_around(const Input& input, const Camera& camera, const RenderOptions& options,
                     const RenderSettings& whole) {
  const RenderSettings settings = one_view(whole);
  // The ball around the centre of all bounds that contains everything.
  const RemainingSpheres remaining(input.scene);
  const SphereSet::Bounds bounds = remaining.set().bounds();
  Vec3d lo = bounds.lo, hi = bounds.hi;
  const std::vector<Vec3d> corners = corners_of_cell(remaining.set(), settings);
  for (const Vec3d corner : corners)
    for (int axis = 0; axis < 3; ++axis) {
      lo[axis] = std::min(lo[axis], corner[axis]);
      hi[axis] = std::max(hi[axis], corner[axis]);
    }
  const Vec3d middle = 0.5 * lo + 0.5 * hi;
  double radius = 0;
  const SphereSet& spheres = remaining.set();
  for (std::int64_t id = 0; id < spheres.total_size(); ++id)
    radius = std::max(radius, length(spheres.centre(id) - middle) + spheres.radius(spheres.stored_id(id)));
  for (const Vec3d corner : corners) radius = std::max(radius, length(corner - middle));
  const auto one = [](double value) { return std::vector<double>{value}; };
  const Vec3d local = spheres.to_local(middle);
  const SphereSet ball =
      value_or_fail(SphereSet::from_local(one(local.x), one(local.y), one(local.z), one(radius), spheres.origin()));

  // The camera that shows the ball, in the direction of the other one.
  const Vec3d offset = camera.eye - camera.look_at;
  const Side side{offset / length(offset), camera.up};
  const double fov_deg = options.fov_deg.value_or(input.scene.camera.fov_deg);
  const Insets insets = insets_of_labels(input.scene, camera, settings);
  Camera around =
      frame_spheres(ball, side, {fov_deg, camera.projection}, settings.width_px, settings.height_px, insets);
  around = enlarged(around, options.zoom.value_or(1));
  around.aperture = camera.aperture;
  if (options.focus && std::holds_alternative<double>(*options.focus)) around.focus = camera.focus;
  return around;
}

}  // namespace bihive::cli
