#include "against.h"

#include <set>

#include "bihive/base/json_text.h"
#include "bihive/base/write_file.h"
#include "support/failure.h"

namespace bihive::thesis {
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
  const Result<Json> parsed = json_from_text<Json>(cli::value_or_fail(read_file(file)), file);
  const Json document = parsed ? *parsed : Json();
  const auto format = document.is_object() ? document.find("bihive_results") : document.end();
  if (format == document.end() || *format != 3 || !document.contains("experiments"))
    cli::fail(
        {"expected results.json of bihive thesis, format 3", file, 0, 0, "make one with bihive thesis all --out DIR"});
  try {
    return parse_run(document, file);
  } catch (const Json::exception& error) {
    cli::fail({std::string("it is not as docs/results.schema.json says: ") + error.what(), file, 0, 0, ""});
  }
}

Json compared_with(const OlderRun& older, const std::vector<ReportPart>& parts) {
  int same = 0, changed = 0, moved = 0, fresh = 0, gone = 0;
  Json rows = Json::array();
  std::set<std::pair<std::string, std::string>> seen;
  for (const ReportPart& part : parts)
    for (const Finding& finding : part.findings) {
      const std::pair<std::string, std::string> key{part.experiment->id, finding.name};
      seen.insert(key);
      const auto then = older.findings.find(key);
      if (then == older.findings.end()) {
        ++fresh;
        continue;
      }
      const bool other_verdict = then->second.verdict != name_of(finding.verdict);
      if (!other_verdict && then->second.ours == finding.ours) {
        ++same;
        continue;
      }
      ++(other_verdict ? changed : moved);
      rows.push_back({{"experiment", part.experiment->id},
                      {"name", finding.name},
                      {"claim", finding.claim + (finding.row.empty() ? "" : ": " + finding.row)},
                      {"changed", other_verdict ? "verdict" : "value"},
                      {"then", then->second.verdict},
                      {"now", name_of(finding.verdict)},
                      {"then_ours", then->second.ours},
                      {"now_ours", finding.ours}});
    }
  for (const auto& [key, words] : older.findings) gone += static_cast<int>(seen.count(key) == 0);
  return {{"file", older.file},     {"version", older.version},
          {"commit", older.commit}, {"machine", older.machine},
          {"date", older.date},     {"same", same},
          {"changed", changed},     {"moved", moved},
          {"fresh", fresh},         {"gone", gone},
          {"rows", std::move(rows)}};
}

}  // namespace bihive::thesis
