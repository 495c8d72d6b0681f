#include "commands/compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <kainjow/mustache.hpp>
#include <vector>

#include "../../shared/processor_name.h"
#include "bihive/base/readable.h"
#include "bihive/base/version.h"
#include "bihive/image/html_text.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/simd/target.h"
#include "commands/compare_text.h"
#include "commands/cost_pictures.h"

namespace bihive::cli {
namespace {

namespace must = kainjow::mustache;
using workbench::Comparison;
using workbench::KindResult;
using workbench::StructureResult;

must::data rows_of(const Comparison& comparison, std::size_t k) {
  must::data rows{must::data::type::list};
  const StructureResult* const best = comparison.fastest(k);
  if (best == nullptr) return rows;
  for (const StructureResult& one : comparison.structures) {
    const KindResult& kind = one.kinds[k];
    must::data row;
    row.set("structure", one.row.name);
    row.set("best", &one == best);
    row.set("rate", short_number(kind.rate()));
    must::data rates{must::data::type::list};
    for (std::size_t t = 0; t < comparison.threads.size(); ++t) {
      must::data rate;
      rate.set("rate", short_number(kind.rate(t)));
      rates << rate;
    }
    row.set("rates", rates);
    row.set("percent", fmt::format("{:.2f}", 100 * kind.rate() / best->kinds[k].rate()));
    row.set("nodes", short_number(kind.nodes.mean));
    row.set("nodes_99", grouped(std::llround(kind.nodes.most_of_99)));
    row.set("box_tests", short_number(kind.box_tests.mean));
    row.set("sphere_tests", short_number(kind.sphere_tests.mean));
    row.set("sphere_tests_99", grouped(std::llround(kind.sphere_tests.most_of_99)));
    row.set("expected", short_number(one.facts.expected_cost()));
    row.set("cost", short_number(kind.cost));
    row.set("queries", grouped(kind.queries));
    rows << row;
  }
  return rows;
}

// A row for each level of a tree.
must::data levels_of(const StructureResult& one) {
  must::data levels{must::data::type::list};
  std::int64_t number = 0;
  for (const workbench::LevelFacts& level : one.facts.levels) {
    must::data row;
    const std::int64_t inner = level.nodes - level.leaves;
    row.set("level", std::to_string(++number));
    row.set("nodes", grouped(level.nodes));
    row.set("leaves", grouped(level.leaves));
    row.set("per_leaf", level.leaves == 0 ? "" : short_number(double(level.references) / double(level.leaves)));
    row.set("expected", std::isnan(level.expected_nodes) ? "" : short_number(level.expected_nodes));
    row.set("children", inner == 0 || std::isnan(level.children) ? "" : short_number(level.children));
    row.set("overlap", inner == 0 || std::isnan(level.overlap) ? "" : short_number(level.overlap));
    levels << row;
  }
  return levels;
}

// Puts the pictures of costs and their scale into the page.
void add_cost_pictures(const Comparison& comparison, must::data& view) {
  const CostPictures made = cost_pictures(comparison);
  if (made.pictures.empty()) return;
  must::data pictures{must::data::type::list}, ticks{must::data::type::list};
  for (const CostPicture& one : made.pictures) {
    must::data picture;
    picture.set("structure", one.structure);
    picture.set("png", base64(one.png));
    picture.set("least", grouped(std::llround(one.least)));
    picture.set("mean", short_number(one.mean));
    picture.set("most", grouped(std::llround(one.most)));
    pictures << picture;
  }
  for (const double value : made.ticks) {
    must::data tick;
    tick.set("value", grouped(std::llround(value)));
    tick.set("percent", fmt::format("{:.2f}", 100 * made.share(value)));
    ticks << tick;
  }
  view.set("cost_pictures", true);
  view.set("pictures", pictures);
  view.set("ticks", ticks);
  view.set("scale_colours", fmt::format("{}", fmt::join(made.colours, ", ")));
}

must::data page_of(const std::string& name, std::int64_t spheres, const std::string& threads) {
  must::data view;
  view.set("name", name);
  view.set("threads", threads);
  view.set("spheres", grouped(spheres));
  view.set("machine", processor_name());
  view.set("target", active_target());
  view.set("version", std::string(version()));
  if (!std::string(commit()).empty()) view.set("commit", std::string(commit()));
  return view;
}

std::string rendered(const must::data& view) {
  must::mustache page{std::string(comparison_template())};
  page.set_custom_escape([](const std::string& text) { return escape_html(text); });
  if (!page.is_valid()) fail({"the template of the report: " + page.error_message(), "", 0, 0, ""});
  return page.render(view);
}

// One measure over all choices: the values of the first swept parameter along the rows, those of the others down the
// columns, each cell as a multiple of the best.
must::data surface_of(const workbench::Sweep& sweep, const workbench::SweptStructure& swept, const char* title,
                      double workbench::SweepCost::*cost, bool workbench::SweepPoint::*is_good) {
  std::size_t across = 0;
  while (sweep.values[across].empty() || (swept.row.takes >> across & 1) == 0) ++across;
  const workbench::ParameterRow& parameter = workbench::kStructureParameters[across];
  must::data surface, columns{must::data::type::list}, rows{must::data::type::list};
  surface.set("title", title);
  surface.set("across", parameter.name);
  for (const std::int64_t value : sweep.values[across]) {
    must::data column;
    column.set("value", std::to_string(value));
    columns << column;
  }
  surface.set("columns", columns);

  double best = std::numeric_limits<double>::infinity(), worst = 0;
  for (const workbench::SweepPoint& point : swept.points) {
    best = std::min(best, point.mean.*cost);
    worst = std::max(worst, point.mean.*cost);
  }
  // The first parameter changes last, so a row is a step through all of its values.
  const std::size_t row_count = swept.points.size() / sweep.values[across].size();
  for (std::size_t r = 0; r < row_count; ++r) {
    must::data row, cells{must::data::type::list};
    workbench::StructureParameters others = swept.points[r].parameters;
    others.*parameter.value = 0;
    row.set("others", row_count > 1 ? text_of(others) : std::string());
    for (std::size_t c = 0; c < sweep.values[across].size(); ++c) {
      const workbench::SweepPoint& point = swept.points[c * row_count + r];
      const double ratio = point.mean.*cost / best;
      must::data cell;
      cell.set("value", short_number(ratio));
      cell.set("good", point.*is_good);
      // Full colour at the best, none at the worst, even steps of the logarithm between.
      const double share = worst > best ? 1 - std::log(ratio) / std::log(worst / best) : 1;
      cell.set("tint", fmt::format("{:.0f}", 70 * share));
      cells << cell;
    }
    row.set("cells", cells);
    rows << row;
  }
  surface.set("rows", rows);
  return surface;
}

}  // namespace

std::string comparison_html(const Comparison& comparison, const std::string& name) {
  must::data view = page_of(name, comparison.spheres, threads_text(comparison.threads));
  view.set("comparison", true);
  view.set("fits", std::any_of(comparison.structures.begin(), comparison.structures.end(),
                               [](const StructureResult& one) { return one.fit.found(); }));
  view.set("answer", answer_of(comparison));
  view.set("same_bits", comparison.same_bits());
  view.set("first_threads", threads_text({comparison.threads.front()}));
  must::data threads{must::data::type::list};
  for (const int count : comparison.threads) {
    must::data one;
    one.set("threads", threads_text({count}));
    threads << one;
  }
  view.set("thread_counts", threads);

  const auto spheres = static_cast<double>(comparison.spheres);
  must::data structures{must::data::type::list};
  for (const StructureResult& one : comparison.structures) {
    must::data row;
    row.set("structure", one.row.name);
    row.set("title", one.row.title);
    row.set("build", readable_ms(one.build_ms));
    row.set("bytes_per_sphere", short_number(static_cast<double>(one.facts.bytes) / spheres));
    row.set("peak", one.peak_bytes < 0 ? "-" : readable_bytes(one.peak_bytes));
    if (one.fit.found()) {
      row.set("fit", true);
      row.set("fixed_ns", short_number(one.fit.fixed_ns));
      row.set("inner_ns", short_number(one.fit.inner_ns));
      row.set("leaf_ns", short_number(one.fit.leaf_ns));
      row.set("test_ns", short_number(one.fit.test_ns));
      row.set("rms", fmt::format("{:.1f} %", 100 * one.fit.rms));
      row.set("explained", std::isnan(one.fit.explained) ? "-" : fmt::format("{:.1f} %", 100 * one.fit.explained));
    }
    row.set("depth", std::to_string(one.facts.depth));
    row.set("nodes", grouped(one.facts.nodes));
    row.set("references", short_number(static_cast<double>(one.facts.references) / spheres));
    row.set("has_levels", !one.facts.levels.empty());
    row.set("levels", levels_of(one));
    structures << row;
  }
  view.set("structures", structures);

  must::data kinds{must::data::type::list};
  for (std::size_t k = 0; k < comparison.kinds.size(); ++k) {
    must::data kind;
    kind.set("title", grouped(comparison.queries[k]) + " " + name_of_kind(comparison, k));
    kind.set("none", comparison.queries[k] == 0);
    kind.set("counted", comparison.queries[k] > 0);
    kind.set("rows", rows_of(comparison, k));
    const double correlation = comparison.correlation[k];
    if (!std::isnan(correlation)) kind.set("correlation", fmt::format("{:.3f}", correlation));
    const double of_time = comparison.time_correlation[k];
    if (!std::isnan(of_time)) kind.set("time_correlation", fmt::format("{:.3f}", of_time));
    kinds << kind;
  }
  view.set("kinds", kinds);
  add_cost_pictures(comparison, view);
  return rendered(view);
}

std::string sweep_html(const workbench::Sweep& sweep, const std::string& name) {
  must::data view = page_of(name, sweep.spheres, threads_text({sweep.threads}));
  view.set("sweep", true);
  view.set("as_good", fmt::format("{:.0f} %", 100 * workbench::kAsGood));
  must::data structures{must::data::type::list};
  for (const workbench::SweptStructure& swept : sweep.structures) {
    must::data one;
    one.set("structure", swept.row.name);
    one.set("title", swept.row.title);
    one.set("by_work", text_of(swept.best_by_work().parameters));
    one.set("by_time", text_of(swept.best_by_time().parameters));
    must::data surfaces{must::data::type::list};
    surfaces << surface_of(sweep, swept, "Counted cost", &workbench::SweepCost::work,
                           &workbench::SweepPoint::good_by_work);
    surfaces << surface_of(sweep, swept, "Time", &workbench::SweepCost::ns, &workbench::SweepPoint::good_by_time);
    one.set("surfaces", surfaces);
    structures << one;
  }
  view.set("swept", structures);
  return rendered(view);
}

}  // namespace bihive::cli
