#include "bihive/viewer/statistics_json.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "bihive/base/timer.h"
#include "bihive/simd/target.h"

namespace bihive {
namespace {

using nlohmann::ordered_json;

constexpr const char* kLeafSizes[] = {"0", "1", "2", "3", "4", "more"};

ordered_json limit(std::int64_t value) {
  return value == kUnlimited ? ordered_json() : ordered_json(value);
}

ordered_json min_avg_max(const MinAvgMax& value) {
  return {{"min", value.min}, {"avg", value.avg}, {"max", value.max}};
}

ordered_json wide_json(const WideFacts& wide) {
  const auto chosen = [](std::int64_t value) { return value == 0 ? ordered_json() : ordered_json(value); };
  const WideStatistics& s = wide.statistics;
  ordered_json facts = ordered_json::object();
  facts["nodes"] = s.nodes;
  facts["leaves"] = s.leaves;
  facts["levels"] = s.levels;
  facts["children"] = min_avg_max(s.children);
  facts["spheres_per_leaf"] = min_avg_max(s.spheres_per_leaf);
  facts["nodes_above_leaf"] = min_avg_max(s.nodes_above_leaf);
  facts["node_fill"] = s.node_fill;
  facts["leaf_fill"] = s.leaf_fill;
  facts["overlap"] = s.overlap;
  facts["expected_cost"] = {
      {"nodes", s.expected_nodes}, {"leaves", s.expected_leaves}, {"spheres", s.expected_spheres}};
  facts["bytes"] = {
      {"nodes", s.node_bytes}, {"spheres", s.sphere_bytes}, {"other", s.other_bytes}, {"total", s.used_bytes}};
  facts["bytes_per_sphere"] = wide.bytes_per_sphere();
  facts["allocated_bytes"] = s.allocated_bytes;
  facts["predicted_bytes"] = {{"low", wide.predicted.low_bytes}, {"high", wide.predicted.high_bytes}};
  facts["peak_bytes"] = {{"predicted", wide.predicted.peak_bytes}, {"measured", wide.measured_peak_bytes}};
  facts["build_ms"] = wide.build_ms;
  facts["target"] = active_target();
  facts["max_prims"] = chosen(wide.parameters.max_prims);
  facts["max_depth"] = chosen(wide.parameters.max_depth);
  return facts;
}

}  // namespace

ReferenceFacts reference_facts(const Tree& tree, double build_ms) {
  return {tree_statistics(tree), tree.parameters, tree.allocated_bytes(), build_ms};
}

Result<BuiltWideTree> build_wide_tree(const SphereSet& spheres, const TreeParameters& parameters) {
  BuiltWideTree built;
  built.parameters = parameters.for_wide(spheres.size());
  WideBuilder builder;
  const Timer timer;
  Result<std::shared_ptr<const WideTree>> tree = builder.build(spheres, built.parameters);
  if (!tree) return tree.error();
  built.build_ms = timer.elapsed_ms();
  built.tree = std::move(*tree);
  built.scratch_bytes = builder.scratch_bytes();
  return built;
}

WideFacts wide_facts(const BuiltWideTree& built) {
  const WideTree& tree = *built.tree;
  return {wide_statistics(tree), built.parameters, predict_wide_memory(tree.size, built.parameters),
          tree.allocated_bytes() + built.scratch_bytes, built.build_ms};
}

std::string statistics_json(const ReferenceFacts& reference, const WideFacts& wide, std::optional<std::uint64_t> seed) {
  const TreeStatistics& statistics = reference.statistics;
  const CompactBytes bytes = compact_bytes(statistics.inner_nodes, statistics.leaves, statistics.spheres);
  ordered_json json = ordered_json::object();
  json["spheres"] = statistics.spheres;
  json["inner_nodes"] = statistics.inner_nodes;
  json["leaves"] = statistics.leaves;
  json["optimized_nodes"] = statistics.optimized_nodes;
  json["one_sided_nodes"] = statistics.one_sided_nodes;
  json["forced_leaves"] = statistics.forced_leaves;
  json["spheres_per_leaf"] = min_avg_max(statistics.spheres_per_leaf);
  json["depth"] = min_avg_max(statistics.depth);
  for (std::size_t i = 0; i < statistics.leaves_with.size(); ++i)
    json["leaves_with"][kLeafSizes[i]] = statistics.leaves_with[i];
  json["bytes"] = {{"nodes", bytes.nodes}, {"indices", bytes.indices}, {"aabb", bytes.aabb}, {"total", bytes.total()}};
  json["allocated_bytes"] = reference.allocated_bytes;
  json["build_ms"] = reference.build_ms;
  json["max_prims"] = limit(reference.parameters.max_prims);
  json["max_depth"] = limit(reference.parameters.max_depth);
  json["seed"] = seed ? ordered_json(*seed) : ordered_json();
  json["wide"] = wide_json(wide);
  return json.dump(2);
}

std::string statistics_error(const Error& error) {
  return ordered_json{{"error", error.to_string()}}.dump();
}

}  // namespace bihive
