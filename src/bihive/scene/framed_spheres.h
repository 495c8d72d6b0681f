// The spheres that a camera brings into view.
#pragma once

#include <optional>

#include "bihive/geometry/sphere_set.h"
#include "bihive/scene/clips.h"
#include "bihive/scene/scene.h"

namespace bihive {

/// RemainingSpheres, without those outside their central_box() if `share` is below 1. If no sphere is inside of the box
/// along all axes, all are framed. With a share of 1 also the balls at the ends of sticks that have ends of their own.
class FramedSpheres {
 public:
  /// The scene must outlive it.
  FramedSpheres(const Scene& scene, double share);
  const SphereSet& set() const { return part_ ? *part_ : remaining_.set(); }

 private:
  RemainingSpheres remaining_;
  std::optional<SphereSet> part_;
};

}  // namespace bihive
