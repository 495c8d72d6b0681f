// An engine that asks other processes (render/remote_engine.h) about some of the spheres.
#pragma once

#include <vector>

#include "bihive/base/check.h"
#include "bihive/render/query/ray_engine.h"
#include "bihive/render/remote_engine.h"

namespace bihive {

/// A ray of its own, for engines that take many at a time.
inline RayBatch one_ray(const Ray& ray) {
  RayBatch batch;
  batch.push_back(ray);
  return batch;
}

/// One thread at a time may use it.
class RemoteRays final : public RayEngine {
 public:
  /// `remote` must outlive it.
  RemoteRays(RemoteEngine* remote, WhichSpheres which) : remote_(remote), which_(which) {
    BIHIVE_CHECK(remote != nullptr);
  }

  Hit closest_hit(const Ray& ray) const override {
    Hit hit;
    closest_hits(one_ray(ray).span(), RayOrder::any, {&hit.t, &hit.sphere_id});
    return hit;
  }
  bool occluded(const Ray& ray) const override {
    std::uint8_t is_occluded = 0;
    occluded(one_ray(ray).span(), RayOrder::any, &is_occluded);
    return is_occluded != 0;
  }
  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const override {
    remote_->closest_hits(which_, rays, order, hits);
  }
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const override {
    remote_->occluded(which_, rays, order, is_occluded);
  }
  void all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const override {
    remote_->all_hits(which_, rays, order, found);
  }

 private:
  RemoteEngine* remote_;
  WhichSpheres which_;
};

}  // namespace bihive
