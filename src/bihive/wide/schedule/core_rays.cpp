#include "bihive/wide/schedule/core_rays.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/wide/trace/scalar_walk.h"

namespace bihive::wide {

namespace {

// Up to this many cores are compared one after the other, more by a tree.
constexpr std::size_t kFewCores = 8;

// The part of a ray that may come to a core.
//
// A hit in geometry/sphere.h may be 49 u F beyond its sphere, and the distance computed here may be 40 u F too large
// (docs/precision.md, "Enclosed spheres"). 2^-44 F is 512 u F.
class Approach {
 public:
  Approach(const Ray& ray, double scale, double t_end) : ray_(ray, scale), end_(std::min(t_end, ray_.t_max)) {
    const Vec3d from = ray_.origin;
    pad_ = 0x1p-44 * (std::max({std::abs(from.x), std::abs(from.y), std::abs(from.z)}) + 2.0);
  }

  bool reaches(const Core& core) const {
    // Find the segment's point that is closest to the centre. A NaN counts as close.
    const Vec3d to_centre = core.centre - ray_.origin;
    const double t = dot(to_centre, ray_.direction) / ray_.direction_squared;
    const Vec3d apart = to_centre - std::max(ray_.t_min, std::min(t, end_)) * ray_.direction;
    const double reach = core.radius + pad_;
    return !(dot(apart, apart) > reach * reach);
  }

  // Boxes of the enclosing spheres hold the cores.
  bool reaches_one_in(const OuterTree& outer) const {
    struct Test {
      const Approach& ray;
      const OuterTree& outer;
      bool reached = false;

      double limit() const { return ray.end_; }
      bool operator()(std::int64_t slot) {
        reached = ray.reaches(outer.cores[static_cast<std::size_t>(outer.around_cores.spheres.id(slot))]);
        return reached;
      }
    };
    Test test{*this, outer};
    walk_leaves(outer.around_cores, Slabs(ray_, pad_), ray_.t_min, end_, test);
    return test.reached;
  }

 private:
  ScaledRay ray_;
  double end_, pad_;
};

}  // namespace

bool may_reach_core(const WideTree& tree, const Ray& ray, double t_end) {
  if (!is_valid(ray)) return false;
  const OuterTree& outer = *tree.outer;
  const Approach approach(ray, tree.scale, t_end);
  if (outer.cores.size() > kFewCores) return approach.reaches_one_in(outer);
  return std::any_of(outer.cores.begin(), outer.cores.end(), [&](const Core& core) { return approach.reaches(core); });
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
