// bihive stats: statistics of the trees of an input.

#include <fmt/format.h>

#include "bihive/base/timer.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/job/failure.h"
#include "bihive/job/messages.h"
#include "bihive/render/memory.h"
#include "bihive/simd/target.h"
#include "bihive/viewer/statistics_json.h"
#include "commands/commands.h"

namespace bihive::cli {
namespace {

std::string limit_text(std::int64_t value) {
  return value == kUnlimited ? "unlimited" : grouped(value);
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
  row("bytes per sphere", fmt::format("{:.2f}", wide.bytes_per_sphere()));
  row("predicted low", grouped(wide.predicted.low_bytes));
  row("predicted high", grouped(wide.predicted.high_bytes));
  row("bytes really allocated", grouped(s.allocated_bytes));
  row("with working memory", grouped(wide.measured_peak_bytes));
  row("predicted", grouped(wide.predicted.peak_bytes));
  row("build", readable_ms(wide.build_ms));
}

// The rows of the thesis's Table 4.2 in its order, then further rows; the wide tree below.
void print_table(const Scene& scene, const ReferenceFacts& reference, const WideFacts& wide) {
  const TreeStatistics& statistics = reference.statistics;
  const CompactBytes bytes = compact_bytes(statistics.inner_nodes, statistics.leaves, statistics.spheres);
  print(fmt::format("{}: {} spheres, max_prims {}, max_depth {}{}\n", escaped(scene.name), grouped(statistics.spheres),
                    limit_text(reference.parameters.max_prims), limit_text(reference.parameters.max_depth),
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
  row("bytes really allocated", grouped(reference.allocated_bytes));
  row("build", readable_ms(reference.build_ms));
  print_wide_table(wide);
}

}  // namespace

void run_stats(const StatsOptions& options) {
  refuse_copies(options.input, "trees are built from the stored spheres");
  const Input input = load_input(options.input);
  const SphereSet& spheres = input.scene.spheres;
  for (const Engine engine : {Engine::reference, Engine::wide})
    value_or_fail(check_tree_memory(spheres, engine, options.tree));
  const WideFacts wide = wide_facts(value_or_fail(build_wide_tree(spheres, options.tree)));
  const Timer timer;
  const Tree tree = build_reference_tree(spheres, options.tree.for_reference());
  const ReferenceFacts reference = reference_facts(tree, timer.elapsed_ms());
  if (options.json)
    print(statistics_json(reference, wide, input.scene.seed) + "\n");
  else
    print_table(input.scene, reference, wide);
}

}  // namespace bihive::cli
