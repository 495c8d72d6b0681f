#include "bihive/scene/floor.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "bihive/scene/clips.h"

namespace bihive {

Plane plane_below(const Scene& scene, Vec3d up) {
  double lowest = std::numeric_limits<double>::infinity();
  const RemainingSpheres remaining(scene);
  const SphereSet& spheres = remaining.set();
  const StickSet& sticks = scene.sticks;
  for (std::int64_t id = 0; id < spheres.total_size(); ++id)
    if (spheres.radius(id) > 0 || sticks.own_count() == 0)  // tubes are seen instead
      lowest = std::min(lowest, dot(up, spheres.centre(id)) - spheres.radius(id));
  for (std::int64_t stick = 0; stick < sticks.total_size(scene.spheres); ++stick) {
    if (!sticks.has_own_ends(stick)) continue;
    const Stick stored = sticks.stored(scene.spheres, stick);
    for (const auto& [end, radius] : {std::pair(stored.a, stored.radius_a), std::pair(stored.b, stored.radius_b)})
      lowest = std::min(lowest, dot(up, scene.spheres.in_world(scene.spheres.inverse_scale() * end)) -
                                    scene.spheres.inverse_scale() * radius);
  }
  return {(spheres.empty() ? 0 : lowest) * up, up};
}

ScenePlane floor_in(const Plane& plane, const std::optional<Vec3d>& colour, const Scene& scene) {
  ScenePlane floor;
  floor.plane = plane;
  floor.material = scene.materials.front();
  floor.material.transmissive = 0;
  floor.shadows_only = !colour;
  if (colour) {
    floor.material.colour = *colour;
    return floor;
  }
  const bool is_lit = floor.material.diffuse > 0 || floor.material.ambient > 0;
  if (!is_lit) floor.material = matte_material();
  return floor;
}

}  // namespace bihive
