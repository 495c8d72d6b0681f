// Where rays enter unions of overlapping bodies: OpacityRule::as_one.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "bihive/geometry/cut_sphere.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/geometry/stick_set.h"
#include "bihive/render/query/ray_engine.h"

namespace bihive {

/// Spheres and sticks with an engine of some of them, in classes. All must outlive it.
struct UnionOfBodies {
  const RayEngine* engine;
  const SphereSet* spheres;
  const StickSet* sticks;  ///< null: there are none
  const CutSet* cuts;      ///< null: all are whole

  /// The bodies of each class, by their ids, are a union, and a ray may enter it several times. Of each time the first
  /// body that it enters, at the t of all_hits(); if it starts inside, where it exits the union, and the body that it
  /// exits last. Of equal t the smaller id. Hits in the segment alone: by ray, then by class, then by t. Bodies that
  /// touch overlap.
  void find_entries(const RaySpan& rays, RayOrder order, const std::function<int(std::int64_t)>& class_of,
                    std::vector<RayHit>& entries) const;
};

}  // namespace bihive
