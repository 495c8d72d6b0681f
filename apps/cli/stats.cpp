// bihive stats: what the trees of an input look like in numbers.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bihive/base/timer.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/kernels/target.h"
#include "bihive/kernels/wide_builder.h"
#include "bihive/kernels/wide_statistics.h"
#include "commands.h"
#include "failure.h"
#include "messages.h"

namespace bihive::cli {
namespace {

using nlohmann::ordered_json;

constexpr const char* kLeafSizes[] = {"0", "1", "2", "3", "4", "more"};

ordered_json limit(std::int64_t value) {
  return value == kUnlimited ? ordered_json() : ordered_json(value);
}

std::string limit_text(std::int64_t value) {
  return value == kUnlimited ? "unlimited" : grouped(value);
}

ordered_json min_avg_max(const MinAvgMax& value) {
  return {{"min", value.min}, {"avg", value.avg}, {"max", value.max}};
}

// The wide tree with what was said of its memory before it was built.
struct WideFacts {
  WideStatistics statistics;
  WideParameters parameters;
  WideMemoryPrediction predicted;
  std::int64_t measured_peak_bytes;  // tree and working memory
  double build_ms;

  double bytes_per_sphere() const {
    return static_cast<double>(statistics.used_bytes) / static_cast<double>(statistics.spheres);
  }
};

WideFacts wide_facts(const SphereSet& spheres, const TreeParameters& tree) {
  const WideParameters parameters = tree.for_wide(spheres.size());
  WideBuilder builder;
  const Timer timer;
  const std::shared_ptr<const WideTree> built = value_or_fail(builder.build(spheres, parameters));
  const double build_ms = timer.elapsed_ms();
  return {wide_statistics(*built), parameters, predict_wide_memory(spheres.size(), parameters),
          built->allocated_bytes() + builder.scratch_bytes(), build_ms};
}

ordered_json wide_json(const WideFacts& wide) {
  const auto chosen = [](std::int64_t value) { return value == 0 ? ordered_json() : ordered_json(value); };
  const WideStatistics& s = wide.statistics;
  ordered_json json;
  json["nodes"] = s.nodes;
  json["leaves"] = s.leaves;
  json["levels"] = s.levels;
  json["children"] = min_avg_max(s.children);
  json["spheres_per_leaf"] = min_avg_max(s.spheres_per_leaf);
  json["nodes_above_leaf"] = min_avg_max(s.nodes_above_leaf);
  json["node_fill"] = s.node_fill;
  json["leaf_fill"] = s.leaf_fill;
  json["overlap"] = s.overlap;
  json["expected_cost"] = {{"nodes", s.expected_nodes}, {"leaves", s.expected_leaves}, {"spheres", s.expected_spheres}};
  json["bytes"] = {
      {"nodes", s.node_bytes}, {"spheres", s.sphere_bytes}, {"other", s.other_bytes}, {"total", s.used_bytes}};
  json["bytes_per_sphere"] = wide.bytes_per_sphere();
  json["allocated_bytes"] = s.allocated_bytes;
  json["predicted_bytes"] = {{"low", wide.predicted.low_bytes}, {"high", wide.predicted.high_bytes}};
  json["peak_bytes"] = {{"predicted", wide.predicted.peak_bytes}, {"measured", wide.measured_peak_bytes}};
  json["build_ms"] = wide.build_ms;
  json["target"] = active_target();
  json["max_prims"] = chosen(wide.parameters.max_prims);
  json["max_depth"] = chosen(wide.parameters.max_depth);
  return json;
}

void print_json(const Scene& scene, const Tree& tree, const TreeStatistics& statistics, double build_ms,
                const WideFacts& wide) {
  const ThesisBytes bytes = thesis_bytes(statistics.inner_nodes, statistics.leaves, statistics.spheres);
  ordered_json json;
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
  json["allocated_bytes"] = tree.allocated_bytes();
  json["build_ms"] = build_ms;
  json["max_prims"] = limit(tree.parameters.max_prims);
  json["max_depth"] = limit(tree.parameters.max_depth);
  json["seed"] = scene.seed ? ordered_json(*scene.seed) : ordered_json();
  json["wide"] = wide_json(wide);
  print(json.dump(2) + "\n");
}

void row(const std::string& name, const std::string& value) {
  print(fmt::format("  {:<24}{:>16}\n", name, value));
}

void count(const std::string& name, std::int64_t value) {
  row(name, grouped(value));
}

void range(const std::string& name, const MinAvgMax& value) {
  count(name + " min", value.min);
  row(name + " avg", fmt::format("{:.2f}", value.avg));
  count(name + " max", value.max);
}

std::string percent(double share) {
  return fmt::format("{:.2f} %", 100 * share);
}

void print_wide_table(const WideFacts& wide) {
  const auto chosen = [](std::int64_t value) { return value == 0 ? "the engine's choice" : grouped(value); };
  const WideStatistics& s = wide.statistics;
  print(fmt::format("wide tree: max_prims {}, max_depth {}, built on {}\n", chosen(wide.parameters.max_prims),
                    chosen(wide.parameters.max_depth), active_target()));
  count("nodes", s.nodes);
  count("leaves", s.leaves);
  count("levels", s.levels);
  range("children", s.children);
  range("spheres per leaf", s.spheres_per_leaf);
  range("nodes above a leaf", s.nodes_above_leaf);
  row("fill of nodes", percent(s.node_fill));
  row("fill of leaves", percent(s.leaf_fill));
  row("overlap of siblings", fmt::format("{:.2f}", s.overlap));
  row("expected nodes", fmt::format("{:.2f}", s.expected_nodes));
  row("expected leaves", fmt::format("{:.2f}", s.expected_leaves));
  row("expected spheres", fmt::format("{:.2f}", s.expected_spheres));
  row("bytes, nodes", grouped(s.node_bytes));
  row("bytes, spheres", grouped(s.sphere_bytes));
  row("bytes, other", grouped(s.other_bytes));
  row("bytes, total", grouped(s.used_bytes));
  row("bytes a sphere", fmt::format("{:.2f}", wide.bytes_per_sphere()));
  row("predicted low", grouped(wide.predicted.low_bytes));
  row("predicted high", grouped(wide.predicted.high_bytes));
  row("bytes really allocated", grouped(s.allocated_bytes));
  row("with working memory", grouped(wide.measured_peak_bytes));
  row("predicted at most", grouped(wide.predicted.peak_bytes));
  row("build", readable_ms(wide.build_ms));
}

// The rows of the thesis's Table 4.2 in its order, then what the table leaves out; the wide tree below.
void print_table(const Scene& scene, const Tree& tree, const TreeStatistics& statistics, double build_ms,
                 const WideFacts& wide) {
  const ThesisBytes bytes = thesis_bytes(statistics.inner_nodes, statistics.leaves, statistics.spheres);
  print(fmt::format("{}: {} spheres, max_prims {}, max_depth {}{}\n", scene.name, grouped(statistics.spheres),
                    limit_text(tree.parameters.max_prims), limit_text(tree.parameters.max_depth),
                    scene.seed ? fmt::format(", seed {}", *scene.seed) : ""));
  count("inner nodes", statistics.inner_nodes);
  count("leaves", statistics.leaves);
  range("spheres per leaf", statistics.spheres_per_leaf);
  range("depth", statistics.depth);
  for (std::size_t i = 0; i < statistics.leaves_with.size(); ++i) {
    const std::string name = i < 5 ? "N = " + std::to_string(i) : "N > 4";
    row("leaves with " + name,
        percent(static_cast<double>(statistics.leaves_with[i]) / static_cast<double>(statistics.leaves)));
  }
  count("optimized nodes", statistics.optimized_nodes);
  count("one-sided nodes", statistics.one_sided_nodes);
  count("forced leaves", statistics.forced_leaves);
  row("bytes, nodes", grouped(bytes.nodes));
  row("bytes, indices", grouped(bytes.indices));
  row("bytes, box", grouped(bytes.aabb));
  row("bytes, total", grouped(bytes.total()));
  row("bytes really allocated", grouped(tree.allocated_bytes()));
  row("build", readable_ms(build_ms));
  print_wide_table(wide);
}

}  // namespace

void run_stats(const StatsOptions& options) {
  const Input input = load_input(options.input);
  const SphereSet& spheres = input.scene.spheres;
  check_tree_memory(spheres, options.tree.for_reference());
  check_tree_memory(spheres, Engine::wide, options.tree);
  const WideFacts wide = wide_facts(spheres, options.tree);
  const Timer timer;
  const Tree tree = build_reference_tree(spheres, options.tree.for_reference());
  const double build_ms = timer.elapsed_ms();
  const TreeStatistics statistics = tree_statistics(tree);
  (options.json ? print_json : print_table)(input.scene, tree, statistics, build_ms, wide);
}

}  // namespace bihive::cli
