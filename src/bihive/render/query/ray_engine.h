// The interface of all engines: rays against spheres. An engine holds spheres, or asks other engines (a decorator).
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "bihive/bih/tree.h"
#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/wide/optical_depths.h"
#include "bihive/wide/queries.h"

namespace bihive {

/// All engines give the same bits. Queries are const, and any number of threads may call them at a time, except where
/// other processes are asked (remote_rays.h). An invalid ray (geometry/ray.h) hits nothing.
class RayEngine {
 public:
  RayEngine() = default;
  RayEngine(const RayEngine&) = delete;
  RayEngine& operator=(const RayEngine&) = delete;
  virtual ~RayEngine() = default;

  /// One ray: the nearest hit, and whether there is any hit.
  virtual Hit closest_hit(const Ray& ray) const = 0;
  virtual bool occluded(const Ray& ray) const = 0;

  /// Many rays. Hit i belongs to ray i; is_occluded[i] is 1 or 0.
  virtual void closest_hits(const RaySpan& rays, RayOrder order, const HitSpan& hits) const = 0;
  virtual void occluded(const RaySpan& rays, RayOrder order, std::uint8_t* is_occluded) const = 0;
  /// Each sphere that a ray's segment meets, at its t of a query for the closest hit: by ray, then by t, then by id.
  virtual void all_hits(const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) const = 0;

  /// The sums of wide/optical_depths.h: those of the spheres of all_hits().
  virtual void optical_depths(const RaySpan& rays, RayOrder order, const SphereDepths& depths,
                              const DepthSums& sums) const {
    static thread_local std::vector<RayHit> found;
    all_hits(rays, order, found);
    sums.clear(rays.count, depths.columns);
    for (const RayHit& hit : found) sums.add(hit.ray, depths.row(hit.sphere_id), depths.columns);
  }

  /// The tree of all spheres (of the stored ones, where there are images). Null: the engine has no such tree.
  virtual const Tree* tree() const { return nullptr; }
  virtual const WideTree* wide_tree() const { return nullptr; }
};

/// The answer of a traversal (bih/traversal.h) that collects all hits of one ray.
struct AllHits {
  std::int64_t ray;
  std::vector<RayHit>& found;

  bool take(double t, std::int64_t id) const {
    if (t < limit()) found.push_back({ray, t, id});
    return false;
  }
  static constexpr double limit() { return std::numeric_limits<double>::infinity(); }
};

/// Puts hits from number `first` on into the order of all_hits().
inline void sort_hits(std::vector<RayHit>& found, std::size_t first = 0) {
  std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), [](const RayHit& a, const RayHit& b) {
    if (a.ray != b.ray) return a.ray < b.ray;
    return a.t != b.t ? a.t < b.t : a.sphere_id < b.sphere_id;
  });
}

/// The spans of an engine that answers one ray after the other. Self::find_all(ray, answer) calls answer.take() for
/// each sphere that a valid ray may meet.
template <class Self>
class OneByOne : public RayEngine {
 public:
  using RayEngine::occluded;
  void closest_hits(const RaySpan& rays, RayOrder, const HitSpan& hits) const override {
    for (std::int64_t i = 0; i < rays.count; ++i) {
      const Hit hit = self().closest_hit(rays.at(i));
      hits.t[i] = hit.t;
      hits.sphere_id[i] = hit.sphere_id;
    }
  }
  void occluded(const RaySpan& rays, RayOrder, std::uint8_t* is_occluded) const override {
    for (std::int64_t i = 0; i < rays.count; ++i) is_occluded[i] = self().occluded(rays.at(i)) ? 1 : 0;
  }
  void all_hits(const RaySpan& rays, RayOrder, std::vector<RayHit>& found) const override {
    found.clear();
    for (std::int64_t i = 0; i < rays.count; ++i) {
      const std::size_t first = found.size();
      AllHits all{i, found};
      if (const Ray ray = rays.at(i); is_valid(ray)) self().find_all(ray, all);
      sort_hits(found, first);
    }
  }

 private:
  const Self& self() const { return static_cast<const Self&>(*this); }
};

}  // namespace bihive
