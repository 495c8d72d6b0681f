// Why one ray is slow: the nodes and spheres on its way through each structure.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/bih/tree.h"
#include "bihive/compare/structure.h"
#include "bihive/wide/wide_tree.h"

namespace bihive::workbench {

/// The way of one ray through one structure.
struct StructurePath {
  const char* name;  ///< the structure's
  RayPath steps;
  Work work;

  Hit hit() const { return steps.empty() ? Hit{} : steps.back().best; }
};

/// Builds each structure (names without repetition; empty: all) and takes the ray through it, for its closest hit.
/// Errors: an unknown structure, or one that cannot be built.
Result<std::vector<StructurePath>> paths_of_ray(const SphereSet& spheres, const std::vector<std::string>& names,
                                                const Ray& ray, int threads);

/// The same through trees that exist: those of "wide" and "bih", built from these spheres.
StructurePath path_of_ray(const SphereSet& spheres, const WideTree& tree, const Ray& ray);
StructurePath path_of_ray(const SphereSet& spheres, const Tree& tree, const Ray& ray);

}  // namespace bihive::workbench
