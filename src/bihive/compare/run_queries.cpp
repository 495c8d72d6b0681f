#include "bihive/compare/run_queries.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "bihive/base/parallel.h"
#include "bihive/base/thread_timer.h"
#include "bihive/math/quartiles.h"

namespace bihive::workbench {
namespace {

constexpr double kMostSteps = 1 << 28;  // of a structure and kind
constexpr std::int64_t kTried = 64;     // queries that tell the steps of all

void answer_call(const Structure& structure, const QuerySet& set, std::int64_t first, std::int64_t count,
                 const HitSpan& hits) {
  if (set.kind == QueryKind::points) return structure.nearest_spheres(set.points.data() + 3 * first, count, hits);
  const RaySpan rays = set.rays.span().part(first, count);
  if (!row_of(set.kind).any_hit) return structure.closest_hits(rays, set.order, hits);
  std::vector<std::uint8_t> is_occluded(static_cast<std::size_t>(count));
  structure.occluded(rays, set.order, is_occluded.data());
  for (std::int64_t i = 0; i < count; ++i) {
    hits.t[i] = 0;
    hits.sphere_id[i] = is_occluded[static_cast<std::size_t>(i)] != 0 ? 0 : kNothing;
  }
}

// Calls use(first, count) for all queries of a set on the threads, in calls as large as the structure likes.
template <class Use>
void in_calls(const Structure& structure, std::int64_t size, int threads, const Use& use) {
  if (size == 0) return;
  const std::int64_t count = threads > 0 ? threads : hardware_threads();
  const std::int64_t most = std::min(structure.rays_per_call(), (size + 64 * count - 1) / (64 * count) * 64);
  parallel_for(threads, (size + most - 1) / most,
               [&](std::int64_t call) { use(call * most, std::min(most, size - call * most)); });
}

}  // namespace

std::int64_t AnsweredSet::count_different(const Answers& answers) const {
  std::int64_t different = 0;
  for (std::int64_t i = 0; i < answers.size(); ++i) {
    const Hit one = answers.at(i), other = truth.at(position_in_sample(i, answers.size(), truth.size()));
    const bool same = std::memcmp(&one.t, &other.t, sizeof one.t) == 0 && one.sphere_id == other.sphere_id;
    different += same ? 0 : 1;
  }
  return different;
}

Result<std::vector<AnsweredSet>> answered_sets(const Scene& scene, const std::vector<QueryKind>& kinds,
                                               std::int64_t count, int threads) {
  const Result<StructurePointer> reference = structure_named("bih")->build(scene.spheres, {}, 1);
  if (!reference) return reference.error();
  std::vector<AnsweredSet> answered;
  for (const QuerySet& set : make_query_sets(scene, kinds, count, **reference)) {
    AnsweredSet one{sample_of(set, affordable(**reference, set)), {}};
    one.truth.resize(one.set.size());
    answer_all(**reference, one.set, threads, one.truth);
    answered.push_back(std::move(one));
  }
  return answered;
}

Work work_of(const Structure& structure, const QuerySet& set, std::int64_t i) {
  if (set.kind != QueryKind::points) return structure.work_of_ray(set.rays.span().at(i), row_of(set.kind).any_hit);
  const double* const point = set.points.data() + 3 * i;
  return structure.work_of_point({point[0], point[1], point[2]});
}

std::int64_t affordable(const Structure& structure, const QuerySet& set) {
  const std::int64_t tried = std::min(kTried, set.size());
  double steps = 0;
  for (std::int64_t i = 0; i < tried; ++i) {
    const Work work = work_of(structure, set, position_in_sample(i, tried, set.size()));
    steps += work.cost() + static_cast<double>(work.box_tests);
  }
  const double each = steps / static_cast<double>(std::max<std::int64_t>(1, tried));
  const double most = kMostSteps / std::max(1.0, each);
  return most < static_cast<double>(set.size()) ? std::max<std::int64_t>(16, static_cast<std::int64_t>(most))
                                                : set.size();
}

void answer_all(const Structure& structure, const QuerySet& set, int threads, Answers& answers) {
  in_calls(structure, set.size(), threads, [&](std::int64_t first, std::int64_t count) {
    answer_call(structure, set, first, count, answers.span().part(first));
  });
}

std::vector<Work> count_all(const Structure& structure, const QuerySet& set, int threads) {
  std::vector<Work> works(static_cast<std::size_t>(set.size()));
  in_calls(structure, set.size(), threads, [&](std::int64_t first, std::int64_t count) {
    for (std::int64_t i = first; i < first + count; ++i)
      works[static_cast<std::size_t>(i)] = work_of(structure, set, i);
  });
  return works;
}

double time_of_answers(const Structure& structure, const QuerySet& set, int threads, double first_ms,
                       const TimingEffort& effort, Answers& answers) {
  const auto passes = static_cast<int>(std::ceil(effort.round_ms / std::max(first_ms, 1e-2)));
  const ThreadTimer all(threads);
  std::vector<double> times;
  while (times.size() < effort.rounds && (times.empty() || all.elapsed_ms() < effort.most_ms)) {
    const ThreadTimer round(threads);
    for (int pass = 0; pass < passes; ++pass) answer_all(structure, set, threads, answers);
    times.push_back(round.elapsed_ms() / passes);
  }
  return median(times);
}

double time_of_answers(const Structure& structure, const QuerySet& set, int threads, const TimingEffort& effort) {
  Answers answers;
  answers.resize(set.size());
  const ThreadTimer timer(threads);
  answer_all(structure, set, threads, answers);
  return time_of_answers(structure, set, threads, timer.elapsed_ms(), effort, answers);
}

}  // namespace bihive::workbench
