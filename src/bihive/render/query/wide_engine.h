// The wide engine (wide/queries.h).
#pragma once

#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "bihive/render/query/ray_engine.h"

namespace bihive {

class WideEngine final : public RayEngine {
 public:
  explicit WideEngine(std::shared_ptr<const WideTree> tree) : tree_(std::move(tree)) {}

  Hit closest_hit(const Ray& ray) const override { return bihive::closest_hit(*tree_, ray); }
  bool occluded(const Ray& ray) const override { return bihive::occluded(*tree_, ray); }
  void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const override {
    bihive::closest_hits(*tree_, rays, order, hits);
  }
  void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const override {
    bihive::occluded(*tree_, rays, order, is_occluded);
  }
  void all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const override {
    // Most rays meet nothing, and that is quickly known. They get an end before their start.
    constexpr double kFarthest = std::numeric_limits<double>::infinity();
    static thread_local std::vector<std::uint8_t> meets;
    static thread_local std::vector<double> ends;
    meets.resize(static_cast<std::size_t>(rays.count));
    ends.resize(meets.size());
    occluded(rays, order, meets.data());
    for (std::size_t i = 0; i < ends.size(); ++i)
      ends[i] = meets[i] == 0 ? -kFarthest : rays.t_max != nullptr ? rays.t_max[i] : kFarthest;
    RaySpan here = rays;
    here.t_max = ends.data();
    bihive::all_hits(*tree_, here, found);
  }
  void optical_depths(const RaySpan& rays, RayOrder, const SphereDepths& depths, const DepthSums& sums) const override {
    bihive::optical_depths(*tree_, rays, depths, sums);
  }
  const WideTree* wide_tree() const override { return tree_.get(); }

 private:
  std::shared_ptr<const WideTree> tree_;
};

}  // namespace bihive
