// The walls of cavities (measure/cavity_walls.h) in place of whole spheres.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/geometry/scaled_ray.h"
#include "bihive/measure/cavity_walls.h"
#include "bihive/render/query/ray_engine.h"

namespace bihive {

/// A decorator: of the union of spheres in which the engine below traces rays, the points where a ray comes out into a
/// cavity, on the inner side of a sphere, and where it goes on into a sphere again. So cavities are seen as bodies.
/// The ids are those of the spheres that line cavities, from 0 on.
///
/// The points are roots of geometry/sphere.h, between which the ray is in no sphere; CavityWalls says which of them lie
/// on a wall. What lies in a cavity without touching its wall is not seen. all_hits() has each sphere once, at its
/// first point.
class CavityEngine final : public RayEngine {
 public:
  /// `of_union`: on walls->spheres().
  CavityEngine(std::shared_ptr<const CavityWalls> walls, std::shared_ptr<const RayEngine> of_union);

  Hit closest_hit(const Ray& ray) const override;
  bool occluded(const Ray& ray) const override;
  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const override;
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const override;
  void all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const override;

 private:
  std::shared_ptr<const CavityWalls> walls_;
  std::shared_ptr<const RayEngine> of_union_;
  std::vector<std::int64_t> of_union_id_;  // of each lining sphere
  std::vector<std::int64_t> lining_id_;    // of each sphere of the union; kNothing: it lines no cavity

  // Calls use(ray, t, id) for all points of each ray's segment, by ray, then along it; false ends the ray.
  template <class Use>
  void each_point(const RaySpan& rays, RayOrder order, const Use& use) const;
  template <class Use>
  void points_of(const Ray& ray, const RayHit* first, const RayHit* last, const Use& use) const;
  bool is_wall(const ScaledRay& ray, double t, std::int64_t id) const;
};

}  // namespace bihive
