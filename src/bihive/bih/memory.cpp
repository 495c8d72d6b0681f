#include "bihive/bih/memory.h"

#include <algorithm>

#include "bihive/base/check.h"
#include "bihive/bih/statistics.h"

namespace bihive {
namespace {

// Inner nodes and leaves of a tree with so many leaves: inner = leaves - 1 + optimized.
struct Shape {
  double leaves;
  double optimized_per_leaf;
  double one_sided_per_leaf;

  std::int64_t nodes() const { return static_cast<std::int64_t>(2 * leaves - 1 + leaves * optimized_per_leaf); }
  // An empty leaf is not stored; there is one for each one-sided node.
  std::int64_t stored_nodes() const {
    return static_cast<std::int64_t>(static_cast<double>(nodes()) - leaves * one_sided_per_leaf);
  }
};

}  // namespace

MemoryPrediction predict_tree_memory(std::int64_t spheres, const BuildParameters& parameters) {
  BIHIVE_CHECK_GE(spheres, 0);
  BIHIVE_CHECK_GE(parameters.max_prims, 1);
  BIHIVE_CHECK_GE(parameters.max_depth, 1);

  // Bound the leaves by the spheres and by the levels.
  const double n = static_cast<double>(std::max<std::int64_t>(spheres, 1));
  const double levels = static_cast<double>(std::min<std::int64_t>(parameters.max_depth - 1, 62));
  const double most_leaves = static_cast<double>(std::int64_t{1} << static_cast<int>(levels));
  const double max_prims = static_cast<double>(std::min<std::int64_t>(parameters.max_prims, spheres));

  // Low: every leaf full. High: leaves filled to 40 %, a clip node for every third leaf and some empty leaves: beyond
  // the thesis's most scattered tree (Scenario 2: 63 % filled, 0.18 clip nodes a leaf at max_prims 1).
  const Shape low{std::min(most_leaves, n / std::max(1.0, max_prims)), 0, 0.05};
  const Shape high{std::min(most_leaves, std::max(1.0, n * std::min(1.0, 2.5 / std::max(1.0, max_prims)) * 1.05)), 0.35,
                   0};

  MemoryPrediction prediction;
  const auto as_thesis = [spheres](const Shape& shape) { return thesis_bytes(shape.nodes(), 0, spheres).total(); };
  const auto as_allocated = [spheres](const Shape& shape) {
    return static_cast<std::int64_t>(sizeof(Tree)) + shape.stored_nodes() * static_cast<std::int64_t>(sizeof(Node)) +
           spheres * static_cast<std::int64_t>(sizeof(std::int64_t));
  };
  prediction.nodes = {low.nodes(), high.nodes()};
  prediction.thesis_bytes = {as_thesis(low), as_thesis(high)};
  prediction.allocated_bytes = {as_allocated(low), as_allocated(high)};
  return prediction;
}

}  // namespace bihive
