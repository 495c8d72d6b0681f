#include "bihive/compare/comparison.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "bihive/math/quartiles.h"

namespace bihive::workbench {
namespace {

constexpr double kMostSteps = 1 << 28;    // of a structure and kind: about a second
constexpr std::int64_t kTried = 64;       // queries that tell the steps of all
constexpr double kShortestTimingMs = 20;  // shorter ones repeat their work
constexpr double kLongestTimingsMs = 400;
constexpr std::size_t kMostRounds = 3;

// Answers in one form: closest hit, nearest sphere; of any hit id 0 or kNothing.
using Answers = HitBatch;

void answer(const Structure& structure, const QuerySet& set, std::int64_t first, std::int64_t count,
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

Work work_of(const Structure& structure, const QuerySet& set, std::int64_t i) {
  if (set.kind != QueryKind::points) return structure.work_of_ray(set.rays.span().at(i), row_of(set.kind).any_hit);
  const double* const point = set.points.data() + 3 * i;
  return structure.work_of_point({point[0], point[1], point[2]});
}

// How many queries of a set the structure answers within kMostSteps, by a few of them.
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

StepStatistics statistics_of(std::vector<std::int64_t> steps) {
  StepStatistics statistics;
  double sum = 0;
  for (const std::int64_t one : steps) sum += static_cast<double>(one);
  statistics.mean = sum / static_cast<double>(steps.size());
  const auto at = static_cast<std::ptrdiff_t>((steps.size() * 99 + 99) / 100 - 1);
  std::nth_element(steps.begin(), steps.begin() + at, steps.end());
  statistics.most_of_99 = static_cast<double>(steps[static_cast<std::size_t>(at)]);
  return statistics;
}

// Pearson's r; NaN without a spread.
double correlation_of(const std::vector<std::pair<double, double>>& pairs) {
  if (pairs.size() < 3) return std::numeric_limits<double>::quiet_NaN();
  double x = 0, y = 0;
  for (const auto& [a, b] : pairs) x += a, y += b;
  x /= static_cast<double>(pairs.size()), y /= static_cast<double>(pairs.size());
  double xx = 0, yy = 0, xy = 0;
  for (const auto& [a, b] : pairs) xx += (a - x) * (a - x), yy += (b - y) * (b - y), xy += (a - x) * (b - y);
  return xy / std::sqrt(xx * yy);
}

class Run {
 public:
  Run(const Scene& scene, const ComparisonOptions& options) : scene_(scene), options_(options) {}

  Result<Comparison> compare() {
    // Find the structures by name before anything takes time.
    std::vector<StructureRow> rows;
    for (const std::string& name : options_.structures) {
      const Result<StructureRow> row = structure_named(name);
      if (!row) return row.error();
      rows.push_back(*row);
    }
    if (rows.empty()) rows = structures();
    Comparison comparison;
    comparison.spheres = scene_.spheres.size();
    comparison.threads = options_.threads > 0 ? options_.threads : hardware_threads();
    comparison.kinds = options_.kinds;
    if (comparison.kinds.empty())
      for (const QueryKindRow& row : kQueryKinds) comparison.kinds.push_back(row.kind);
    parts_ = static_cast<double>((rows.size() + 1) * comparison.kinds.size());

    // The reference BIH says what is right.
    Result<StructurePointer> truth = structure_named("bih")->build(scene_.spheres, 1);
    if (!truth) return truth.error();
    sets_ = make_query_sets(scene_, comparison.kinds, options_.count, **truth);
    for (QuerySet& set : sets_) {
      set = sample_of(set, affordable(**truth, set));
      comparison.queries.push_back(set.size());
      truth_.emplace_back();
      truth_.back().resize(set.size());
      answer_all(**truth, set, truth_.back());
      end_part();
    }
    truth = StructurePointer();

    for (const StructureRow& row : rows) {
      Result<StructureResult> result = measure(row);
      if (!result) return result.error();
      comparison.structures.push_back(std::move(*result));
    }
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      std::vector<std::pair<double, double>> costs;
      for (const StructureResult& one : comparison.structures)
        if (one.facts.nodes > 0 && one.facts.expected_cost() > 0 && one.kinds[k].queries > 0)
          costs.emplace_back(one.facts.expected_cost(), one.kinds[k].cost);
      comparison.correlation.push_back(correlation_of(costs));
    }
    return comparison;
  }

 private:
  const Scene& scene_;
  const ComparisonOptions& options_;
  std::vector<QuerySet> sets_;
  std::vector<Answers> truth_;         // of each set
  double parts_ = 1, parts_done_ = 0;  // progress is their quotient

  void end_part() {
    if (options_.progress) options_.progress(++parts_done_ / parts_);
  }

  Result<StructureResult> measure(const StructureRow& row) {
    StructureResult result{row, 0, {}, {}};
    const Timer timer;
    Result<StructurePointer> structure = row.build(scene_.spheres, options_.threads);
    if (!structure) return structure.error();
    result.build_ms = timer.elapsed_ms();
    result.facts = (*structure)->facts();
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      result.kinds.push_back(measure(**structure, k));
      end_part();
    }
    return result;
  }

  KindResult measure(const Structure& structure, std::size_t k) {
    KindResult result;
    result.kind = sets_[k].kind;
    if (sets_[k].size() == 0) return result;
    const QuerySet set = sample_of(sets_[k], affordable(structure, sets_[k]));
    result.queries = set.size();
    count_steps(structure, set, result);

    // The first round warms up, is compared, and tells how often to repeat.
    Answers answers;
    answers.resize(set.size());
    Timer timer;
    answer_all(structure, set, answers);
    const double first_ms = timer.elapsed_ms();
    for (std::int64_t i = 0; i < set.size(); ++i)
      result.different += is_same(answers, i, truth_[k], position_in_sample(i, set.size(), sets_[k].size())) ? 0 : 1;
    const auto passes = static_cast<int>(std::ceil(kShortestTimingMs / std::max(first_ms, 1e-2)));
    const Timer all;
    std::vector<double> times;
    while (times.size() < kMostRounds && (times.empty() || all.elapsed_ms() < kLongestTimingsMs)) {
      const Timer round;
      for (int pass = 0; pass < passes; ++pass) answer_all(structure, set, answers);
      times.push_back(round.elapsed_ms() / passes);
    }
    result.ms = median(times);
    return result;
  }

  static bool is_same(const Answers& a, std::int64_t i, const Answers& b, std::int64_t k) {
    const Hit one = a.at(i), other = b.at(k);
    return std::memcmp(&one.t, &other.t, sizeof one.t) == 0 && one.sphere_id == other.sphere_id;
  }

  // Calls use(first, count) for all queries of a set on the threads, in calls as large as the structure likes.
  template <class Use>
  void in_calls(const Structure& structure, std::int64_t size, const Use& use) const {
    if (size == 0) return;
    const std::int64_t threads = options_.threads > 0 ? options_.threads : hardware_threads();
    const std::int64_t most = std::min(structure.rays_per_call(), (size + 64 * threads - 1) / (64 * threads) * 64);
    parallel_for(options_.threads, (size + most - 1) / most,
                 [&](std::int64_t call) { use(call * most, std::min(most, size - call * most)); });
  }

  void answer_all(const Structure& structure, const QuerySet& set, Answers& answers) const {
    in_calls(structure, set.size(), [&](std::int64_t first, std::int64_t count) {
      answer(structure, set, first, count, answers.span().part(first));
    });
  }

  void count_steps(const Structure& structure, const QuerySet& set, KindResult& result) const {
    std::vector<Work> works(static_cast<std::size_t>(set.size()));
    in_calls(structure, set.size(), [&](std::int64_t first, std::int64_t count) {
      for (std::int64_t i = first; i < first + count; ++i)
        works[static_cast<std::size_t>(i)] = work_of(structure, set, i);
    });
    const auto statistics = [&](std::int64_t Work::*step) {
      std::vector<std::int64_t> steps;
      for (const Work& work : works) steps.push_back(work.*step);
      return statistics_of(std::move(steps));
    };
    result.nodes = statistics(&Work::nodes);
    result.box_tests = statistics(&Work::box_tests);
    result.sphere_tests = statistics(&Work::sphere_tests);
    result.cost = result.nodes.mean + result.sphere_tests.mean;
  }
};

}  // namespace

bool StructureResult::same_bits() const {
  return std::all_of(kinds.begin(), kinds.end(), [](const KindResult& kind) { return kind.different == 0; });
}

bool Comparison::same_bits() const {
  return std::all_of(structures.begin(), structures.end(), [](const StructureResult& one) { return one.same_bits(); });
}

const StructureResult* Comparison::fastest(std::size_t kind) const {
  const StructureResult* best = nullptr;
  for (const StructureResult& one : structures)
    if (one.kinds[kind].queries > 0 && (best == nullptr || one.kinds[kind].rate() > best->kinds[kind].rate()))
      best = &one;
  return best;
}

Result<Comparison> compare_structures(const Scene& scene, const ComparisonOptions& options) {
  return Run(scene, options).compare();
}

}  // namespace bihive::workbench
