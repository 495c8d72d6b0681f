#include "bihive/compare/sweep.h"

#include <algorithm>
#include <cmath>

#include "bihive/base/near_name.h"
#include "bihive/base/parallel.h"
#include "bihive/base/parse_number.h"
#include "bihive/base/thread_timer.h"
#include "bihive/base/timer.h"
#include "bihive/compare/run_queries.h"

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

Result<SweepPoint> measure_point(const StructureRow& row, const StructureParameters& parameters,
                                 const SphereSet& spheres, int threads, const std::vector<AnsweredSet>& sets) {
  SweepPoint point;
  point.parameters = parameters;
  const Timer timer;
  const Result<StructurePointer> structure = row.build(spheres, parameters, threads);
  if (!structure) return structure.error();
  point.build_ms = timer.elapsed_ms();
  point.facts = (*structure)->facts();
  double kinds = 0;
  for (const AnsweredSet& one : sets) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    point.kinds.push_back({kNone, kNone});
    if (one.set.size() == 0) continue;
    const QuerySet set = sample_of(one.set, affordable(**structure, one.set));
    double work = 0;
    for (const Work& of_query : count_all(**structure, set, threads)) work += of_query.cost();
    Answers answers;
    answers.resize(set.size());
    const ThreadTimer first(threads);
    answer_all(**structure, set, threads, answers);
    const double first_ms = first.elapsed_ms();
    point.different += one.count_different(answers);
    const double ms = time_of_answers(**structure, set, threads, first_ms, {}, answers);
    const auto queries = static_cast<double>(set.size());
    point.kinds.back() = {work / queries, ms * 1e6 / queries};
    point.mean.work += work / queries;
    point.mean.ns += ms * 1e6 / queries;
    ++kinds;
  }
  point.mean.work /= kinds, point.mean.ns /= kinds;
  return point;
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
  for (const StructureRow& row : *rows) {
    SweptStructure swept{row, {}};
    for (const StructureParameters& parameters : combinations_of(row, options.values)) {
      Result<SweepPoint> point = measure_point(row, parameters, scene.spheres, sweep.threads, *sets);
      if (!point) return point.error();
      swept.points.push_back(std::move(*point));
      if (options.progress) options.progress(static_cast<double>(++done) / static_cast<double>(points));
    }
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
