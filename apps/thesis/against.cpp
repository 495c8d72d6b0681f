#include "against.h"

#include "bihive/base/json_text.h"
#include "bihive/base/write_file.h"
#include "support/failure.h"

namespace bihive::thesis {
namespace {

// An array at this key; nlohmann's own loops would take a number as a list of one, and null as an empty one.
const Json& list_at(const Json& object, const char* key) {
  const Json& list = object.at(key);
  if (!list.is_array()) throw Json::type_error::create(302, std::string(key) + " must be an array", &object);
  return list;
}

Json parse_run(const Json& document, const std::string& file) {
  Json older{{"file", file}};
  for (const char* const key : {"version", "commit", "machine", "date"})
    older[key] = document.value(key, std::string("unknown"));
  Json& findings = older["findings"] = Json::object();
  for (const Json& experiment : list_at(document, "experiments"))
    for (const Json& finding : list_at(experiment, "findings"))
      findings[experiment.at("id").get<std::string>() + " " + finding.at("name").get<std::string>()] = {
          {"ours", finding.at("ours").get<std::string>()}, {"verdict", finding.at("verdict").get<std::string>()}};
  return older;
}

}  // namespace

Json read_older_run(const std::string& file) {
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

Json compared_with(Json older, const std::vector<ReportPart>& parts) {
  int same = 0, changed = 0, moved = 0, fresh = 0;
  Json rows = Json::array();
  Json& findings = older["findings"];
  for (const ReportPart& part : parts)
    for (const Finding& finding : part.findings) {
      const auto found = findings.find(part.experiment->id + " " + finding.name);
      if (found == findings.end()) {
        ++fresh;
        continue;
      }
      const Json then = *found;
      findings.erase(found);
      const bool other_verdict = then["verdict"] != name_of(finding.verdict);
      if (!other_verdict && then["ours"] == finding.ours) {
        ++same;
        continue;
      }
      ++(other_verdict ? changed : moved);
      rows.push_back({{"experiment", part.experiment->id},
                      {"name", finding.name},
                      {"claim", finding.claim + (finding.row.empty() ? "" : ": " + finding.row)},
                      {"changed", other_verdict ? "verdict" : "value"},
                      {"then", then["verdict"]},
                      {"now", name_of(finding.verdict)},
                      {"then_ours", then["ours"]},
                      {"now_ours", finding.ours}});
    }
  const std::size_t gone = findings.size();
  older.erase("findings");
  older.update({{"same", same},
                {"changed", changed},
                {"moved", moved},
                {"fresh", fresh},
                {"gone", gone},
                {"rows", std::move(rows)}});
  return older;
}

}  // namespace bihive::thesis
