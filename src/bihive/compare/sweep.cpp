#include "bihive/compare/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "bihive/base/near_name.h"
#include "bihive/base/parallel.h"
#include "bihive/base/parse_number.h"
#include "bihive/base/timer.h"
#include "bihive/compare/run_queries.h"
#include "bihive/math/quartiles.h"

namespace bihive::workbench {
namespace {

constexpr std::size_t kMostCombinations = 256;

// Every combination of the values that the structure takes.
std::vector<StructureParameters> combinations_of(const StructureRow& row, const ParameterValues& values) {
  std::vector<StructureParameters> all{{}};
  for (std::size_t p = 0; p < values.size(); ++p) {
    if (values[p].empty() || (row.takes >> p & 1) == 0) continue;
    std::vector<StructureParameters> more;
    for (const StructureParameters& one : all)
      for (const std::int64_t value : values[p]) {
        more.push_back(one);
        more.back().*kStructureParameters[p].value = value;
      }
    all = std::move(more);
  }
  return all;
}

bool takes_some(const StructureRow& row, const ParameterValues& values) {
  for (std::size_t p = 0; p < values.size(); ++p)
    if (!values[p].empty() && (row.takes >> p & 1) != 0) return true;
  return false;
}

Result<std::vector<StructureRow>> swept_rows(const SweepOptions& options) {
  std::vector<StructureRow> rows;
  for (const std::string& name : options.structures) {
    const Result<StructureRow> row = structure_named(name);
    if (!row) return row.error();
    if (!takes_some(*row, options.values)) return Error{name + " takes none of these parameters", "", 0, 0, ""};
    rows.push_back(*row);
  }
  if (options.structures.empty())
    for (const StructureRow& row : structures())
      if (takes_some(row, options.values)) rows.push_back(row);
  return rows;
}

// Trees that are timed in turn, so that what slows a machine down for a while slows all of them down.
constexpr std::size_t kTurns = 15;
constexpr double kTurnMs = 4;                               // of a kind
constexpr std::int64_t kMostBytes = std::int64_t{2} << 30;  // of all trees in memory at the same time

// A point whose tree is there.
struct BuiltPoint {
  SweepPoint point;
  StructurePointer structure;
  std::vector<std::optional<QuerySet>> samples;  // set if answering all queries of a kind would take too long
  std::vector<std::vector<double>> times;        // of a kind: rounds, in nanoseconds of a query

  const QuerySet& set(const std::vector<AnsweredSet>& sets, std::size_t kind) const {
    return samples[kind] ? *samples[kind] : sets[kind].set;
  }
};

// Builds the tree, compares its answers, and counts their work.
Result<BuiltPoint> build_point(const StructureRow& row, const StructureParameters& parameters, const SphereSet& spheres,
                               int threads, const std::vector<AnsweredSet>& sets) {
  BuiltPoint built;
  SweepPoint& point = built.point;
  point.parameters = parameters;
  const Timer timer;
  Result<StructurePointer> structure = row.build(spheres, parameters, threads);
  if (!structure) return structure.error();
  built.structure = std::move(*structure);
  point.build_ms = timer.elapsed_ms();
  point.facts = built.structure->facts();
  built.samples.resize(sets.size());
  built.times.resize(sets.size());
  for (std::size_t k = 0; k < sets.size(); ++k) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    point.kinds.push_back({kNone, kNone});
    if (sets[k].set.size() == 0) continue;
    const std::int64_t affordable_queries = affordable(*built.structure, sets[k].set);
    if (affordable_queries < sets[k].set.size()) built.samples[k] = sample_of(sets[k].set, affordable_queries);
    const QuerySet& set = built.set(sets, k);
    double work = 0;
    for (const Work& of_query : count_all(*built.structure, set, threads)) work += of_query.cost();
    point.kinds.back().work = work / static_cast<double>(set.size());
    Answers answers;
    answers.resize(set.size());
    answer_all(*built.structure, set, threads, answers);
    point.different += sets[k].count_different(answers);
  }
  return built;
}

// Kind after kind, each of all points in turn.
void time_turn(std::vector<BuiltPoint>& points, int threads, const std::vector<AnsweredSet>& sets) {
  for (std::size_t k = 0; k < sets.size(); ++k)
    for (BuiltPoint& one : points) {
      const QuerySet& set = one.set(sets, k);
      if (set.size() == 0) continue;
      const double ms = time_of_answers(*one.structure, set, threads, {kTurnMs, 0, 1});
      one.times[k].push_back(ms * 1e6 / static_cast<double>(set.size()));
    }
}

// The times of all points, after the last turn. A processor's clock changes for seconds at a time, so each turn counts
// by its ratio to the points' mean of that turn.
void take_times(std::vector<BuiltPoint>& points, std::size_t kinds) {
  for (std::size_t k = 0; k < kinds; ++k) {
    if (points.empty() || points.front().times[k].empty()) continue;
    std::vector<double> means;
    for (std::size_t turn = 0; turn < kTurns; ++turn) {
      double logarithms = 0;
      for (const BuiltPoint& one : points) logarithms += std::log(one.times[k][turn]);
      means.push_back(std::exp(logarithms / static_cast<double>(points.size())));
    }
    for (BuiltPoint& one : points) {
      std::vector<double> ratios;
      for (std::size_t turn = 0; turn < kTurns; ++turn) ratios.push_back(one.times[k][turn] / means[turn]);
      one.point.kinds[k].ns = median(means) * median(ratios);
    }
  }
  for (BuiltPoint& one : points) {
    double timed = 0;
    for (std::size_t k = 0; k < kinds; ++k) {
      if (one.times[k].empty()) continue;
      one.point.mean.work += one.point.kinds[k].work;
      one.point.mean.ns += one.point.kinds[k].ns;
      ++timed;
    }
    one.point.mean.work /= timed, one.point.mean.ns /= timed;
  }
}

const SweepPoint& least(const std::vector<SweepPoint>& points, double SweepCost::*cost) {
  return *std::min_element(points.begin(), points.end(),
                           [&](const SweepPoint& a, const SweepPoint& b) { return a.mean.*cost < b.mean.*cost; });
}

}  // namespace

Status add_parameter_values(const std::string& text, ParameterValues& values) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  std::string all;
  std::vector<std::string> names;
  for (std::size_t p = 0; p < values.size(); ++p) {
    const ParameterRow& row = kStructureParameters[p];
    names.emplace_back(row.name);
    all += (p == 0 ? "" : ", ") + names.back();
    if (name != row.name) continue;
    if (equals == std::string::npos)
      return Error{name + " has no values; " + name + "=1,2,4 gives it three", "", 0, 0, ""};
    if (!values[p].empty()) return Error{name + " stands twice", "", 0, 0, "leave one out"};
    for (std::size_t first = equals + 1; first <= text.size();) {
      const std::size_t end = std::min(text.find(',', first), text.size());
      const std::string number = text.substr(first, end - first);
      const Result<std::int64_t> value = whole_number_from_text(number, 1, row.most);
      if (!value) return Error{name + ": " + value.error().message, "", 0, 0, ""};
      if (std::find(values[p].begin(), values[p].end(), *value) != values[p].end())
        return Error{name + " has the value " + number + " twice", "", 0, 0, "leave one out"};
      values[p].push_back(*value);
      first = end + 1;
    }
    return Done{};
  }
  const std::string near = near_name(name, names);
  return Error{"there is no parameter \"" + name + "\"; there are " + all, "", 0, 0,
               near.empty() ? "" : "did you mean " + near + "?"};
}

const SweepPoint& SweptStructure::best_by_work() const {
  return least(points, &SweepCost::work);
}
const SweepPoint& SweptStructure::best_by_time() const {
  return least(points, &SweepCost::ns);
}

Result<Sweep> sweep_parameters(const Scene& scene, const SweepOptions& options) {
  const Result<std::vector<StructureRow>> rows = swept_rows(options);
  if (!rows) return rows.error();
  Sweep sweep;
  sweep.spheres = scene.spheres.size();
  sweep.threads = options.threads > 0 ? options.threads : hardware_threads();
  sweep.values = options.values;
  sweep.kinds = options.kinds;
  if (sweep.kinds.empty())
    for (const QueryKindRow& row : kQueryKinds) sweep.kinds.push_back(row.kind);
  std::size_t points = 0, done = 0;
  for (const StructureRow& row : *rows) points += combinations_of(row, options.values).size();
  if (points > kMostCombinations)
    return Error{std::to_string(points) + " combinations of structures and parameters are too many: at most " +
                     std::to_string(kMostCombinations),
                 "", 0, 0, "give fewer values or structures"};

  const Result<std::vector<AnsweredSet>> sets = answered_sets(scene, sweep.kinds, options.count, sweep.threads);
  if (!sets) return sets.error();
  for (const AnsweredSet& one : *sets) sweep.queries.push_back(one.set.size());
  const auto report = [&](std::size_t more) {
    done += more;
    if (options.progress) options.progress(static_cast<double>(done) / static_cast<double>(points * (1 + kTurns)));
  };
  for (const StructureRow& row : *rows) {
    SweptStructure swept{row, {}};
    std::vector<BuiltPoint> built;
    std::int64_t bytes = 0;
    const auto time_in_turn = [&] {
      for (std::size_t turn = 0; turn < kTurns; ++turn) {
        time_turn(built, sweep.threads, *sets);
        report(built.size());
      }
      take_times(built, sets->size());
      for (BuiltPoint& one : built) swept.points.push_back(std::move(one.point));
      built.clear();
      bytes = 0;
    };
    for (const StructureParameters& parameters : combinations_of(row, options.values)) {
      Result<BuiltPoint> one = build_point(row, parameters, scene.spheres, sweep.threads, *sets);
      if (!one) return one.error();
      bytes += one->point.facts.bytes;
      built.push_back(std::move(*one));
      report(1);
      if (bytes > kMostBytes) time_in_turn();
    }
    time_in_turn();
    const double work = swept.best_by_work().mean.work, ns = swept.best_by_time().mean.ns;
    for (SweepPoint& point : swept.points) {
      point.good_by_work = point.mean.work <= work * (1 + kAsGood);
      point.good_by_time = point.mean.ns <= ns * (1 + kAsGood);
    }
    sweep.structures.push_back(std::move(swept));
  }
  return sweep;
}

}  // namespace bihive::workbench
