// Searches the parameters of a tree that suit one set of spheres: counted work chooses candidates, the clock decides.
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

struct TuneOptions {
  std::string structure = "wide";  ///< one that takes max-prims
  std::vector<QueryKind> kinds;    ///< without repetition; empty: all
  std::int64_t count = 4096;       ///< queries of a kind, 1 to 2^30
  int threads = 1;                 ///< of queries and, where a builder uses them, of builds; 0: all
  double most_ms = 10000;     ///< comparisons by the clock end then; builds and counts come first, and may exceed it
  ProgressCallback progress;  ///< on the caller's thread
};

/// One choice of parameters, built.
struct TuneCandidate {
  StructureParameters parameters;  ///< all 0: the structure's own choice
  std::int64_t bytes = 0, depth = 0;
  double work = 0;        ///< mean of Work::cost() over queries and kinds
  double counted_ns = 0;  ///< of a query, by the counted steps and the fitted costs, of kinds with a fit; NaN: none has
  double ns = 0;          ///< by the medians of the rounds; NaN: it was not timed
  std::int64_t rounds = 0;

  bool is_own() const { return parameters == StructureParameters{}; }
};

struct Tuning {
  StructureRow row;
  std::int64_t spheres = 0;
  int threads = 0;  ///< never 0
  std::vector<QueryKind> kinds;
  std::vector<std::int64_t> queries;  ///< made, of each kind
  std::vector<CostFit> costs;  ///< of one thread, by kind; none found where the kind has too few queries or trees
  double calibration_ms = 0;
  std::vector<TuneCandidate> candidates;  ///< the longest timed first, then by time, the others by work
  /// The choice. Of those timed to the end, all that are within kAsGood (sweep.h) of the fastest are as good by the
  /// clock; of these it is the structure's own, or, if that is expected to need more than kAsGood more time by counted
  /// work, the one of which the least is expected.
  TuneCandidate best, own;

  /// How many times as fast the choice is, by the medians of interleaved rounds; 1 where it is as good as the
  /// structure's own.
  double gain() const { return best.is_own() || best.ns > own.ns ? 1 : own.ns / best.ns; }
};

/// Builds the structure with max_prims from 1 to 64, and those that need the least time by counted work with fewer
/// levels too. The costs of its steps, for each kind of queries its own, come from a calibration of about 50 ms. Then
/// rounds in turn, of about 10 ms each, until half of the candidates remain, and so on to the last four: successive
/// halving. Counts do not depend on the machine, the choice does. Errors: an unknown structure, one without parameters,
/// or one that cannot be built. A Watch of the thread (base/watch.h) hears of the progress, and ends the search between
/// two builds or rounds.
Result<Tuning> tune_structure(const Scene& scene, const TuneOptions& options);

}  // namespace bihive::workbench
