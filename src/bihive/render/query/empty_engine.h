// An engine without spheres, for the sticks that stand alone in their part of a set.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/render/query/ray_engine.h"

namespace bihive {

class EmptyEngine final : public RayEngine {
 public:
  Hit closest_hit(const Ray&) const override { return {}; }
  bool occluded(const Ray&) const override { return false; }
  void closest_hits(const RaySpan& rays, RayOrder, const HitSpan& hits) const override {
    std::fill_n(hits.t, rays.count, std::numeric_limits<double>::infinity());
    std::fill_n(hits.sphere_id, rays.count, kNothing);
  }
  void occluded(const RaySpan& rays, RayOrder, std::uint8_t* is_occluded) const override {
    std::fill_n(is_occluded, rays.count, std::uint8_t{0});
  }
  void all_hits(const RaySpan&, RayOrder, std::vector<RayHit>& found) const override { found.clear(); }
  void optical_depths(const RaySpan& rays, RayOrder, const SphereDepths& depths, const DepthSums& sums) const override {
    sums.clear(rays.count, depths.columns);
  }
};

}  // namespace bihive
