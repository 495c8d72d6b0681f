#include "bihive/scene/focus.h"

#include <cstdint>
#include <vector>

#include "bihive/geometry/each_sphere.h"
#include "bihive/select/selection.h"

namespace bihive {

Result<double> focus_on(const SphereSet& spheres, const Camera& camera, const std::string& selection) {
  const Result<std::vector<std::uint8_t>> mask = select_spheres(spheres, selection);
  if (!mask) return mask.error();
  const Vec3d forward = normalized(camera.look_at - camera.eye);
  double sum = 0, count = 0;
  for_each_sphere(spheres, [&](std::int64_t id, Vec3d centre, double) {
    if ((*mask)[static_cast<std::size_t>(spheres.stored_id(id))] == 0) return;
    sum += dot(centre - camera.eye, forward);
    count += 1;
  });
  if (count == 0) return Error{"the selection matches no sphere", "", 0, 0, "see bihive select"};
  if (!(sum / count > 0)) return Error{"the selected spheres are not in front of the camera", "", 0, 0, ""};
  return sum / count;
}

}  // namespace bihive
