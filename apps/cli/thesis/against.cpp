#include "thesis/against.h"

#include <fmt/format.h>

#include <map>
#include <set>

#include "bihive/base/write_file.h"
#include "support/failure.h"

namespace bihive::cli::thesis {
namespace {

Json parse_results(const std::string& file) {
  Json document = Json::parse(value_or_fail(read_file(file)), nullptr, /*allow_exceptions=*/false);
  if (!document.is_object() || document.value("bihive_results", 0) != 2 || !document.contains("experiments"))
    fail({"expected results.json of bihive thesis, format 2", file, 0, 0, "make one with bihive thesis all --out DIR"});
  return document;
}

// Experiment and name -> the older finding.
using Older = std::map<std::pair<std::string, std::string>, Json>;

Older findings_in(const Json& document, const std::string& file) {
  Older older;
  try {
    for (const Json& experiment : document.at("experiments"))
      for (const Json& finding : experiment.at("findings")) {
        for (const char* const key : {"statement", "expected", "ours", "verdict"})
          (void)finding.at(key).get_ref<const std::string&>();
        older[{experiment.at("id").get<std::string>(), finding.at("name").get<std::string>()}] = finding;
      }
  } catch (const Json::exception& error) {
    fail({std::string("a finding is not as docs/results.schema.json says: ") + error.what(), file, 0, 0, ""});
  }
  return older;
}

}  // namespace

ReportFront compared_with(const std::string& file, const std::vector<ReportSection>& sections) {
  const Json document = parse_results(file);
  const Older older = findings_in(document, file);
  ReportFront front{"against", "Beside an older run", {}, {}, {}, {}, Json::array()};
  front.table.columns = {"Finding", "Then", "Now"};
  front.table.title = "Findings with another verdict, or with another value that no clock decides";
  int same = 0, changed = 0, moved = 0, fresh = 0, gone = 0;
  std::set<std::pair<std::string, std::string>> seen;

  const auto add = [&](const std::string& experiment, const Finding& now, const Json& then, const char* what) {
    front.table.rows.push_back(
        {{now.statement},
         {fmt::format("{}: {}", then["verdict"].get<std::string>(), then["ours"].get<std::string>())},
         {fmt::format("{}: {}", name_of(now.verdict), now.ours)}});
    front.links.push_back(experiment);
    front.row_classes.emplace_back(std::string(what) == "verdict" ? "differs" : "undecided");
    front.data.push_back({{"experiment", experiment},
                          {"name", now.name},
                          {"changed", what},
                          {"then", then["verdict"]},
                          {"now", name_of(now.verdict)}});
  };
  for (const ReportSection& section : sections)
    for (const Finding& finding : section.section.findings) {
      const std::pair<std::string, std::string> key{section.id, finding.name};
      seen.insert(key);
      const auto found = older.find(key);
      if (found == older.end()) {
        ++fresh;
      } else if (found->second["verdict"] != name_of(finding.verdict)) {
        ++changed;
        add(section.id, finding, found->second, "verdict");
      } else if (!finding.timed && found->second["ours"] != finding.ours) {
        ++moved;
        add(section.id, finding, found->second, "value");
      } else {
        ++same;
      }
    }
  for (const auto& [key, finding] : older) gone += static_cast<int>(seen.count(key) == 0);

  const auto word = [&](const char* key) { return document.value(key, std::string("unknown")); };
  front.paragraphs.push_back(fmt::format("{}: bihive {}, commit {}, on {}, {}.", file, word("version"), word("commit"),
                                         word("machine"), word("date")));
  front.paragraphs.push_back(fmt::format(
      "{} findings are as they were. {} have another verdict, {} the same verdict on another value; {} are new, and {} "
      "of "
      "the older run were not looked at now. Findings on time may change with machine and load; the others only "
      "with the program, the seed, and the size of the run (quick or full).",
      same, changed, moved, fresh, gone));
  return front;
}

}  // namespace bihive::cli::thesis
