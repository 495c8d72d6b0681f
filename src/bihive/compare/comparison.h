// Compares structures on one set of spheres: time to build, memory, counted steps, speed, and whether all answers have
// the same bits.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/base/watch.h"
#include "bihive/compare/query_sets.h"
#include "bihive/compare/structure.h"
#include "bihive/scene/scene.h"

namespace bihive::workbench {

struct ComparisonOptions {
  std::vector<std::string> structures;  ///< names, without repetition; empty: all
  std::vector<QueryKind> kinds;         ///< without repetition; empty: all
  std::int64_t count = 65536;           ///< queries of a kind, 1 to 2^30
  int threads = 1;                      ///< for queries and, where a builder uses them, for builds; 0: all
  ProgressCallback progress;            ///< on the caller's thread
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
  double ms = 0;  ///< of all of them once
  StepStatistics nodes, box_tests, sphere_tests;
  double cost = 0;             ///< mean of Work::cost()
  std::int64_t different = 0;  ///< queries whose answer differs from that of the reference BIH in some bit

  /// Millions per second.
  double rate() const { return static_cast<double>(queries) / ms / 1000; }
};

struct StructureResult {
  StructureRow row;
  double build_ms = 0;
  StructureFacts facts;
  std::vector<KindResult> kinds;  ///< in the order of ComparisonOptions::kinds

  bool same_bits() const;
};

struct Comparison {
  std::int64_t spheres = 0;
  int threads = 0;  ///< never 0
  std::vector<QueryKind> kinds;
  std::vector<std::int64_t> queries;  ///< made, of each kind
  std::vector<StructureResult> structures;
  /// For each kind: the correlation (Pearson's r) between StructureFacts::expected_cost() and the counted cost over the
  /// structures that have nodes; NaN with fewer than three of them.
  std::vector<double> correlation;

  bool same_bits() const;
  /// The structure with the greatest rate; null: no such queries.
  const StructureResult* fastest(std::size_t kind) const;
};

/// Builds each structure once, counts the steps of each query, answers all and compares every bit with the answers of
/// the reference BIH, and times the answers: the median of up to three rounds. A structure that would need more than
/// 2^28 steps for a kind takes an evenly spaced sample. Counts and answers depend on the scene and the options alone.
/// The spheres must have no images. Error: an unknown structure, or one that cannot be built.
Result<Comparison> compare_structures(const Scene& scene, const ComparisonOptions& options);

}  // namespace bihive::workbench
