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

namespace bihive::cli {
namespace {

namespace must = kainjow::mustache;
using workbench::Comparison;
using workbench::KindResult;
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

std::string name_of(const Comparison& comparison, std::size_t k) {
  const workbench::QueryKindRow& row = workbench::row_of(comparison.kinds[k]);
  return row.kind == workbench::QueryKind::points ? row.name : std::string(row.name) + " rays";
}

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

}  // namespace

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
      won.push_back(name_of(comparison, k));
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

std::string comparison_html(const Comparison& comparison, const std::string& name) {
  must::data view;
  view.set("name", name);
  view.set("answer", answer_of(comparison));
  view.set("same_bits", comparison.same_bits());
  view.set("threads", fmt::format("{} thread{}", comparison.threads, comparison.threads == 1 ? "" : "s"));
  view.set("spheres", grouped(comparison.spheres));
  view.set("machine", processor_name());
  view.set("target", active_target());
  view.set("version", std::string(version()));
  if (!std::string(commit()).empty()) view.set("commit", std::string(commit()));

  const auto spheres = static_cast<double>(comparison.spheres);
  must::data structures{must::data::type::list};
  for (const StructureResult& one : comparison.structures) {
    must::data row;
    row.set("structure", one.row.name);
    row.set("title", one.row.title);
    row.set("build", readable_ms(one.build_ms));
    row.set("bytes_per_sphere", short_number(static_cast<double>(one.facts.bytes) / spheres));
    row.set("depth", std::to_string(one.facts.depth));
    row.set("nodes", grouped(one.facts.nodes));
    row.set("references", short_number(static_cast<double>(one.facts.references) / spheres));
    structures << row;
  }
  view.set("structures", structures);

  must::data kinds{must::data::type::list};
  for (std::size_t k = 0; k < comparison.kinds.size(); ++k) {
    must::data kind;
    kind.set("title", grouped(comparison.queries[k]) + " " + name_of(comparison, k));
    kind.set("none", comparison.queries[k] == 0);
    kind.set("counted", comparison.queries[k] > 0);
    kind.set("rows", rows_of(comparison, k));
    const double correlation = comparison.correlation[k];
    if (!std::isnan(correlation)) kind.set("correlation", fmt::format("{:.3f}", correlation));
    kinds << kind;
  }
  view.set("kinds", kinds);

  must::mustache page{std::string(comparison_template())};
  page.set_custom_escape([](const std::string& text) { return escape_html(text); });
  if (!page.is_valid()) fail({"the template of the report: " + page.error_message(), "", 0, 0, ""});
  return page.render(view);
}

}  // namespace bihive::cli
