// Queries of a set, answered, counted and timed by one structure.
#pragma once

#include <cstdint>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/compare/query_sets.h"
#include "bihive/compare/structure.h"
#include "bihive/wide/ray_batch.h"

namespace bihive::workbench {

/// Answers in one form: closest hit, nearest sphere; of any hit t 0 and id 0 or kNothing.
using Answers = HitBatch;

/// Queries, and the answers of the reference BIH.
struct AnsweredSet {
  QuerySet set;
  Answers truth;

  /// Answers that differ from the truth in some bit: of all queries, or of an evenly spaced sample.
  std::int64_t count_different(const Answers& answers) const;
};
/// One for each kind, no more queries than the reference BIH can afford. `count`: as for make_query_sets(). Error: not
/// enough memory for the tree.
Result<std::vector<AnsweredSet>> answered_sets(const Scene& scene, const std::vector<QueryKind>& kinds,
                                               std::int64_t count, int threads);

Work work_of(const Structure& structure, const QuerySet& set, std::int64_t i);

/// How many queries of a set the structure answers within 2^28 steps (about a second), by a few of them; 16 at least.
std::int64_t affordable(const Structure& structure, const QuerySet& set);

/// Fills the answers, which have the set's size. `threads` 0: all.
void answer_all(const Structure& structure, const QuerySet& set, int threads, Answers& answers);
/// Steps of each query.
std::vector<Work> count_all(const Structure& structure, const QuerySet& set, int threads);

/// Rounds of a timing, and the time after which no further one begins.
struct TimingEffort {
  double round_ms = 20;  ///< shorter rounds repeat their work
  double most_ms = 400;
  std::size_t rounds = 3;
};
/// Milliseconds of all answers once: the median of the rounds. `first_ms`: of a round that was timed before, which
/// says how often to repeat. The answers are overwritten.
double time_of_answers(const Structure& structure, const QuerySet& set, int threads, double first_ms,
                       const TimingEffort& effort, Answers& answers);
/// The same, with a first round of its own.
double time_of_answers(const Structure& structure, const QuerySet& set, int threads, const TimingEffort& effort);

}  // namespace bihive::workbench
