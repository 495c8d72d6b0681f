// bihive stats: what the tree of an input looks like in numbers.

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "bihive/base/timer.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "commands.h"
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

void print_json(const Scene& scene, const Tree& tree, const TreeStatistics& statistics, double build_ms) {
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
  print(json.dump(2) + "\n");
}

// The rows of the thesis's Table 4.2 in its order, then what the table leaves out.
void print_table(const Scene& scene, const Tree& tree, const TreeStatistics& statistics, double build_ms) {
  const ThesisBytes bytes = thesis_bytes(statistics.inner_nodes, statistics.leaves, statistics.spheres);
  const auto row = [](const std::string& name, const std::string& value) {
    print(fmt::format("  {:<24}{:>16}\n", name, value));
  };
  const auto count = [&](const std::string& name, std::int64_t value) { row(name, grouped(value)); };
  const auto range = [&](const std::string& name, const MinAvgMax& value) {
    count(name + " min", value.min);
    row(name + " avg", fmt::format("{:.2f}", value.avg));
    count(name + " max", value.max);
  };

  print(fmt::format("{}: {} spheres, max_prims {}, max_depth {}{}\n", scene.name, grouped(statistics.spheres),
                    limit_text(tree.parameters.max_prims), limit_text(tree.parameters.max_depth),
                    scene.seed ? fmt::format(", seed {}", *scene.seed) : ""));
  count("inner nodes", statistics.inner_nodes);
  count("leaves", statistics.leaves);
  range("spheres per leaf", statistics.spheres_per_leaf);
  range("depth", statistics.depth);
  for (std::size_t i = 0; i < statistics.leaves_with.size(); ++i) {
    const std::string name = i < 5 ? "N = " + std::to_string(i) : "N > 4";
    const double share = 100 * static_cast<double>(statistics.leaves_with[i]) / static_cast<double>(statistics.leaves);
    row("leaves with " + name, fmt::format("{:.2f} %", share));
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
}

}  // namespace

void run_stats(const StatsOptions& options) {
  const Input input = load_input(options.input);
  check_tree_memory(input.scene.spheres, options.tree);
  const Timer timer;
  const Tree tree = build_reference_tree(input.scene.spheres, options.tree);
  const double build_ms = timer.elapsed_ms();
  const TreeStatistics statistics = tree_statistics(tree);
  (options.json ? print_json : print_table)(input.scene, tree, statistics, build_ms);
}

}  // namespace bihive::cli
