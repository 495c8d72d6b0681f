#include "thesis/against.h"

#include <fmt/format.h>

#include <set>

#include "bihive/base/json_text.h"
#include "bihive/base/write_file.h"
#include "support/failure.h"

namespace bihive::cli::thesis {
namespace {

// An array or an object at this key; nlohmann's own loops would take a number as a list of one, and null as an empty
// one.
const Json& list_at(const Json& object, const char* key) {
  const Json& list = object.at(key);
  if (!list.is_array()) throw Json::type_error::create(302, std::string(key) + " must be an array", &object);
  return list;
}

OlderRun parse_run(const Json& document, const std::string& file) {
  OlderRun older;
  older.file = file;
  const auto word = [&](const char* key) {
    const auto found = document.find(key);
    return found == document.end() ? "unknown" : found->get<std::string>();
  };
  older.version = word("version");
  older.commit = word("commit");
  older.machine = word("machine");
  older.date = word("date");
  for (const Json& experiment : list_at(document, "experiments"))
    for (const Json& finding : list_at(experiment, "findings"))
      older.findings[{experiment.at("id").get<std::string>(), finding.at("name").get<std::string>()}] = {
          finding.at("ours").get<std::string>(), finding.at("verdict").get<std::string>()};
  return older;
}

}  // namespace

OlderRun read_older_run(const std::string& file) {
  const Result<Json> parsed = json_from_text<Json>(value_or_fail(read_file(file)), file);
  const Json document = parsed ? *parsed : Json();
  const auto format = document.is_object() ? document.find("bihive_results") : document.end();
  if (format == document.end() || *format != 2 || !document.contains("experiments"))
    fail({"expected results.json of bihive thesis, format 2", file, 0, 0, "make one with bihive thesis all --out DIR"});
  try {
    return parse_run(document, file);
  } catch (const Json::exception& error) {
    fail({std::string("it is not as docs/results.schema.json says: ") + error.what(), file, 0, 0, ""});
  }
}

ReportFront compared_with(const OlderRun& older, const std::vector<ReportSection>& sections) {
  ReportFront front{"against", "Beside an older run", {}, {}, {}, {}, Json::array()};
  front.table.columns = {"Finding", "Then", "Now"};
  front.table.title = "Findings with another verdict, or with another value that no clock decides";
  int same = 0, changed = 0, moved = 0, fresh = 0, gone = 0;
  std::set<std::pair<std::string, std::string>> seen;

  const auto add = [&](const std::string& experiment, const Finding& now, const OlderRun::Words& then,
                       const char* what) {
    front.table.rows.push_back({{now.statement},
                                {fmt::format("{}: {}", then.verdict, then.ours)},
                                {fmt::format("{}: {}", name_of(now.verdict), now.ours)}});
    front.links.push_back(experiment);
    front.row_classes.emplace_back(std::string(what) == "verdict" ? "differs" : "undecided");
    front.data.push_back({{"experiment", experiment},
                          {"name", now.name},
                          {"changed", what},
                          {"then", then.verdict},
                          {"now", name_of(now.verdict)}});
  };
  for (const ReportSection& section : sections)
    for (const Finding& finding : section.section.findings) {
      const std::pair<std::string, std::string> key{section.id, finding.name};
      seen.insert(key);
      const auto found = older.findings.find(key);
      if (found == older.findings.end()) {
        ++fresh;
      } else if (found->second.verdict != name_of(finding.verdict)) {
        ++changed;
        add(section.id, finding, found->second, "verdict");
      } else if (!finding.timed && found->second.ours != finding.ours) {
        ++moved;
        add(section.id, finding, found->second, "value");
      } else {
        ++same;
      }
    }
  for (const auto& [key, words] : older.findings) gone += static_cast<int>(seen.count(key) == 0);

  front.paragraphs.push_back(fmt::format("{}: bihive {}, commit {}, on {}, {}.", older.file, older.version,
                                         older.commit, older.machine, older.date));
  front.paragraphs.push_back(fmt::format(
      "{} findings are as they were. {} have another verdict, {} the same verdict on another value; {} are new, and {} "
      "of the older run were not looked at now. Findings on time may change with machine and load; the others only "
      "with the program, the seed, and the size of the run (quick or full).",
      same, changed, moved, fresh, gone));
  return front;
}

}  // namespace bihive::cli::thesis
