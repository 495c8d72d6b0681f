#include "bihive/compare/comparison_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "bihive/base/version.h"
#include "bihive/simd/target.h"

namespace bihive::workbench {
namespace {

using nlohmann::ordered_json;

// nlohmann writes NaN as null.
ordered_json steps(const StepStatistics& statistics) {
  return {{"mean", statistics.mean}, {"99_percent", statistics.most_of_99}};
}

ordered_json json_of(const KindResult& kind) {
  ordered_json json = ordered_json::object();
  json["queries"] = kind.queries;
  if (kind.queries == 0) return json;
  json["nodes"] = steps(kind.nodes);
  json["box_tests"] = steps(kind.box_tests);
  json["sphere_tests"] = steps(kind.sphere_tests);
  json["cost"] = kind.cost;
  json["different"] = kind.different;
  return json;
}

ordered_json json_of(const StructureResult& result) {
  ordered_json json = ordered_json::object();
  json["name"] = result.row.name;
  json["title"] = result.row.title;
  json["build_ms"] = result.build_ms;
  json["bytes"] = result.facts.bytes;
  json["nodes"] = result.facts.nodes;
  json["leaves"] = result.facts.leaves;
  json["references"] = result.facts.references;
  json["depth"] = result.facts.depth;
  json["expected"] = {{"nodes", result.facts.expected_nodes},
                      {"sphere_tests", result.facts.expected_spheres},
                      {"cost", result.facts.expected_cost()}};
  json["same_bits"] = result.same_bits();
  json["mray_per_s"] = ordered_json::object();
  json["kinds"] = ordered_json::object();
  for (const KindResult& kind : result.kinds) {
    const char* const name = row_of(kind.kind).name;
    json["mray_per_s"][name] = kind.queries > 0 ? ordered_json(kind.rate()) : ordered_json();
    json["kinds"][name] = json_of(kind);
  }
  return json;
}

}  // namespace

std::string comparison_json(const Comparison& comparison, const std::string& name) {
  ordered_json json = ordered_json::object();
  json["bihive_comparison"] = 1;
  json["version"] = version();
  json["name"] = name;
  json["spheres"] = comparison.spheres;
  json["threads"] = comparison.threads;
  json["target"] = active_target();
  json["same_bits"] = comparison.same_bits();
  json["queries"] = ordered_json::object();
  json["correlation"] = ordered_json::object();
  for (std::size_t k = 0; k < comparison.kinds.size(); ++k) {
    json["queries"][row_of(comparison.kinds[k]).name] = comparison.queries[k];
    json["correlation"][row_of(comparison.kinds[k]).name] = comparison.correlation[k];
  }
  json["structures"] = ordered_json::array();
  for (const StructureResult& result : comparison.structures) {
    ordered_json one = json_of(result);
    one["bytes_per_sphere"] = static_cast<double>(result.facts.bytes) / static_cast<double>(comparison.spheres);
    json["structures"].push_back(std::move(one));
  }
  return json.dump(2, ' ', true, ordered_json::error_handler_t::replace);
}

}  // namespace bihive::workbench
