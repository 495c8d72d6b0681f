// Where rays enter the union of overlapping bodies: OpacityRule::as_one.
#pragma once

#include <vector>

#include "bihive/geometry/cut_sphere.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/geometry/stick_set.h"
#include "bihive/render/query/ray_engine.h"

namespace bihive {

/// Spheres and sticks with an engine of some of them. All must outlive it.
struct UnionOfBodies {
  const RayEngine* engine;
  const SphereSet* spheres;
  const StickSet* sticks;  ///< null: there are none
  const CutSet* cuts;      ///< null: all are whole

  /// A ray may enter the union several times. Of each time the first body that it enters, at the t of all_hits(); if it
  /// starts inside, where it exits the union, and the body that it exits last. Of equal t the smaller id. Hits in the
  /// segment alone, in the order of all_hits(). Bodies that touch overlap.
  void find_entries(const RaySpan& rays, RayOrder order, std::vector<RayHit>& entries) const;
};

}  // namespace bihive
