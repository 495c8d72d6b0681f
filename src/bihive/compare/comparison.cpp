#include "bihive/compare/comparison.h"

#include <algorithm>
#include <string_view>
#include <utility>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include "bihive/base/parallel.h"
#include "bihive/base/resident_memory.h"
#include "bihive/base/thread_timer.h"
#include "bihive/base/timer.h"
#include "bihive/compare/run_queries.h"

namespace bihive::workbench {
namespace {

constexpr std::int64_t kGroupsOfKind = 4;  // of queries with a similar number of steps, for the fit
constexpr TimingEffort kGroupEffort{5, 40, 3};

// Returns freed memory to the system, where the C library can, so that later allocations count as resident again.
void return_free_memory() {
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
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

class Run {
 public:
  Run(const Scene& scene, const ComparisonOptions& options) : scene_(scene), options_(options) {}

  Result<Comparison> compare() {
    // Find the structures by name before anything takes time.
    std::vector<StructureRow> rows;
    for (const std::string& name : options_.structures) {
      const Result<StructureRow> row = structure_named(name);
      if (!row) return row.error();
      const auto is_it = [&](const StructureRow& other) { return std::string_view(other.name) == row->name; };
      if (std::any_of(rows.begin(), rows.end(), is_it)) return Error{name + " stands twice", "", 0, 0, "leave one out"};
      rows.push_back(*row);
    }
    if (rows.empty()) rows = structures();
    Comparison comparison;
    comparison.spheres = scene_.spheres.size();
    for (const int wanted : options_.threads) {
      const int threads = wanted > 0 ? wanted : hardware_threads();
      if (std::find(threads_.begin(), threads_.end(), threads) == threads_.end()) threads_.push_back(threads);
    }
    if (threads_.empty()) threads_.push_back(1);
    comparison.threads = threads_;
    comparison.kinds = options_.kinds;
    if (comparison.kinds.empty())
      for (const QueryKindRow& row : kQueryKinds) comparison.kinds.push_back(row.kind);
    parts_ = static_cast<double>((rows.size() + 1) * comparison.kinds.size());

    Result<std::vector<AnsweredSet>> sets = answered_sets(scene_, comparison.kinds, options_.count, threads_.front());
    if (!sets) return sets.error();
    sets_ = std::move(*sets);
    for (const AnsweredSet& one : sets_) comparison.queries.push_back(one.set.size());
    end_parts(static_cast<double>(sets_.size()));

    for (const StructureRow& row : rows) {
      Result<StructureResult> result = measure(row);
      if (!result) return result.error();
      comparison.structures.push_back(std::move(*result));
    }
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      std::vector<std::pair<double, double>> costs, times;
      for (const StructureResult& one : comparison.structures) {
        if (!(one.facts.nodes > 0 && one.facts.expected_cost() > 0 && one.kinds[k].queries > 0)) continue;
        costs.emplace_back(one.facts.expected_cost(), one.kinds[k].cost);
        times.emplace_back(one.facts.expected_cost(), 1 / one.kinds[k].rate());
      }
      comparison.correlation.push_back(correlation_of(costs));
      comparison.time_correlation.push_back(correlation_of(times));
    }
    return comparison;
  }

 private:
  const Scene& scene_;
  const ComparisonOptions& options_;
  std::vector<int> threads_;
  std::vector<AnsweredSet> sets_;
  double parts_ = 1, parts_done_ = 0;  // progress is their quotient

  void end_parts(double count) {
    parts_done_ += count;
    if (options_.progress) options_.progress(parts_done_ / parts_);
  }

  Result<StructureResult> measure(const StructureRow& row) {
    StructureResult result;
    result.row = row;
    return_free_memory();
    const bool has_peak = forget_peak();
    const std::int64_t before = resident_bytes();
    const Timer timer;
    Result<StructurePointer> structure = row.build(scene_.spheres, {}, threads_.front());
    if (!structure) return structure.error();
    result.build_ms = timer.elapsed_ms();
    if (has_peak && before > 0) result.peak_bytes = std::max<std::int64_t>(0, peak_bytes() - before);
    result.facts = (*structure)->facts();
    std::vector<TimedWork> groups;
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      result.kinds.push_back(measure(**structure, k, groups));
      end_parts(1);
    }
    result.fit = fit_costs(groups);
    if (options_.cost_picture_px > 0) result.costs = costs_of_pixels(**structure, options_.cost_picture_px);
    return result;
  }

  std::vector<float> costs_of_pixels(const Structure& structure, int side_px) const {
    QuerySet set;
    for (int y = 0; y < side_px; ++y)
      for (int x = 0; x < side_px; ++x) set.rays.push_back(primary_ray(scene_, side_px, x, y));
    std::vector<float> costs;
    if (affordable(structure, set) < set.size()) return costs;
    for (const Work& work : count_all(structure, set, threads_.front()))
      costs.push_back(static_cast<float>(work.cost()));
    return costs;
  }

  KindResult measure(const Structure& structure, std::size_t k, std::vector<TimedWork>& groups) {
    KindResult result;
    const QuerySet& all = sets_[k].set;
    result.kind = all.kind;
    if (all.size() == 0) return result;
    const QuerySet set = sample_of(all, affordable(structure, all));
    result.queries = set.size();
    const std::vector<Work> works = count_all(structure, set, threads_.front());
    describe(works, result);

    // The first round warms up, is compared, and tells how often to repeat.
    Answers answers;
    answers.resize(set.size());
    for (const int threads : threads_) {
      const ThreadTimer timer(threads);
      answer_all(structure, set, threads, answers);
      const double first_ms = timer.elapsed_ms();
      if (result.ms.empty()) result.different = sets_[k].count_different(answers);
      result.ms.push_back(time_of_answers(structure, set, threads, first_ms, {}, answers));
    }
    for (const std::vector<std::int64_t>& group : groups_by_work(works, kGroupsOfKind)) {
      const QuerySet part = subset_of(set, group);
      groups.push_back(mean_work(works, group));
      groups.back().ns = time_of_answers(structure, part, 1, kGroupEffort) * 1e6 / static_cast<double>(part.size());
    }
    return result;
  }

  static void describe(const std::vector<Work>& works, KindResult& result) {
    const auto statistics = [&](std::int64_t Work::*step) {
      std::vector<std::int64_t> steps;
      for (const Work& work : works) steps.push_back(work.*step);
      return statistics_of(std::move(steps));
    };
    result.nodes = statistics(&Work::nodes);
    result.leaves = statistics(&Work::leaves);
    result.box_tests = statistics(&Work::box_tests);
    result.sphere_tests = statistics(&Work::sphere_tests);
    result.test_steps = statistics(&Work::test_steps);
    result.cost = result.nodes.mean + result.test_steps.mean;
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
