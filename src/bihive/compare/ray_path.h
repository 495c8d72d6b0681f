// Why one ray is slow: the nodes and spheres on its way through each structure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/compare/structure.h"
#include "bihive/scene/scene.h"

namespace bihive::workbench {

/// The way of one ray through one structure.
struct StructurePath {
  StructureRow row;
  RayPath steps;
  Work work;

  Hit hit() const { return steps.empty() ? Hit{} : steps.back().best; }
};

/// Builds each structure (names without repetition; empty: all) and takes the ray through it, for its closest hit.
/// Errors: an unknown structure, or one that cannot be built.
Result<std::vector<StructurePath>> paths_of_ray(const SphereSet& spheres, const std::vector<std::string>& names,
                                                const Ray& ray, int threads);

}  // namespace bihive::workbench
