// Table 4.2, shared by the code that measures it and the code that shows it.
#pragma once

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "thesis/compare.h"
#include "thesis/experiment.h"

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
inline constexpr const char* kBuildTimesStep = "build_times";
inline constexpr const char* kLevelsStep = "levels";
inline constexpr const char* kReasonsStep = "reasons";  ///< measure_reasons() of thesis/tree_reasons.h

/// The result of a tree's step:
///   {"rows": {key: number}, "nodes": n,   of this seed's tree
///    "mean": {..}, "sd": {..}, "nodes_of_seeds": [..], "seeds": n, "empty_leaves_disagree": n}
/// That of the build times: {"scenario1-max_prims1": [..], ..}, each a mean of as many builds as the thesis took; the
/// first of all columns were taken together, then the second, and so on. That of the levels: {"levels": [{"max_depth",
/// "min", "max"}]}, spheres per leaf.
Section table_4_2_section(const SectionContext& context);

/// One of the table's columns with its results.
struct TreeColumn {
  std::int64_t scenario, max_prims;
  const Json* result;

  std::string name() const { return fmt::format("Scenario {}, MAX_PRIMS {}", scenario, max_prims); }
  double row(const char* key) const { return (*result)["rows"][key].get<double>(); }
  Spread spread(const char* key) const {
    return {(*result)["mean"][key].get<double>(), (*result)["sd"][key].get<double>()};
  }
};

/// The columns that have results.
class TreeColumns {
 public:
  explicit TreeColumns(const SectionContext& context);

  const std::vector<TreeColumn>& all() const { return columns_; }
  const TreeColumn* find(std::int64_t scenario, std::int64_t max_prims) const;

  /// The build times of a column in milliseconds; empty if they have not been taken.
  const std::vector<double>& build_means(std::int64_t scenario, std::int64_t max_prims) const;
  bool has_build_times() const { return !build_means_.empty(); }
  bool complete() const { return columns_.size() == scenarios.size() * max_prims.size(); }

  /// The percentage by which the nodes of a scenario shrink from the first MAX_PRIMS to the last: for this seed, and
  /// over the seeds. Nothing if a result is missing.
  struct Reduction {
    double ours;
    Spread spread;
  };
  std::optional<Reduction> reduction(std::int64_t scenario) const;

  const std::vector<std::int64_t> scenarios, max_prims;

 private:
  std::vector<TreeColumn> columns_;
  std::map<std::string, std::vector<double>> build_means_;
};

/// The text's statements about the table. A statement about a missing result is left out.
Statements table_4_2_statements(const SectionContext& context, const TreeColumns& columns);

}  // namespace bihive::cli::thesis
