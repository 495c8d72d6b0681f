// The engines without a tree: every sphere, one after the other.
#pragma once

#include "bihive/render/query/brute_force.h"
#include "bihive/render/query/ray_engine.h"
#include "bihive/render/query/wide_brute_force.h"

namespace bihive {

/// Engine::brute, and with kWide Engine::wide_brute: spans of rays on vectors. Flattened, as ReferenceEngine is.
template <bool kWide>
class BruteEngine final : public OneByOne<BruteEngine<kWide>> {
 public:
  /// The spheres must outlive it.
  explicit BruteEngine(const SphereSet& spheres) : spheres_(spheres) {}

  [[gnu::flatten]] Hit closest_hit(const Ray& ray) const override { return bihive::closest_hit(spheres_, ray); }
  [[gnu::flatten]] bool occluded(const Ray& ray) const override { return bihive::occluded(spheres_, ray); }
  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const override {
    if (!kWide) return OneByOne<BruteEngine>::closest_hits(rays, order, hits);
    wide_brute_hits(spheres_, rays, hits);
  }
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const override {
    if (!kWide) return OneByOne<BruteEngine>::occluded(rays, order, is_occluded);
    wide_brute_occluded(spheres_, rays, is_occluded);
  }
  void find_all(const Ray& ray, AllHits& all) const {
    const ScaledRay scaled(ray, spheres_);
    for (std::int64_t id = 0; id < spheres_.total_size(); ++id)
      all.take(sphere_hit(scaled, spheres_.stored_centre(id), spheres_.stored_radius(id)), id);
  }

 private:
  const SphereSet& spheres_;
};

}  // namespace bihive
