// results.json: everything of the report for machines.
#include "thesis/report.h"

namespace bihive::cli::thesis {
namespace {

Json table_json(const Table& table) {
  Json rows = Json::array();
  for (const std::vector<Cell>& row : table.rows) {
    Json cells = Json::array();
    for (const Cell& cell : row) {
      Json one{{"text", cell.text}, {"verdict", name_of(cell.verdict)}};
      if (cell.verdict != Verdict::none) one["kind"] = name_of(cell.kind);
      cells.push_back(std::move(one));
    }
    rows.push_back(std::move(cells));
  }
  return {{"title", table.title}, {"columns", table.columns}, {"rows", std::move(rows)}, {"note", table.note}};
}

Json counts_json(const VerdictCounts& counts) {
  const auto of = [](const VerdictCounts::OfKind& kind) -> Json {
    return {{"agrees", kind.agrees}, {"differs", kind.differs}, {"undecided", kind.undecided}};
  };
  return {{"stated", of(counts.stated)},
          {"inferred", of(counts.inferred)},
          {"own_check", of(counts.own_check)},
          {"text_inconsistent", counts.text_inconsistent}};
}

Json load_json(const MachineLoad& load) {
  return {{"seconds", load.seconds},
          {"others", load.known ? Json(load.others) : Json()},
          {"most_others", load.known ? Json(load.most_others) : Json()},
          {"busy", load.busy()}};
}

// Everything of a section and its parts, in the order of the report.
struct Flat {
  Json paragraphs = Json::array(), tables = Json::array(), illustrations = Json::array();

  void add(const Section& section) {
    for (const std::string& paragraph : section.paragraphs) paragraphs.push_back(paragraph);
    for (const Illustration& illustration : section.illustrations)
      illustrations.push_back({{"file", illustration.file}, {"caption", illustration.caption}});
    for (const Table& table : section.tables) tables.push_back(table_json(table));
    for (const Section& part : section.parts) add(part);
  }
};

Json findings_json(const Section& section) {
  Json findings = Json::array();
  for (const Finding& finding : section.findings)
    findings.push_back({{"name", finding.name},
                        {"statement", finding.statement},
                        {"kind", name_of(finding.kind)},
                        {"expected", finding.expected},
                        {"ours", finding.ours},
                        {"verdict", name_of(finding.verdict)},
                        {"timed", finding.timed}});
  return findings;
}

}  // namespace

VerdictCounts count_verdicts(const Section& section) {
  VerdictCounts counts;
  for (const Finding& finding : section.findings) {
    VerdictCounts::OfKind& of_kind = finding.kind == ValueKind::stated     ? counts.stated
                                     : finding.kind == ValueKind::inferred ? counts.inferred
                                                                           : counts.own_check;
    if (finding.verdict == Verdict::agrees) ++of_kind.agrees;
    if (finding.verdict == Verdict::differs) ++of_kind.differs;
    if (finding.verdict == Verdict::undecided) ++of_kind.undecided;
    if (finding.verdict == Verdict::text_inconsistent) ++counts.text_inconsistent;
  }
  return counts;
}

Json results_json(const ReportHeader& header, const std::vector<ReportFront>& fronts,
                  const std::vector<ReportSection>& sections) {
  bool complete = true;
  Json experiments = Json::array();
  for (const ReportSection& section : sections) {
    complete = complete && section.missing_steps.empty();
    Flat flat;
    flat.add(section.section);
    experiments.push_back({{"id", section.id},
                           {"title", section.title},
                           {"missing_steps", section.missing_steps},
                           {"counts", counts_json(count_verdicts(section.section))},
                           {"load", load_json(section.load)},
                           {"findings", findings_json(section.section)},
                           {"paragraphs", std::move(flat.paragraphs)},
                           {"tables", std::move(flat.tables)},
                           {"illustrations", std::move(flat.illustrations)},
                           {"data", section.section.data},
                           {"stated", section.values ? section.values->document()["values"] : Json::object()}});
  }
  const Settings& settings = header.settings;
  Json results{{"bihive_results", 2},
               {"version", header.version},
               {"commit", header.commit},
               {"command", header.command},
               {"compiler", header.compiler},
               {"machine", header.machine},
               {"load", load_json(header.load)},
               {"date", header.date},
               {"settings", {{"quick", settings.quick}, {"seed", settings.seed}, {"threads", settings.threads}}},
               {"complete", complete},
               {"experiments", std::move(experiments)}};
  for (const ReportFront& front : fronts) results[front.id] = front.data;
  return results;
}

}  // namespace bihive::cli::thesis
