// Compares structures on one set of spheres: time to build, memory, counted steps, speed, and whether all answers have
// the same bits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/base/watch.h"
#include "bihive/compare/cost_fit.h"
#include "bihive/compare/query_sets.h"
#include "bihive/compare/structure.h"
#include "bihive/scene/scene.h"

namespace bihive::workbench {

struct ComparisonOptions {
  std::vector<std::string> structures;  ///< names, without repetition; empty: all
  std::vector<QueryKind> kinds;         ///< without repetition; empty: all
  std::int64_t count = 65536;           ///< queries of a kind, 1 to 2^30
  /// Numbers of threads, each for all queries; the first one also for counts and, where a builder uses threads, for
  /// builds. 0: all. Repeated numbers count once.
  std::vector<int> threads{1, 0};
  int cost_picture_px = 0;    ///< sides of the pictures of costs (StructureResult::costs); 0: none
  ProgressCallback progress;  ///< on the caller's thread
};

/// Of one step per query.
struct StepStatistics {
  double mean = 0;
  double most_of_99 = 0;  ///< 99 % of the queries take at most this many
};

/// One kind of queries, answered by one structure.
struct KindResult {
  QueryKind kind = QueryKind::primary;
  /// Queries answered: fewer than there are if they would take the structure too many steps; 0: there are none, and
  /// nothing below is set.
  std::int64_t queries = 0;
  std::vector<double> ms;  ///< of all of them once, for each entry of Comparison::threads
  StepStatistics nodes, leaves, box_tests, sphere_tests, test_steps;
  double cost = 0;             ///< mean of Work::cost()
  std::int64_t different = 0;  ///< queries whose answer differs from that of the reference BIH in some bit

  /// Millions per second, by entry of Comparison::threads; NaN without queries.
  double rate(std::size_t threads = 0) const {
    return queries > 0 ? static_cast<double>(queries) / ms[threads] / 1000 : std::numeric_limits<double>::quiet_NaN();
  }
};

struct StructureResult {
  StructureRow row;
  double build_ms = 0;
  /// Resident memory that the build added at its peak; -1 where the system does not tell. Small builds may take all of
  /// it from memory that the process holds.
  std::int64_t peak_bytes = -1;
  StructureFacts facts;
  std::vector<KindResult> kinds;  ///< in the order of ComparisonOptions::kinds
  /// Of its steps on one thread, from four groups of each kind's queries, by their number of steps. Those of the wide
  /// tree are fitted to the steps of rays by themselves.
  CostFit fit;
  /// Work::cost() of the primary ray through each pixel of a square picture, row by row from the top. Empty: not
  /// requested, or the structure would need more than 2^28 steps.
  std::vector<float> costs;

  bool same_bits() const;
};

struct Comparison {
  std::int64_t spheres = 0;
  std::vector<int> threads;  ///< at least one, none of them 0
  std::vector<QueryKind> kinds;
  std::vector<std::int64_t> queries;  ///< made, of each kind
  std::vector<StructureResult> structures;
  /// For each kind: the correlation (Pearson's r) between StructureFacts::expected_cost() and the counted cost over the
  /// structures that have nodes; NaN with fewer than three of them.
  std::vector<double> correlation;
  /// The same between expected_cost() and the time of a query on the first number of threads.
  std::vector<double> time_correlation;

  bool same_bits() const;
  /// The structure with the greatest rate on the first number of threads; null: no such queries.
  const StructureResult* fastest(std::size_t kind) const;
};

/// Builds each structure once, counts the steps of each query, answers all and compares every bit with the answers of
/// the reference BIH, and times the answers for each number of threads: the median of up to three rounds. A structure
/// that would need more than 2^28 steps for a kind takes an evenly spaced sample. Counts and answers depend on the
/// scene and the options alone. The spheres must have no images. Error: an unknown structure, or one that cannot be
/// built.
Result<Comparison> compare_structures(const Scene& scene, const ComparisonOptions& options);

}  // namespace bihive::workbench
