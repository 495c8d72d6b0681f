// Table 4.2 between its two halves: what is measured, and how it is shown.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string>

#include "experiment.h"

namespace bihive::cli::thesis {

/// A row of the table. `decimals` are those of our own numbers; shares are percent of all leaves.
struct TreeRow {
  const char* key;
  const char* label;
  int decimals;
  bool share;
};

constexpr std::array<TreeRow, 15> kTreeRows{{{"inner_nodes", "Inner nodes", 0, false},
                                             {"leaves", "Leaves", 0, false},
                                             {"spheres_per_leaf_min", "Spheres per leaf, min", 0, false},
                                             {"spheres_per_leaf_avg", "Spheres per leaf, avg", 2, false},
                                             {"spheres_per_leaf_max", "Spheres per leaf, max", 0, false},
                                             {"depth_min", "Depth, min", 0, false},
                                             {"depth_avg", "Depth, avg", 2, false},
                                             {"depth_max", "Depth, max", 0, false},
                                             {"share_with_0", "Leaves with N = 0", 2, true},
                                             {"share_with_1", "Leaves with N = 1", 2, true},
                                             {"share_with_2", "Leaves with N = 2", 2, true},
                                             {"share_with_3", "Leaves with N = 3", 2, true},
                                             {"share_with_4", "Leaves with N = 4", 2, true},
                                             {"share_with_more", "Leaves with N > 4", 2, true},
                                             {"optimized_nodes", "Optimized nodes", 0, false}}};

/// Of a step's name, and with a row's key behind a point that of the stated value ("scenario2.max_prims8").
inline std::string tree_step(std::int64_t scenario, std::int64_t max_prims) {
  return fmt::format("scenario{}-max_prims{}", scenario, max_prims);
}
inline std::string tree_value(std::int64_t scenario, std::int64_t max_prims) {
  return fmt::format("scenario{}.max_prims{}", scenario, max_prims);
}
inline constexpr const char* kLevelsStep = "levels";

/// A step's result: {"rows": {key: number}, "mean": {..}, "sd": {..}, "seeds": n, "empty_leaves_disagree": n,
/// "nodes": n, "nodes_of_seeds": [..], "build_ms": [..]}. That of the levels: {"levels": [{"max_depth", "min",
/// "max"}]}.
Section table_4_2_section(const SectionContext& context);

}  // namespace bihive::cli::thesis
