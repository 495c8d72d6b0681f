#include "bihive/render/tree_memory.h"

#include "bihive/base/memory.h"
#include "bihive/base/readable.h"
#include "bihive/bih/memory.h"
#include "bihive/wide/wide_builder.h"

namespace bihive {

TreeBytes predict_tree_bytes(std::int64_t spheres, Engine engine, const TreeParameters& parameters) {
  if (is_brute(engine)) return {};
  if (engine == Engine::reference) {
    const MemoryPrediction tree = predict_tree_memory(spheres, parameters.for_reference());
    return {static_cast<double>(tree.peak_bytes), static_cast<double>(tree.allocated_bytes.low)};
  }
  const WideMemoryPrediction tree = predict_wide_memory(spheres, parameters.for_wide(spheres));
  return {static_cast<double>(tree.peak_bytes), static_cast<double>(tree.low_bytes)};
}

Status check_tree_memory(const SphereSet& spheres, Engine engine, const TreeParameters& parameters) {
  return check_memory(predict_tree_bytes(spheres.size(), engine, parameters).peak,
                      "the tree of " + grouped(spheres.size()) + " spheres",
                      static_cast<double>(spheres.allocated_bytes()));
}

}  // namespace bihive
