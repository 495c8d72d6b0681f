// The engine that answers rays on a set, with all that decorates it.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/render/query/ray_engine.h"
#include "bihive/render/tracer.h"

namespace bihive {

class CutSet;

struct EngineParameters {
  EngineParameters(Engine wanted, const TreeParameters& of_tree = {},  // NOLINT(google-explicit-constructor)
                   int on_threads = 0)
      : engine(wanted == Engine::automatic ? Engine::wide : wanted), tree(of_tree), threads(on_threads) {}

  Engine engine;  ///< never `automatic`
  TreeParameters tree;
  int threads;
};

/// Of all spheres of a set, which must outlive it. Errors: as Tracer::build().
Result<std::shared_ptr<const RayEngine>> build_engine(const SphereSet& spheres, const EngineParameters& parameters);

/// Of the spheres `ids` of a set, ascending, under their ids in the whole set. `cuts`: of the whole set; null: all
/// spheres are whole. A set with images must have none.
Result<std::shared_ptr<const RayEngine>> build_engine(const SphereSet& whole, std::vector<std::int64_t> ids,
                                                      std::shared_ptr<const CutSet> cuts,
                                                      const EngineParameters& parameters);

}  // namespace bihive
