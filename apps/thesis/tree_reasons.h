// The properties of trees by which the text explains its results: spheres per leaf and their variation, the frequency
// of overlaps and gaps between children, and the empty space cut off.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/bih/tree.h"
#include "experiment.h"

namespace bihive::thesis {

/// [{"scenario", "spheres", "max_prims", "seeds", "spheres_per_leaf", "spheres_per_leaf_sd", "depth_sd",
/// "overlap_percent", "gap_percent", "void_percent", "void_percent_by_level", "coinciding"}]: means over the seeds 1,
/// 2, ... of all trees of these scenarios, numbers of spheres and MAX_PRIMS. Deviations are over the leaves of a tree;
/// overlaps and gaps are percent of the split nodes. Void is the exact volume, in percent of the root's box, that no
/// node of a level covers (and no leaf above it): by level from the root on, and on the tenth. Empty if cancelled.
Json measure_reasons(const Experiment& experiment, const std::vector<std::int64_t>& spheres,
                     const std::vector<std::int64_t>& max_prims, std::int64_t seeds);

/// Percent of the split nodes whose children overlap.
double overlap_percent(const Tree& tree);

}  // namespace bihive::thesis
