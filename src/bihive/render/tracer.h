// One interface to every engine that answers ray queries on a sphere set.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bihive/base/result.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/tree.h"
#include "bihive/geometry/hit.h"
#include "bihive/geometry/ray.h"
#include "bihive/geometry/sphere_set.h"

namespace bihive {

/// automatic: the fastest engine that there is; reference: scalar traversal of the reference tree; brute: every sphere.
/// All give the same bits.
enum class Engine { automatic, reference, brute };

/// Holds the structure that an engine needs, and refers to the spheres, which must outlive it. Queries are const and
/// may be made from any number of threads. An invalid ray (geometry/ray.h) hits nothing.
class Tracer {
 public:
  /// Builds what the engine needs. Parameters must be >= 1.
  Tracer(const SphereSet& spheres, Engine engine, const BuildParameters& parameters);

  Hit closest_hit(const Ray& ray) const;
  bool occluded(const Ray& ray) const;

  Engine engine() const { return engine_; }  ///< never `automatic`
  const SphereSet& spheres() const { return *spheres_; }
  const Tree* tree() const { return tree_ ? &*tree_ : nullptr; }  ///< null for brute
  double build_ms() const { return build_ms_; }

 private:
  const SphereSet* spheres_;
  Engine engine_;
  std::optional<Tree> tree_;
  double build_ms_ = 0;
};

}  // namespace bihive
