// Predicts the memory of an engine's tree before it is built (bih/memory.h, wide/wide_builder.h).
#pragma once

#include <cstdint>

#include "bihive/base/result.h"
#include "bihive/geometry/sphere_set.h"
#include "bihive/render/tracer.h"

namespace bihive {

/// Bytes of the tree that the engine builds: while it is built, and afterwards. For sets of a usual kind.
struct TreeBytes {
  double peak = 0, built = 0;
};
TreeBytes predict_tree_bytes(std::int64_t spheres, Engine engine, const TreeParameters& parameters);

/// The tree that the engine builds, beside the spheres.
Status check_tree_memory(const SphereSet& spheres, Engine engine, const TreeParameters& parameters);

}  // namespace bihive
