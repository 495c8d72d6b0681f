// The properties of trees by which the text explains its results: how many spheres a leaf holds and how that varies,
// how often the children of a node overlap or leave a gap, how much empty space is cut off.
#pragma once

#include <cstdint>
#include <vector>

#include "experiment.h"

namespace bihive::thesis {

/// Which trees.
struct ReasonTrees {
  std::vector<std::int64_t> scenarios, spheres, max_prims;
  std::int64_t seeds = 20;  ///< 1, 2, ..., whatever --seed says; Scenario 1 has no chance in it
};

/// [{"scenario", "spheres", "max_prims", "seeds", "spheres_per_leaf", "spheres_per_leaf_sd", "depth_sd",
/// "overlap_percent", "gap_percent", "void_percent", "void_percent_by_level", "coinciding"}]: means over the seeds.
/// Deviations are over the leaves of a tree; overlaps and gaps are percent of the split nodes. Void is the exact
/// volume, in percent of the root's box, that no node of a level covers (and no leaf above it): by level from the root
/// on, and on the tenth. Empty if cancelled.
Json measure_reasons(const StepContext& context, const ReasonTrees& trees);

}  // namespace bihive::thesis
