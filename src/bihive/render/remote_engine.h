// Answers to rays from spheres that are not in this process's tree: other processes hold them (spread/).
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/geometry/ray.h"
#include "bihive/wide/queries.h"

namespace bihive {

/// Which of the spheres a query is for: all of them, or a part of scene's set as OpacityRule::once divides it
/// (render/transparency.h).
enum class WhichSpheres : std::uint8_t { all, opaque_to_eye, opaque_to_light, clear_to_eye, clear_to_light };

/// The set of the scene that such a tracer belongs to holds the spheres that were seen so far, and some that stand for
/// the rest (spread/seen_spheres.h). A query may add spheres to it, which get the next ids. So one thread at a time
/// works with the scene, its tracer and this object. Answers as those of Tracer; of equal t the sphere wins that has
/// the smaller id in the whole set.
class RemoteEngine {
 public:
  virtual ~RemoteEngine() = default;
  virtual void closest_hits(WhichSpheres which, const RaySpan& rays, RayOrder order, const HitSpan& hits) = 0;
  virtual void occluded(WhichSpheres which, const RaySpan& rays, RayOrder order, std::uint8_t* hidden) = 0;
  /// By ray, then by t, then by the id in the whole set.
  virtual void all_hits(WhichSpheres which, const RaySpan& rays, RayOrder order, std::vector<RayHit>& found) = 0;
};

}  // namespace bihive
