// Compares a run with an older one.
#include "bihive/base/json_text.h"
#include "bihive/base/write_file.h"
#include "report.h"

namespace bihive::thesis {
namespace {

// An array at this key; nlohmann's own loops would treat a number as a list of one, and null as an empty one.
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
  const Result<Json> parsed = json_from_text<Json>(value_or_fail(read_file(file)), file);
  const Json document = parsed ? *parsed : Json();
  const auto format = document.is_object() ? document.find("bihive_results") : document.end();
  if (format == document.end() || *format != 3 || !document.contains("experiments"))
    fail({"expected results.json of bihive thesis, format 3", file, 0, 0, "make one with bihive thesis all --out DIR"});
  try {
    return parse_run(document, file);
  } catch (const Json::exception& error) {
    fail({std::string("it is not as docs/results.schema.json says: ") + error.what(), file, 0, 0, ""});
  }
}

Json compared_with(Json older, const std::list<Experiment>& parts) {
  std::map<std::string, int> counts{{"same", 0}, {"changed", 0}, {"moved", 0}, {"fresh", 0}};
  Json rows = Json::array();
  Json& findings = older["findings"];
  for (const Experiment& part : parts)
    for (const Json& now : part.findings) {
      const std::string key = part.id + " " + now["name"].get<std::string>();
      const Json then = findings.value(key, Json());
      const bool fresh = then.is_null(), same = !fresh && then["verdict"] == now["verdict"];
      findings.erase(key);
      ++counts[fresh ? "fresh" : !same ? "changed" : then["ours"] != now["ours"] ? "moved" : "same"];
      if (fresh || (same && then["ours"] == now["ours"])) continue;
      const std::string claim = now["claim"], row = now["row"];
      rows.push_back({{"experiment", part.id},
                      {"name", now["name"]},
                      {"claim", claim + (row.empty() ? "" : ": " + row)},
                      {"changed", same ? "value" : "verdict"},
                      {"then", then["verdict"]},
                      {"now", now["verdict"]},
                      {"then_ours", then["ours"]},
                      {"now_ours", now["ours"]}});
    }
  older["gone"] = findings.size();
  older.erase("findings");
  older.update(counts);
  older["rows"] = std::move(rows);
  return older;
}

}  // namespace bihive::thesis
