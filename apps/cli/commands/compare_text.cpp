#include "commands/compare_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bihive/base/readable.h"
#include "bihive/job/messages.h"
#include "bihive/simd/target.h"

namespace bihive::cli {
namespace {

using workbench::Comparison;
using workbench::KindResult;
using workbench::StepStatistics;
using workbench::StructureResult;

// The fastest structure of a kind, and how many times as fast it is as the best other one; null: no queries.
struct Lead {
  const StructureResult* first = nullptr;
  const StructureResult* second = nullptr;
  double ratio = 1;
};

Lead lead_of(const Comparison& comparison, std::size_t k) {
  Lead lead;
  lead.first = comparison.fastest(k);
  if (lead.first == nullptr) return lead;
  for (const StructureResult& one : comparison.structures)
    if (&one != lead.first && (lead.second == nullptr || one.kinds[k].rate() > lead.second->kinds[k].rate()))
      lead.second = &one;
  if (lead.second != nullptr) lead.ratio = lead.first->kinds[k].rate() / lead.second->kinds[k].rate();
  return lead;
}

std::string percent_text(double share) {
  return std::isnan(share) ? "-" : fmt::format("{:.1f} %", 100 * share);
}

std::string peak_text(const StructureResult& one) {
  return one.peak_bytes < 0 ? "-" : readable_bytes(one.peak_bytes);
}

std::string steps(const StepStatistics& statistics) {
  return short_number(statistics.mean) + " / " + grouped(std::llround(statistics.most_of_99));
}

std::string table_of_builds(const Comparison& comparison) {
  std::string text = fmt::format("{:<12}{:>12}{:>14}{:>12}{:>8}{:>14}{:>14}\n", "structure", "build", "bytes/sphere",
                                 "peak", "levels", "nodes", "listed/sphere");
  for (const StructureResult& one : comparison.structures) {
    const auto spheres = static_cast<double>(comparison.spheres);
    text += fmt::format("{:<12}{:>12}{:>14}{:>12}{:>8}{:>14}{:>14}\n", one.row.name, readable_ms(one.build_ms),
                        short_number(static_cast<double>(one.facts.bytes) / spheres), peak_text(one), one.facts.depth,
                        grouped(one.facts.nodes), short_number(static_cast<double>(one.facts.references) / spheres));
  }
  return text;
}

std::string table_of_costs(const Comparison& comparison) {
  std::string text = "costs of steps on one thread, fitted to the times of groups of queries, in nanoseconds\n";
  text += fmt::format("{:<12}{:>10}{:>12}{:>10}{:>14}{:>10}{:>12}\n", "structure", "fixed", "inner node", "leaf",
                      "sphere test", "rms", "explained");
  for (const StructureResult& one : comparison.structures) {
    const workbench::CostFit& fit = one.fit;
    if (!fit.found())
      text += fmt::format("{:<12}  too few queries for a fit\n", one.row.name);
    else
      text += fmt::format("{:<12}{:>10}{:>12}{:>10}{:>14}{:>10}{:>12}\n", one.row.name, short_number(fit.fixed_ns),
                          short_number(fit.inner_ns), short_number(fit.leaf_ns), short_number(fit.test_ns),
                          percent_text(fit.rms), percent_text(fit.explained));
  }
  return text;
}

std::string table_of_kind(const Comparison& comparison, std::size_t k) {
  const workbench::QueryKindRow& kind = workbench::row_of(comparison.kinds[k]);
  if (comparison.queries[k] == 0) return fmt::format("{}: none; no primary ray leads to one\n", kind.name);
  const bool points = kind.kind == workbench::QueryKind::points;
  std::string text = fmt::format(
      "{}: {} {}; steps as mean / 99 %; correlation of the expected cost with the counted one {}, with the time {}\n",
      kind.name, grouped(comparison.queries[k]), points ? "points" : "rays", short_number(comparison.correlation[k]),
      short_number(comparison.time_correlation[k]));
  text += fmt::format("{:<12}", "structure");
  for (const int threads : comparison.threads)
    text += fmt::format("{:>12}", fmt::format("{}{}", points ? "M/s" : "Mray/s",
                                              comparison.threads.size() > 1 ? fmt::format(" x{}", threads) : ""));
  text += fmt::format("{:>16}{:>18}{:>20}{:>10}{:>10}\n", "nodes", "box tests", "sphere tests", "expected", "counted");
  for (const StructureResult& one : comparison.structures) {
    const KindResult& result = one.kinds[k];
    text += fmt::format("{:<12}", one.row.name);
    for (std::size_t t = 0; t < comparison.threads.size(); ++t)
      text += fmt::format("{:>12}", short_number(result.rate(t)));
    text += fmt::format("{:>16}{:>18}{:>20}{:>10}{:>10}", steps(result.nodes), steps(result.box_tests),
                        steps(result.sphere_tests), short_number(one.facts.expected_cost()), short_number(result.cost));
    if (result.queries < comparison.queries[k]) text += fmt::format("  of {} alone", grouped(result.queries));
    text += "\n";
  }
  return text;
}

std::string heading(const std::string& name, std::int64_t spheres, const std::string& threads) {
  return fmt::format("{}: {} sphere{}, {}, {}\n", escaped(name), grouped(spheres), spheres == 1 ? "" : "s", threads,
                     active_target());
}

}  // namespace

std::string name_of_kind(const Comparison& comparison, std::size_t k) {
  const workbench::QueryKindRow& row = workbench::row_of(comparison.kinds[k]);
  return row.kind == workbench::QueryKind::points ? row.name : std::string(row.name) + " rays";
}

std::string short_number(double value) {
  if (std::isnan(value)) return "-";
  if (value >= 99.95) return grouped(std::llround(value));
  return fmt::format("{:.{}f}", value, value >= 9.995 ? 1 : value >= 0.0995 || value == 0 ? 2 : 4);
}

std::string answer_of(const Comparison& comparison) {
  // The kinds that each structure wins, with its lead in them.
  std::string text;
  std::size_t winners = 0;
  for (const StructureResult& one : comparison.structures) {
    std::vector<std::string> won;
    double least = std::numeric_limits<double>::infinity(), most = 0;
    bool alone = true, all = true;
    for (std::size_t k = 0; k < comparison.kinds.size(); ++k) {
      const Lead lead = lead_of(comparison, k);
      if (lead.first == nullptr) continue;
      all = all && lead.first == &one;
      if (lead.first != &one) continue;
      won.push_back(name_of_kind(comparison, k));
      alone = alone && lead.second == nullptr;
      least = std::min(least, lead.ratio);
      most = std::max(most, lead.ratio);
    }
    if (won.empty()) continue;
    const bool one_ratio = short_number(least) == short_number(most);
    const std::string ratio =
        alone ? ""
              : fmt::format(", {} times as fast as the best other structure",
                            one_ratio ? short_number(least) : short_number(least) + " to " + short_number(most));
    const std::string where =
        all ? (won.size() > 1 ? "all of these queries" : won.front()) : fmt::format("{}", fmt::join(won, ", "));
    text += fmt::format("{}{} is {} for {}{}", winners++ > 0 ? "; " : "", one.row.name,
                        alone ? "the only structure" : "the fastest", where, ratio);
  }
  return text.empty() ? "Nothing was asked." : text + ".";
}

std::string threads_text(const std::vector<int>& threads) {
  return fmt::format("{} thread{}", fmt::join(threads, " and "), threads == std::vector{1} ? "" : "s");
}

std::string text_of(const workbench::StructureParameters& parameters) {
  std::string text;
  for (const workbench::ParameterRow& row : workbench::kStructureParameters)
    if (parameters.*row.value > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", row.name, parameters.*row.value);
  return text.empty() ? "its own choice" : text;
}

std::string comparison_text(const Comparison& comparison, const std::string& name) {
  std::string text =
      heading(name, comparison.spheres, threads_text(comparison.threads)) + answer_of(comparison) + "\n\n";
  text += table_of_builds(comparison) + "\n" + table_of_costs(comparison);
  for (std::size_t k = 0; k < comparison.kinds.size(); ++k) text += "\n" + table_of_kind(comparison, k);
  if (comparison.same_bits()) text += "\nEvery answer has the bits of the reference BIH.\n";
  return text;
}

std::string sweep_text(const workbench::Sweep& sweep, const std::string& name) {
  std::string text = heading(name, sweep.spheres, threads_text({sweep.threads}));
  text += fmt::format("marked *: within {:.0f} % of the structure's best; means over the kinds of queries\n",
                      100 * workbench::kAsGood);
  for (const workbench::SweptStructure& swept : sweep.structures) {
    text += fmt::format("\n{}: best by counted cost {}; by time {}\n", swept.row.name,
                        text_of(swept.best_by_work().parameters), text_of(swept.best_by_time().parameters));
    for (const workbench::ParameterRow& row : workbench::kStructureParameters) text += fmt::format("{:>12}", row.name);
    text += fmt::format("{:>12}{:>14}{:>8}{:>16}{:>16}\n", "build", "bytes/sphere", "levels", "counted cost",
                        "ns per query");
    for (const workbench::SweepPoint& point : swept.points) {
      for (const workbench::ParameterRow& row : workbench::kStructureParameters)
        text +=
            fmt::format("{:>12}", point.parameters.*row.value > 0 ? std::to_string(point.parameters.*row.value) : "-");
      text += fmt::format("{:>12}{:>14}{:>8}{:>15}{}{:>15}{}\n", readable_ms(point.build_ms),
                          short_number(static_cast<double>(point.facts.bytes) / static_cast<double>(sweep.spheres)),
                          point.facts.depth, short_number(point.mean.work), point.good_by_work ? "*" : " ",
                          short_number(point.mean.ns), point.good_by_time ? "*" : " ");
    }
  }
  return text;
}

std::string tuning_text(const workbench::Tuning& tuning, const std::string& name) {
  std::string text = heading(name, tuning.spheres, threads_text({tuning.threads}));
  std::string options;
  for (const workbench::ParameterRow& row : workbench::kStructureParameters)
    if (tuning.best.parameters.*row.value > 0)
      options += fmt::format(" --{} {}", row.name, tuning.best.parameters.*row.value);
  if (tuning.best.is_own())
    text += fmt::format("{}: nothing to gain; no choice is {:.0f} % faster than its own\n", tuning.row.name,
                        100 * workbench::kAsGood);
  else if (tuning.gain() <= 1 + workbench::kAsGood)
    text += fmt::format("{}: as fast by the clock as its own choice, and {} less time by counted steps, with{}\n",
                        tuning.row.name, percent_text(1 - tuning.best.counted_ns / tuning.own.counted_ns), options);
  else
    text += fmt::format("{}: {} times as fast with{}\n", tuning.row.name, short_number(tuning.gain()), options);
  text += fmt::format("\n{:<28}{:>8}{:>16}{:>18}{:>16}{:>10}\n", "costs here, ns", "query", "inner node", "leaf",
                      "test step", "rms");
  for (std::size_t k = 0; k < tuning.kinds.size(); ++k)
    if (const workbench::CostFit& costs = tuning.costs[k]; costs.found())
      text += fmt::format("{:<28}{:>8}{:>16}{:>18}{:>16}{:>10}\n", workbench::row_of(tuning.kinds[k]).name,
                          short_number(costs.fixed_ns), short_number(costs.inner_ns), short_number(costs.leaf_ns),
                          short_number(costs.test_ns), percent_text(costs.rms));
  text += fmt::format("\n{:<28}{:>8}{:>16}{:>18}{:>16}{:>10}\n", "choice", "levels", "counted cost", "predicted ns",
                      "measured ns", "rounds");
  for (const workbench::TuneCandidate& one : tuning.candidates)
    text += fmt::format("{:<28}{:>8}{:>16}{:>18}{:>16}{:>10}\n", text_of(one.parameters), one.depth,
                        short_number(one.work), short_number(one.counted_ns), short_number(one.ns), one.rounds);
  return text;
}

std::string ray_paths_text(const std::vector<workbench::StructurePath>& paths, const std::string& name,
                           std::pair<int, int> pixel, int side_px) {
  std::string text = fmt::format("{}: the ray through pixel {},{} of {} x {}\n", escaped(name), pixel.first,
                                 pixel.second, side_px, side_px);
  for (const workbench::StructurePath& path : paths) {
    const Hit hit = path.hit();
    const auto number = [](std::int64_t count, const char* what) {
      return fmt::format("{} {}{}", grouped(count), what, count == 1 ? "" : "s");
    };
    text += fmt::format("\n{}: {}; {}, {}, {}\n", path.name,
                        hit.found() ? fmt::format("sphere {} at t = {:.6g}", hit.sphere_id, hit.t) : "no hit",
                        number(path.work.nodes, "node"), number(path.work.box_tests, "box test"),
                        number(path.work.sphere_tests, "sphere test"));
    std::int64_t inner = 0;
    for (const workbench::PathStep& step : path.steps) {
      // Nodes without spheres are told in one line.
      if (step.sphere_ids.empty()) {
        ++inner;
        continue;
      }
      if (inner > 0) text += fmt::format("  {} node{} without spheres\n", grouped(inner), inner == 1 ? "" : "s");
      inner = 0;
      constexpr std::size_t kShown = 8;
      const std::size_t shown = std::min(kShown, step.sphere_ids.size());
      const auto first = step.sphere_ids.begin();
      text += fmt::format("  {} {}", step.sphere_ids.size() == 1 ? "sphere" : "spheres",
                          fmt::join(first, first + static_cast<std::ptrdiff_t>(shown), " "));
      if (shown < step.sphere_ids.size())
        text += fmt::format(" and {} more", grouped(std::ssize(step.sphere_ids) - std::int64_t(shown)));
      text += step.best.found() ? fmt::format(": nearest so far {} at t = {:.6g}\n", step.best.sphere_id, step.best.t)
                                : ": no hit\n";
    }
    if (inner > 0) text += fmt::format("  {} node{} without spheres\n", grouped(inner), inner == 1 ? "" : "s");
  }
  return text;
}

}  // namespace bihive::cli
