#include "bihive/wide/schedule/core_rays.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "bihive/geometry/scaled_ray.h"

namespace bihive::wide {

// A hit in geometry/sphere.h lies within 2^-49 of the origin's distance of its sphere, and the point computed here
// within as much of the segment's point that is closest to the core's centre (docs/precision.md, "Enclosed spheres").
// The distance is at most sqrt(3) times `farthest`. 2^-44 is more than all of it.
bool may_reach_core(const WideTree& tree, const Ray& ray, double t_end) {
  if (!is_valid(ray)) return false;
  const ScaledRay scaled(ray, tree.scale);
  const Vec3d from = scaled.origin;
  const double farthest = std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z)}) + 2.0;
  const double pad = 0x1p-44 * farthest;
  const double end = std::min(t_end, scaled.t_max);
  for (const Core& core : tree.cores) {
    // Find the segment's point that is closest to the centre. A NaN counts as close.
    const Vec3d to_centre = core.centre - from;
    const double t = dot(to_centre, scaled.direction) / scaled.direction_squared;
    const Vec3d apart = to_centre - std::max(scaled.t_min, std::min(t, end)) * scaled.direction;
    const double reach = core.radius + pad;
    if (!(dot(apart, apart) > reach * reach)) return true;
  }
  return false;
}

RemainingRays rays_to_cores(const WideTree& tree, const RaySpan& rays, const double* ends,
                            const std::uint8_t* skipped) {
  RemainingRays found;
  for (std::int64_t i = 0; i < rays.count; ++i) {
    if (skipped != nullptr && skipped[i] != 0) continue;
    const double end = ends != nullptr ? ends[i] : std::numeric_limits<double>::infinity();
    if (may_reach_core(tree, rays.at(i), end)) found.add(i, 1);
  }
  return found;
}

}  // namespace bihive::wide
