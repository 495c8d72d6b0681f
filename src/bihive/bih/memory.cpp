#include "bihive/bih/memory.h"

#include <algorithm>

#include "bihive/base/check.h"
#include "bihive/bih/statistics.h"

namespace bihive {
namespace {

// Inner nodes and leaves of a tree with that many leaves: inner = leaves - 1 + optimized.
struct TreeShape {
  double leaves;
  double optimized_per_leaf;
  double one_sided_per_leaf;

  std::int64_t nodes() const { return static_cast<std::int64_t>(2 * leaves - 1 + leaves * optimized_per_leaf); }
  // Empty leaves are not stored; each one-sided node has one.
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

  // Measured over the scenarios (64 to 100,000 spheres, radius 0.001 and 1), random sets and molecules at max_prims 1
  // to 64: 0.84 (grids that overlap themselves) to 2.6 times as many leaves as full leaves would be, 1.45 per sphere at
  // max_prims 1, with up to 0.41 clip nodes per leaf. A limited depth can end a chain of nodes early, which saves
  // leaves.
  const double full_leaves = n / std::max(1.0, max_prims);
  const bool limited = most_leaves < full_leaves;
  const TreeShape low{std::max(1.0, limited ? 0.25 * most_leaves : 0.8 * full_leaves), 0, 0.05};
  const TreeShape high{std::min(most_leaves, std::max(1.0, n * std::min(1.45, 2.65 / std::max(1.0, max_prims)))), 0.42,
                       0};

  MemoryPrediction prediction;
  const auto compact = [spheres](const TreeShape& shape) { return compact_bytes(shape.nodes(), 0, spheres).total(); };
  const auto as_allocated = [spheres](const TreeShape& shape) {
    return static_cast<std::int64_t>(sizeof(Tree)) + shape.stored_nodes() * static_cast<std::int64_t>(sizeof(Node)) +
           spheres * static_cast<std::int64_t>(sizeof(std::int64_t));
  };
  prediction.nodes = {low.nodes(), high.nodes()};
  prediction.compact_bytes = {compact(low), compact(high)};
  prediction.allocated_bytes = {as_allocated(low), as_allocated(high)};
  const TreeShape usual{std::min(high.leaves, std::max(1.0, 1.45 * full_leaves)), 0, 0};
  prediction.peak_bytes = as_allocated(usual) + usual.nodes() * static_cast<std::int64_t>(sizeof(Node));
  return prediction;
}

}  // namespace bihive
