// Statistics of both trees of a scene: the content of `bihive stats`, and the JSON that it prints.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "bihive/base/result.h"
#include "bihive/bih/statistics.h"
#include "bihive/bih/tree.h"
#include "bihive/render/tracer.h"
#include "bihive/wide/wide_builder.h"
#include "bihive/wide/wide_statistics.h"

namespace bihive {

/// The reference tree.
struct ReferenceFacts {
  TreeStatistics statistics;
  BuildParameters parameters;
  std::int64_t allocated_bytes = 0;
  double build_ms = 0;
};
ReferenceFacts reference_facts(const Tree& tree, double build_ms);

/// The wide tree, with the prediction of its memory.
struct WideFacts {
  WideStatistics statistics;
  WideParameters parameters;
  WideMemoryPrediction predicted;
  std::int64_t measured_peak_bytes = 0;  ///< tree and working memory
  double build_ms = 0;

  /// 0 for an empty tree.
  double bytes_per_sphere() const {
    if (statistics.spheres == 0) return 0;
    return static_cast<double>(statistics.used_bytes) / static_cast<double>(statistics.spheres);
  }
};

/// A newly built wide tree, and the facts of its build.
struct BuiltWideTree {
  std::shared_ptr<const WideTree> tree;
  WideParameters parameters;
  std::int64_t scratch_bytes = 0;
  double build_ms = 0;
};
/// Errors as WideBuilder::build().
Result<BuiltWideTree> build_wide_tree(const SphereSet& spheres, const TreeParameters& parameters);
WideFacts wide_facts(const BuiltWideTree& built);

/// One object over several lines, without a line break at the end. `seed`: of a generated scene.
std::string statistics_json(const ReferenceFacts& reference, const WideFacts& wide, std::optional<std::uint64_t> seed);
/// The reason why there are no statistics: {"error": "..."}.
std::string statistics_error(const Error& error);

}  // namespace bihive
