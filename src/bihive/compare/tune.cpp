#include "bihive/compare/tune.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "bihive/base/parallel.h"
#include "bihive/base/timer.h"
#include "bihive/base/watch.h"
#include "bihive/compare/run_queries.h"
#include "bihive/compare/sweep.h"
#include "bihive/math/quartiles.h"

namespace bihive::workbench {
namespace {

constexpr std::int64_t kMaxPrims[] = {1, 2, 3, 4, 6, 8, 12, 16, 24, 32, 48, 64};
constexpr std::int64_t kCutLevels[] = {1, 2};  // fewer than the best trees have
constexpr std::size_t kTimedAtMost = 8;
constexpr double kCalibrationMs = 50;
constexpr double kRoundMs = 10;
// Of all candidates, of the better half of them, and of the better half of those.
constexpr std::int64_t kRounds[] = {3, 6, 24};
constexpr double kShareOfBuilds = 0.3;  // building takes this share of the progress
constexpr double kNotMeasured = std::numeric_limits<double>::quiet_NaN();

struct Built {
  TuneCandidate candidate;
  StructurePointer structure;
  std::vector<std::vector<Work>> works;    // of each kind
  std::vector<std::vector<double>> times;  // of each kind: rounds, in nanoseconds of a query

  std::int64_t rounds() const { return times.empty() ? 0 : std::ssize(times.front()); }
};

class Tuner {
 public:
  Tuner(const Scene& scene, const TuneOptions& options) : scene_(scene), options_(options) {}

  Result<Tuning> tune() {
    const Result<StructureRow> row = structure_named(options_.structure);
    if (!row) return row.error();
    if ((row->takes & kTakesMaxPrims) == 0)
      return Error{options_.structure + " has no parameters to tune", "", 0, 0, ""};
    tuning_.row = *row;
    tuning_.spheres = scene_.spheres.size();
    tuning_.threads = options_.threads > 0 ? options_.threads : hardware_threads();
    tuning_.kinds = options_.kinds;
    if (tuning_.kinds.empty())
      for (const QueryKindRow& kind : kQueryKinds) tuning_.kinds.push_back(kind.kind);
    Result<std::vector<AnsweredSet>> sets = answers();
    if (!sets) return sets.error();
    sets_ = std::move(*sets);
    for (const AnsweredSet& one : sets_) tuning_.queries.push_back(one.set.size());

    // Count the work of every leaf size.
    if (const Status built = add({}); !built) return built.error();
    for (const std::int64_t max_prims : kMaxPrims)
      if (const Status built = add({max_prims, 0, 0}); !built) return built.error();
    calibrate();
    rank_by_counts();
    // Cut levels off the trees that promise most.
    if ((row->takes & kTakesMaxDepth) != 0) {
      const std::int64_t depth = built_.front().candidate.depth, max_prims = max_prims_of(built_.front());
      for (const std::int64_t fewer : kCutLevels)
        if (depth - fewer >= 1)
          if (const Status built = add({max_prims, depth - fewer, 0}); !built) return built.error();
      rank_by_counts();
    }
    halve_by_the_clock();
    if (work_.cancelled()) return cancelled_error();
    return std::move(tuning_);
  }

 private:
  const Scene& scene_;
  const TuneOptions& options_;
  Tuning tuning_;
  std::vector<AnsweredSet> sets_;
  std::vector<Built> built_;
  WatchedWork work_;
  double builds_ = 0;

  // Queries in parallel must not throw, so they are not watched; work_ is asked between them.
  Result<std::vector<AnsweredSet>> answers() const {
    const Unwatched unwatched;
    return answered_sets(scene_, tuning_.kinds, options_.count, tuning_.threads);
  }

  void report(double done) {
    work_.report(done);
    if (options_.progress) options_.progress(done);
  }

  static std::int64_t max_prims_of(const Built& one) { return one.candidate.parameters.max_prims; }

  Status add(const StructureParameters& parameters) {
    Result<StructurePointer> structure = tuning_.row.build(scene_.spheres, parameters, tuning_.threads);
    if (!structure) return structure.error();
    if (work_.cancelled()) return cancelled_error();
    const Unwatched unwatched;
    report(kShareOfBuilds * ++builds_ / double(1 + std::size(kMaxPrims) + std::size(kCutLevels)));
    Built one;
    one.structure = std::move(*structure);
    const StructureFacts facts = one.structure->facts();
    one.candidate.parameters = parameters;
    one.candidate.bytes = facts.bytes, one.candidate.depth = facts.depth;
    one.candidate.ns = one.candidate.counted_ns = kNotMeasured;
    double kinds = 0;
    for (const AnsweredSet& set : sets_) {
      one.works.push_back(count_all(*one.structure, set.set, tuning_.threads));
      if (set.set.size() == 0) continue;
      double work = 0;
      for (const Work& of_query : one.works.back()) work += of_query.cost();
      one.candidate.work += work / static_cast<double>(set.set.size());
      ++kinds;
    }
    one.candidate.work /= kinds;
    // Leave out a choice that gives the tree of another one.
    const auto is_same = [&](const Built& other) {
      return one.candidate.bytes == other.candidate.bytes && one.candidate.depth == other.candidate.depth &&
             one.candidate.work == other.candidate.work;
    };
    if (std::any_of(built_.begin(), built_.end(), is_same)) return Done{};
    built_.push_back(std::move(one));
    return Done{};
  }

  // Times groups of queries on three trees whose leaves differ much, so that the steps have different proportions.
  void calibrate() {
    const Unwatched unwatched;
    const Timer timer;
    constexpr std::int64_t kGroups = 4;
    const std::size_t last = built_.size() - 1;
    std::vector<std::size_t> chosen{0};
    if (last > 0) chosen.push_back(1);
    if (last > 1) chosen.push_back(last);
    const double each_ms = kCalibrationMs / double(chosen.size() * sets_.size() * kGroups);
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      std::vector<TimedWork> groups;
      for (const std::size_t b : chosen)
        for (const std::vector<std::int64_t>& group : groups_by_work(built_[b].works[k], kGroups)) {
          const QuerySet part = subset_of(sets_[k].set, group);
          groups.push_back(mean_work(built_[b].works[k], group));
          const double ms = time_of_answers(*built_[b].structure, part, 1, {each_ms / 2, 0, 1});
          groups.back().ns = ms * 1e6 / static_cast<double>(part.size());
        }
      tuning_.costs.push_back(fit_costs(groups));
    }
    tuning_.calibration_ms = timer.elapsed_ms();
  }

  // By the time that counts and costs predict for the kinds that have a fit; by the counts alone where none has.
  void rank_by_counts() {
    const bool has_costs =
        std::any_of(tuning_.costs.begin(), tuning_.costs.end(), [](const CostFit& costs) { return costs.found(); });
    for (Built& one : built_) {
      double ns = 0, kinds = 0;
      for (std::size_t k = 0; k < sets_.size(); ++k) {
        if (!tuning_.costs[k].found()) continue;
        const std::vector<Work>& works = one.works[k];
        std::vector<std::int64_t> all(works.size());
        std::iota(all.begin(), all.end(), 0);
        ns += tuning_.costs[k].ns_of(mean_work(works, all));
        ++kinds;
      }
      one.candidate.counted_ns = has_costs ? ns / kinds : kNotMeasured;
    }
    const auto rank = [&](const Built& one) { return has_costs ? one.candidate.counted_ns : one.candidate.work; };
    std::stable_sort(built_.begin(), built_.end(), [&](const Built& a, const Built& b) { return rank(a) < rank(b); });
  }

  // A round: kind after kind, each of all candidates in turn.
  void time_round(const std::vector<Built*>& candidates) const {
    for (Built* one : candidates) one->times.resize(sets_.size());
    for (std::size_t k = 0; k < sets_.size(); ++k)
      for (Built* one : candidates) {
        const auto queries = static_cast<double>(sets_[k].set.size());
        const TimingEffort effort{kRoundMs / static_cast<double>(sets_.size()), 0, 1};
        one->times[k].push_back(
            queries > 0 ? time_of_answers(*one->structure, sets_[k].set, tuning_.threads, effort) * 1e6 / queries : 0);
      }
  }

  // The mean over the kinds. A processor's clock changes for seconds at a time, so each round counts by its ratio to
  // that of the structure's own choice, which was timed beside it.
  double time_beside(const Built& one, const Built& own) const {
    double ns = 0, kinds = 0;
    for (std::size_t k = 0; k < sets_.size(); ++k) {
      if (sets_[k].set.size() == 0) continue;
      std::vector<double> ratios;
      for (std::size_t round = 0; round < one.times[k].size(); ++round)
        ratios.push_back(one.times[k][round] / own.times[k][round]);
      ns += median(own.times[k]) * median(ratios);
      ++kinds;
    }
    return ns / kinds;
  }

  void halve_by_the_clock() {
    // The structure's own choice is timed to the end, as what the others are compared with.
    std::vector<Built*> racing;
    Built* own = nullptr;
    for (Built& one : built_) {
      if (one.candidate.is_own())
        own = &one;
      else if (racing.size() < kTimedAtMost)
        racing.push_back(&one);
    }
    const Unwatched unwatched;
    const Timer timer;
    const auto time_left = [&] { return timer.elapsed_ms() < options_.most_ms && !work_.cancelled(); };
    const auto half = [](std::size_t count) { return (count + 1) / 2; };
    double all = 0, done = 0;  // rounds of a candidate
    std::size_t count = racing.size();
    for (const std::int64_t rounds : kRounds) {
      all += static_cast<double>(rounds) * static_cast<double>(count + 1);
      count = half(count);
    }
    for (const std::int64_t rounds : kRounds) {
      if (own->rounds() > 0) {
        for (Built* one : racing) one->candidate.ns = time_beside(*one, *own);
        std::stable_sort(racing.begin(), racing.end(),
                         [](const Built* a, const Built* b) { return a->candidate.ns < b->candidate.ns; });
        racing.resize(half(racing.size()));
      }
      std::vector<Built*> timed{own};
      timed.insert(timed.end(), racing.begin(), racing.end());
      for (std::int64_t round = 0; round < rounds && (time_left() || own->rounds() == 0); ++round) {
        time_round(timed);
        done += static_cast<double>(racing.size() + 1);
        report(kShareOfBuilds + (1 - kShareOfBuilds) * done / all);
      }
      if (!time_left()) break;
    }
    if (!work_.cancelled()) report(1);
    for (Built& one : built_) {
      one.candidate.rounds = one.rounds();
      if (one.rounds() > 0) one.candidate.ns = time_beside(one, *own);
      tuning_.candidates.push_back(one.candidate);
    }
    std::stable_sort(tuning_.candidates.begin(), tuning_.candidates.end(),
                     [](const TuneCandidate& a, const TuneCandidate& b) {
                       if (a.rounds != b.rounds) return a.rounds > b.rounds;
                       return a.rounds > 0 ? a.ns < b.ns : a.work < b.work;
                     });
    tuning_.own = own->candidate;
    racing.push_back(own);
    tuning_.best = chosen_of(racing);
  }

  // Clocks differ from run to run by more than kAsGood; counts do not.
  static TuneCandidate chosen_of(std::vector<Built*>& finalists) {
    const auto by = [](double TuneCandidate::*time) {
      return [time](const Built* a, const Built* b) { return a->candidate.*time < b->candidate.*time; };
    };
    const double fastest =
        (*std::min_element(finalists.begin(), finalists.end(), by(&TuneCandidate::ns)))->candidate.ns;
    const auto slower = std::partition(finalists.begin(), finalists.end(),
                                       [&](const Built* one) { return one->candidate.ns <= fastest * (1 + kAsGood); });
    const Built& least = **std::min_element(finalists.begin(), slower, by(&TuneCandidate::counted_ns));
    const auto own = std::find_if(finalists.begin(), slower, [](const Built* one) { return one->candidate.is_own(); });
    const bool own_is_as_good =
        own != slower && !((*own)->candidate.counted_ns > least.candidate.counted_ns * (1 + kAsGood));
    return own_is_as_good ? (*own)->candidate : least.candidate;
  }
};

}  // namespace

Result<Tuning> tune_structure(const Scene& scene, const TuneOptions& options) {
  return Tuner(scene, options).tune();
}

}  // namespace bihive::workbench
