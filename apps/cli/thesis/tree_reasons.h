// The properties of trees by which the text explains its results: how many spheres a leaf holds and how that varies,
// how often the children of a node overlap or leave a gap.
#pragma once

#include <cstdint>
#include <vector>

#include "thesis/compare.h"
#include "thesis/experiment.h"

namespace bihive::cli::thesis {

/// Which trees.
struct ReasonTrees {
  std::vector<std::int64_t> scenarios, spheres, max_prims;
  double radius = 1;
  std::int64_t seeds = 20;  ///< 1, 2, ..., whatever --seed says; Scenario 1 has no chance in it
};

/// [{"scenario", "spheres", "max_prims", "seeds", "spheres_per_leaf": {"mean", "sd"}, "relative_sd", "overlap_share",
/// "gap_share", "depth_sd"}]: means over the seeds. The deviations are over the leaves of a tree; `relative_sd` is that
/// of the spheres per leaf over their mean. Shares are of the split nodes. Empty if cancelled.
Json measure_reasons(const StepContext& context, const ReasonTrees& trees);

/// The rows as a table.
Table reasons_table(const Json& rows, const std::string& title);

}  // namespace bihive::cli::thesis
