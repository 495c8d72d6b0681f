// Structures built with several parameters on one set of spheres: which choice is the best, by counted work and by
// time.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/base/watch.h"
#include "bihive/compare/query_sets.h"
#include "bihive/compare/structure.h"
#include "bihive/scene/scene.h"

namespace bihive::workbench {

/// A choice whose work or time is within this share of the best one is as good.
constexpr double kAsGood = 0.02;

/// Values of each parameter, in the order of kStructureParameters; empty: the structure's own choice alone.
using ParameterValues = std::array<std::vector<std::int64_t>, kStructureParameters.size()>;

/// Adds "max-prims=1,2,4" to the values. Errors: no such parameter, one that has values, or a value out of its range.
Status add_parameter_values(const std::string& text, ParameterValues& values);

struct SweepOptions {
  std::vector<std::string> structures;  ///< names; empty: all that take a parameter with values
  ParameterValues values;               ///< some
  std::vector<QueryKind> kinds;         ///< without repetition; empty: all
  std::int64_t count = 65536;           ///< queries of a kind, 1 to 2^30
  int threads = 1;                      ///< of queries and, where a builder uses them, of builds; 0: all
  ProgressCallback progress;            ///< on the caller's thread
};

/// One kind of queries with one choice; NaN where there are none.
struct SweepCost {
  double work = 0;  ///< mean of Work::cost()
  double ns = 0;    ///< of a query
};

/// One choice of parameters.
struct SweepPoint {
  StructureParameters parameters;
  double build_ms = 0;
  StructureFacts facts;
  std::vector<SweepCost> kinds;  ///< in the order of Sweep::kinds
  SweepCost mean;                ///< over the kinds that have queries
  std::int64_t different = 0;    ///< queries whose answer differs from the reference BIH's in some bit
  bool good_by_work = false, good_by_time = false;  ///< within kAsGood of the structure's best
};

struct SweptStructure {
  StructureRow row;
  std::vector<SweepPoint> points;  ///< the last parameter of kStructureParameters changes first

  const SweepPoint& best_by_work() const;
  const SweepPoint& best_by_time() const;
};

struct Sweep {
  std::int64_t spheres = 0;
  int threads = 0;  ///< never 0
  ParameterValues values;
  std::vector<QueryKind> kinds;
  std::vector<std::int64_t> queries;  ///< made, of each kind
  std::vector<SweptStructure> structures;
};

/// Builds each structure with every combination of the values of those parameters that it takes, at most 256 of them,
/// counts all queries as compare_structures() does, and times them in rounds, one tree after the other: a time is the
/// median of the rounds, each by its ratio to the mean of all trees in it. Trees of more than 2 GiB are built and timed
/// in groups. Errors: an unknown structure, one that takes none of the parameters, too many combinations, or a
/// structure that cannot be built.
Result<Sweep> sweep_parameters(const Scene& scene, const SweepOptions& options);

}  // namespace bihive::workbench
