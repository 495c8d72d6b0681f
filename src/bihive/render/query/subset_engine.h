// Some spheres of a set, with the ids of the whole set.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/geometry/cut_sphere.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/render/query/ray_engine.h"

namespace bihive {

/// Some spheres of a set as a set with ids of its own.
class Subset {
 public:
  /// `ids`: in the whole set, ascending.
  Subset(const SphereSet& whole, std::vector<std::int64_t> ids);

  const SphereSet& spheres() const { return spheres_; }
  const std::int64_t* whole_ids() const { return ids_.data(); }
  std::int64_t whole_id(std::int64_t id) const { return ids_[static_cast<std::size_t>(id)]; }
  /// A sphere here that equals a sphere of the whole set, or kNothing: a ray that exits one of them exits all
  /// (geometry/scaled_ray.h).
  std::int64_t equal_of(std::int64_t whole_id) const {
    const bool is_sphere = whole_id >= 0 && whole_id < static_cast<std::int64_t>(equal_.size());
    return is_sphere ? equal_[static_cast<std::size_t>(whole_id)] : kNothing;
  }
  /// The same where a ray exits a cut sphere: its ball may have an equal here, and a round cap a ball that fills it.
  std::int64_t equal_of(const CutRay& entered) const;

 private:
  std::int64_t find(Vec3d stored_centre, double stored_radius) const;

  SphereSet spheres_;
  std::vector<std::int64_t> ids_;
  std::vector<std::int64_t> equal_;     // of each sphere of the whole set
  std::vector<std::int64_t> by_place_;  // the spheres here, ordered by centre and radius
};

/// A decorator: translates ids for an engine of the subset's own set.
class SubsetEngine final : public RayEngine {
 public:
  /// `subset` lives as long as the engine. `cuts`: rays may exit spheres that clips cut; null: all spheres are whole.
  SubsetEngine(std::shared_ptr<const Subset> subset, std::shared_ptr<const RayEngine> of_subset,
               std::shared_ptr<const CutSet> cuts);

  Hit closest_hit(const Ray& ray) const override;
  bool occluded(const Ray& ray) const override;
  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const override;
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const override;
  void all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const override;
  void optical_depths(const RaySpan& rays, RayOrder order, const SphereDepths& depths,
                      const DepthSums& sums) const override;

 private:
  // The rays as the subset sees them: they may exit one of its spheres. The span holds until the thread's next call.
  Ray translated(const Ray& ray) const;
  RaySpan translated(const RaySpan& rays) const;

  std::shared_ptr<const Subset> subset_;
  std::shared_ptr<const RayEngine> of_subset_;
  std::shared_ptr<const CutSet> cuts_;
};

}  // namespace bihive
