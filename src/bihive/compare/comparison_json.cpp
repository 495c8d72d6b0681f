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
  json["leaves"] = steps(kind.leaves);
  json["box_tests"] = steps(kind.box_tests);
  json["sphere_tests"] = steps(kind.sphere_tests);
  json["test_steps"] = steps(kind.test_steps);
  json["cost"] = kind.cost;
  json["different"] = kind.different;
  return json;
}

ordered_json begin(const char* format, const std::string& name, std::int64_t spheres) {
  ordered_json json = ordered_json::object();
  json[format] = 1;
  json["version"] = version();
  json["name"] = name;
  json["spheres"] = spheres;
  return json;
}

std::string text_of(const ordered_json& json) {
  return json.dump(2, ' ', true, ordered_json::error_handler_t::replace);
}

// Only those that are chosen.
ordered_json json_of(const StructureParameters& parameters) {
  ordered_json json = ordered_json::object();
  for (const ParameterRow& row : kStructureParameters)
    if (parameters.*row.value > 0) json[row.name] = parameters.*row.value;
  return json;
}

ordered_json json_of(const CostFit& fit) {
  if (!fit.found()) return nullptr;
  return {{"fixed_ns", fit.fixed_ns}, {"inner_ns", fit.inner_ns},   {"leaf_ns", fit.leaf_ns}, {"test_ns", fit.test_ns},
          {"rms", fit.rms},           {"explained", fit.explained}, {"groups", fit.groups}};
}

ordered_json json_of(const StructureResult& result) {
  ordered_json json = ordered_json::object();
  json["name"] = result.row.name;
  json["title"] = result.row.title;
  json["build_ms"] = result.build_ms;
  json["peak_bytes"] = result.peak_bytes >= 0 ? ordered_json(result.peak_bytes) : ordered_json();
  json["bytes"] = result.facts.bytes;
  json["nodes"] = result.facts.nodes;
  json["leaves"] = result.facts.leaves;
  json["references"] = result.facts.references;
  json["depth"] = result.facts.depth;
  json["expected"] = {{"nodes", result.facts.expected_nodes},
                      {"sphere_tests", result.facts.expected_spheres},
                      {"test_steps", result.facts.expected_test_steps},
                      {"cost", result.facts.expected_cost()}};
  json["levels"] = ordered_json::array();
  for (const LevelFacts& level : result.facts.levels)
    json["levels"].push_back({{"nodes", level.nodes},
                              {"leaves", level.leaves},
                              {"references", level.references},
                              {"expected_nodes", level.expected_nodes},
                              {"expected_sphere_tests", level.expected_spheres},
                              {"children", level.children},
                              {"overlap", level.overlap}});
  json["fit"] = json_of(result.fit);
  json["same_bits"] = result.same_bits();
  json["mray_per_s"] = ordered_json::object();
  json["kinds"] = ordered_json::object();
  for (const KindResult& kind : result.kinds) {
    const char* const name = row_of(kind.kind).name;
    json["mray_per_s"][name] = ordered_json::array();
    for (std::size_t t = 0; t < kind.ms.size(); ++t) json["mray_per_s"][name].push_back(kind.rate(t));
    json["kinds"][name] = json_of(kind);
  }
  return json;
}

}  // namespace

std::string comparison_json(const Comparison& comparison, const std::string& name) {
  ordered_json json = begin("bihive_comparison", name, comparison.spheres);
  json["threads"] = comparison.threads;
  json["target"] = active_target();
  json["same_bits"] = comparison.same_bits();
  json["queries"] = ordered_json::object();
  json["correlation"] = ordered_json::object();
  json["time_correlation"] = ordered_json::object();
  for (std::size_t k = 0; k < comparison.kinds.size(); ++k) {
    json["queries"][row_of(comparison.kinds[k]).name] = comparison.queries[k];
    json["correlation"][row_of(comparison.kinds[k]).name] = comparison.correlation[k];
    json["time_correlation"][row_of(comparison.kinds[k]).name] = comparison.time_correlation[k];
  }
  json["structures"] = ordered_json::array();
  for (const StructureResult& result : comparison.structures) {
    ordered_json one = json_of(result);
    one["bytes_per_sphere"] = static_cast<double>(result.facts.bytes) / static_cast<double>(comparison.spheres);
    json["structures"].push_back(std::move(one));
  }
  return text_of(json);
}

std::string sweep_json(const Sweep& sweep, const std::string& name) {
  ordered_json json = begin("bihive_sweep", name, sweep.spheres);
  json["threads"] = sweep.threads;
  json["target"] = active_target();
  json["queries"] = ordered_json::object();
  for (std::size_t k = 0; k < sweep.kinds.size(); ++k) json["queries"][row_of(sweep.kinds[k]).name] = sweep.queries[k];
  json["structures"] = ordered_json::array();
  for (const SweptStructure& swept : sweep.structures) {
    ordered_json points = ordered_json::array();
    for (const SweepPoint& point : swept.points) {
      ordered_json one = {{"parameters", json_of(point.parameters)},
                          {"build_ms", point.build_ms},
                          {"bytes", point.facts.bytes},
                          {"depth", point.facts.depth},
                          {"cost", point.mean.work},
                          {"ns", point.mean.ns},
                          {"good_by_work", point.good_by_work},
                          {"good_by_time", point.good_by_time},
                          {"different", point.different}};
      one["kinds"] = ordered_json::object();
      for (std::size_t k = 0; k < sweep.kinds.size(); ++k)
        one["kinds"][row_of(sweep.kinds[k]).name] = {{"cost", point.kinds[k].work}, {"ns", point.kinds[k].ns}};
      points.push_back(std::move(one));
    }
    json["structures"].push_back({{"name", swept.row.name}, {"title", swept.row.title}, {"points", points}});
  }
  return text_of(json);
}

std::string tuning_json(const Tuning& tuning, const std::string& name) {
  const auto json_of_candidate = [](const TuneCandidate& one) -> ordered_json {
    return {{"parameters", json_of(one.parameters)}, {"bytes", one.bytes}, {"depth", one.depth},  {"cost", one.work},
            {"counted_ns", one.counted_ns},          {"ns", one.ns},       {"rounds", one.rounds}};
  };
  ordered_json json = begin("bihive_tuning", name, tuning.spheres);
  json["threads"] = tuning.threads;
  json["target"] = active_target();
  json["structure"] = tuning.row.name;
  json["queries"] = ordered_json::object();
  for (std::size_t k = 0; k < tuning.kinds.size(); ++k)
    json["queries"][row_of(tuning.kinds[k]).name] = tuning.queries[k];
  json["fit"] = ordered_json::object();
  for (std::size_t k = 0; k < tuning.kinds.size(); ++k)
    json["fit"][row_of(tuning.kinds[k]).name] = json_of(tuning.costs[k]);
  json["calibration_ms"] = tuning.calibration_ms;
  json["best"] = json_of_candidate(tuning.best);
  json["own"] = json_of_candidate(tuning.own);
  json["gain"] = tuning.gain();
  json["candidates"] = ordered_json::array();
  for (const TuneCandidate& one : tuning.candidates) json["candidates"].push_back(json_of_candidate(one));
  return text_of(json);
}

std::string ray_paths_json(const std::vector<StructurePath>& paths, const std::string& name) {
  const auto distance = [](const Hit& hit) { return hit.found() ? ordered_json(hit.t) : ordered_json(); };
  ordered_json json = ordered_json::object();
  json["bihive_ray_paths"] = 1;
  json["version"] = version();
  json["name"] = name;
  json["structures"] = ordered_json::array();
  for (const StructurePath& path : paths) {
    ordered_json one = {
        {"name", path.name},        {"t", distance(path.hit())},        {"id", path.hit().sphere_id},
        {"nodes", path.work.nodes}, {"box_tests", path.work.box_tests}, {"sphere_tests", path.work.sphere_tests}};
    one["steps"] = ordered_json::array();
    for (const PathStep& step : path.steps)
      one["steps"].push_back({{"leaf", step.is_leaf},
                              {"box_tests", step.box_tests},
                              {"spheres", step.sphere_ids},
                              {"t", distance(step.best)}});
    json["structures"].push_back(std::move(one));
  }
  return text_of(json);
}

}  // namespace bihive::workbench
