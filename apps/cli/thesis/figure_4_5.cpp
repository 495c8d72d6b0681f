// Figure 4.5: the memory of the tree, predicted, as the thesis counts it, and as this program allocates it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "bihive/base/parallel.h"
#include "bihive/base/write_file.h"
#include "bihive/bih/memory.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/bih/validate.h"
#include "bihive/image/svg_chart.h"
#include "bihive/scene/generators.h"
#include "support/failure.h"
#include "support/messages.h"
#include "thesis/compare.h"
#include "thesis/experiment.h"

namespace bihive::cli::thesis {
namespace {

// The seeds 1, 2, ... for mean and standard deviation.
constexpr std::int64_t kSeeds = 100;
constexpr std::int64_t kQuickSeeds = 20;
// Two means of the same quantity lie within this many standard errors of each other.
constexpr double kStandardErrors = 4;

constexpr const char* kRadiusStep = "radius";

std::string step_name(std::int64_t scenario) {
  return fmt::format("scenario{}", scenario);
}

double thesis_count(const Values& values, const Tree& tree, std::int64_t spheres) {
  const TreeStatistics s = tree_statistics(tree);
  return values.number("node_bytes") * static_cast<double>(s.inner_nodes + s.leaves) +
         values.number("index_bytes") * static_cast<double>(spheres) + values.number("aabb_bytes");
}

Json measure_tree(StepContext& context, Scenario scenario, std::int64_t count, std::int64_t max_prims) {
  // Predict before anything is built.
  const Values& values = context.values;
  const BuildParameters build = build_parameters(max_prims, values.integer("max_depth"));
  const MemoryPrediction predicted = predict_tree_memory(count, build);

  // The tree of this seed.
  ScenarioParameters parameters{count, static_cast<float>(values.number("radius")), context.settings.seed};
  const SphereSet spheres = value_or_fail(scenario_spheres(scenario, parameters));
  const Tree tree = build_reference_tree(spheres, build);

  // Many seeds. The grid of Scenario 1 has none.
  const std::int64_t wanted = context.settings.quick ? kQuickSeeds : kSeeds;
  const std::int64_t seeds = scenario == Scenario::grid ? 1 : wanted;
  std::vector<double> bytes(static_cast<std::size_t>(seeds));
  parallel_for(context.settings.threads, seeds, [&](std::int64_t i) {
    if (context.cancel.cancelled()) return;
    ScenarioParameters seeded = parameters;
    seeded.seed = static_cast<std::uint64_t>(i + 1);
    const SphereSet set = *scenario_spheres(scenario, seeded);
    bytes[static_cast<std::size_t>(i)] = thesis_count(values, build_reference_tree(set, build), count);
  });
  const Spread spread = spread_of(bytes);
  const auto range = [](const MemoryPrediction::Range& of) { return Json{of.low, of.high}; };
  return {{"spheres", count},
          {"max_prims", max_prims},
          {"predicted_thesis_bytes", range(predicted.thesis_bytes)},
          {"predicted_allocated_bytes", range(predicted.allocated_bytes)},
          {"thesis_bytes", thesis_count(values, tree, count)},
          {"allocated_bytes", tree.allocated_bytes()},
          {"depth_avg", tree_statistics(tree).depth.avg},
          {"seeds", seeds},
          {"mean", spread.mean},
          {"sd", spread.sd}};
}

Json measure_scenario(StepContext& context, std::int64_t scenario) {
  Json trees = Json::array();
  for (const std::int64_t count : context.values.integers("spheres_list"))
    for (const std::int64_t max_prims : context.values.integers("max_prims_list")) {
      if (context.cancel.cancelled()) return {};
      trees.push_back(measure_tree(context, scenario_of(scenario), count, max_prims));
    }
  return {{"trees", trees}};
}

// Trees of this section's radius and of section E's, in all scenarios: nodes, overlaps, and whether they are right.
Json compare_radii(const StepContext& context) {
  const Values& values = context.values;
  Json rows = Json::array();
  for (const std::int64_t scenario : values.integers("scenarios"))
    for (const char* const radius : {"radius", "other_radius"}) {
      const ScenarioParameters parameters{values.integers("spheres_list").back(),
                                          static_cast<float>(values.number(radius)), context.settings.seed};
      const SphereSet spheres = value_or_fail(scenario_spheres(scenario_of(scenario), parameters));
      const Tree tree = build_reference_tree(spheres, {values.integers("max_prims_list").front(), kUnlimited});
      const TreeStatistics statistics = tree_statistics(tree);
      std::int64_t splits = 0, overlaps = 0;
      for (const Node& node : tree.nodes) {
        if (node.is_leaf() || node.kind != NodeKind::split) continue;
        ++splits;
        overlaps += node.left_clip > node.right_clip ? 1 : 0;
      }
      rows.push_back({{"scenario", scenario},
                      {"radius", values.number(radius)},
                      {"spheres", parameters.count},
                      {"max_prims", tree.parameters.max_prims},
                      {"inner_nodes", statistics.inner_nodes},
                      {"leaves", statistics.leaves},
                      {"bytes", thesis_count(values, tree, parameters.count)},
                      {"split_nodes", splits},
                      {"overlaps", overlaps},
                      {"right", static_cast<bool>(validate_tree(tree, spheres))}});
      if (context.cancel.cancelled()) return {};
    }
  return rows;
}

std::vector<Step> figure_4_5_steps(const Settings& settings, const Values& values) {
  std::vector<Step> steps;
  for (const std::int64_t scenario : values.integers("scenarios")) {
    steps.push_back({step_name(scenario), settings.quick ? 0.5 : 2,
                     [scenario](StepContext& context) { return measure_scenario(context, scenario); }});
  }
  steps.push_back({kRadiusStep, 0.3, [](StepContext& context) { return compare_radii(context); }});
  return steps;
}

std::string range_text(const Json& range) {
  return grouped(range[0].get<std::int64_t>()) + " to " + grouped(range[1].get<std::int64_t>());
}

bool inside(const Json& value, const Json& range) {
  return value >= range[0] && value <= range[1];
}

// A check of our own: the same by another implementation.
Verdict verdict_of(const Values& values, const std::string& name, const Json& tree) {
  const double sd = tree["sd"].get<double>(), seeds = tree["seeds"].get<double>();
  const double error = sd * std::sqrt(1 / seeds + 1 / values.number("ours.seeds"));
  const double allowed = sd == 0 ? 0 : kStandardErrors * error + print_rounding(values.printed(name));
  return verdict_if(std::abs(tree["mean"].get<double>() - values.number(name)) <= allowed);
}

void add_table(const SectionContext& context, std::int64_t scenario, const Json& trees, Section& section) {
  Table table{fmt::format("Scenario {}: bytes", scenario),
              {"Spheres", "MAX_PRIMS", "predicted", "counted", "mean ± sd over seeds", "ours elsewhere", "own check",
               "allocated, predicted", "really allocated"},
              {},
              "Predicted: from the number of spheres and MAX_PRIMS alone, before the build. No column is the thesis's: "
              "its values are lost. \"Ours elsewhere\" are values of another implementation of ours (in "
              "Scenario 1 exact, else means of " +
                  context.values.printed("ours.seeds") +
                  " seeds). The check holds if both are equal in Scenario 1, else if the two means lie within four "
                  "standard errors."};
  for (const Json& tree : trees) {
    const std::string name = fmt::format("ours.scenario{}.spheres{}.max_prims{}.bytes", scenario,
                                         tree["spheres"].dump(), tree["max_prims"].dump());
    const Verdict verdict = verdict_of(context.values, name, tree);
    const double mean = tree["mean"].get<double>(), sd = tree["sd"].get<double>();
    const bool predicted = inside(tree["thesis_bytes"], tree["predicted_thesis_bytes"]) &&
                           inside(tree["allocated_bytes"], tree["predicted_allocated_bytes"]);
    table.rows.push_back(
        {{grouped(tree["spheres"].get<std::int64_t>())},
         {tree["max_prims"].dump()},
         {range_text(tree["predicted_thesis_bytes"]) + (predicted ? "" : " (missed)")},
         {grouped(std::llround(tree["thesis_bytes"].get<double>()))},
         {sd == 0 ? grouped(std::llround(mean)) : fmt::format("{} ± {:.0f}", grouped(std::llround(mean)), sd)},
         {grouped(std::llround(context.values.number(name)))},
         section.judge({name,
                        fmt::format("Scenario {}, {} spheres, MAX_PRIMS {}: bytes", scenario, tree["spheres"].dump(),
                                    tree["max_prims"].dump()),
                        grouped(std::llround(context.values.number(name))), grouped(std::llround(mean)), verdict,
                        context.values.kind(name), false},
                       words_of(verdict, context.values.kind(name))),
         {range_text(tree["predicted_allocated_bytes"])},
         {grouped(tree["allocated_bytes"].get<std::int64_t>())}});
    Json entry{{"name", name}, {"scenario", scenario}};
    entry.update(tree);
    entry["expected"] = context.values.number(name);
    entry["prediction_holds"] = predicted;
    entry["kind"] = name_of(context.values.kind(name));
    entry["verdict"] = name_of(verdict);
    section.data["values"].push_back(std::move(entry));
  }
  section.tables.push_back(std::move(table));
}

void add_chart(const SectionContext& context, const std::string& file, const std::string& caption,
               const ChartData& data, Section& section) {
  const std::string path = context.folder + "/" + file;
  if (const Status status = write_file(path, bar_chart(data)); !status) fail(status.error());
  section.illustrations.push_back({"figure-4.5/" + file, caption});
}

// As in the thesis: one series for each MAX_PRIMS over the numbers of spheres.
void add_thesis_chart(const SectionContext& context, std::int64_t scenario, const Json& trees, Section& section) {
  ChartData data{
      fmt::format("Scenario {}: memory, counted by the text's rule", scenario), "spheres", "kB", {}, {}, false};
  for (const std::int64_t count : context.values.integers("spheres_list"))
    data.categories.push_back(fmt::format("{}", count));
  for (const std::int64_t max_prims : context.values.integers("max_prims_list")) {
    Series series{fmt::format("MAX_PRIMS {}", max_prims), {}};
    for (const Json& tree : trees)
      if (tree["max_prims"] == max_prims) series.values.push_back(tree["thesis_bytes"].get<double>() / 1000);
    data.series.push_back(std::move(series));
  }
  add_chart(context, fmt::format("scenario{}.svg", scenario),
            fmt::format("Scenario {}: nodes, index array and global box, with the sizes that we infer", scenario), data,
            section);
}

// The largest number of spheres: predicted and real memory.
void add_allocation_chart(const SectionContext& context, std::int64_t scenario, const Json& trees, Section& section) {
  const std::int64_t count = context.values.integers("spheres_list").back();
  ChartData data{fmt::format("Scenario {}: {} spheres, predicted and really allocated", scenario, count),
                 "MAX_PRIMS",
                 "kB",
                 {},
                 {{"predicted, low", {}}, {"really allocated", {}}, {"predicted, high", {}}, {"counted", {}}},
                 false};
  for (const Json& tree : trees) {
    if (tree["spheres"] != count) continue;
    data.categories.push_back(tree["max_prims"].dump());
    const Json& predicted = tree["predicted_allocated_bytes"];
    const Json values[] = {predicted[0], tree["allocated_bytes"], predicted[1], tree["thesis_bytes"]};
    for (std::size_t i = 0; i < data.series.size(); ++i)
      data.series[i].values.push_back(values[i].get<double>() / 1000);
  }
  add_chart(context, fmt::format("scenario{}-allocated.svg", scenario),
            fmt::format("Scenario {}: the range predicted before the build, what the tree of this seed really "
                        "allocates, and what the text's rule counts",
                        scenario),
            data, section);
}

// How often memory or depth grows, or stays equal, from one MAX_PRIMS to the next.
void add_statements(const SectionContext& context, const std::vector<const Json*>& scenarios, Section& section) {
  std::int64_t rises = 0, not_shallower = 0, steps = 0;
  for (const Json* trees : scenarios)
    for (std::size_t i = 1; i < trees->size(); ++i) {
      const Json &before = (*trees)[i - 1], &after = (*trees)[i];
      if (before["spheres"] != after["spheres"]) continue;
      ++steps;
      rises += after["mean"] >= before["mean"];
      not_shallower += after["depth_avg"] >= before["depth_avg"];
    }
  Statements statements("What the text says about memory",
                        "Bytes are our means over the seeds, depths those of this seed's trees, over the leaves.");
  statements.add("gets_shallower", "A larger MAX_PRIMS makes shallower trees; exceptions",
                 {context.values, "gets_shallower"}, fmt::format("{} exceptions in {} steps", not_shallower, steps),
                 verdict_if(static_cast<double>(not_shallower) == context.values.number("gets_shallower")));
  statements.add("rises_with_max_prims", "A larger MAX_PRIMS needs less memory; exceptions",
                 {context.values, "rises_with_max_prims"}, fmt::format("{} exceptions in {} steps", rises, steps),
                 verdict_if(static_cast<double>(rises) == context.values.number("rises_with_max_prims")));
  section.data["statements"] = statements.data();
  statements.move_into(section);
}

// "the radii of the spheres were minimized to 0.001 because the high number of primitives in such small space could
// lead to overlaps and incorrectness in the tree structure".
void add_radii(const SectionContext& context, Section& section) {
  const auto found = context.results.find(kRadiusStep);
  if (found == context.results.end()) return;
  Table table{"Small and large spheres: what the radius does to a tree",
              {"Scenario", "Radius", "Inner nodes", "Leaves", "Bytes", "Split nodes whose children overlap"},
              {},
              "With as many spheres as the largest tree above, and the smallest MAX_PRIMS."};
  Statements statements(
      "Are trees over large spheres right?",
      "The text makes the spheres small because large ones \"could lead to overlaps and incorrectness in "
      "the tree structure\". The check of ours: each sphere lies in one leaf, and every plane above it "
      "bounds its box.");
  std::map<std::int64_t, std::vector<double>> shares;
  for (const Json& row : found->second) {
    const double share = 100 * row["overlaps"].get<double>() / std::max(1.0, row["split_nodes"].get<double>());
    table.rows.push_back({{row["scenario"].dump()},
                          {fmt::format("{}", row["radius"].get<double>())},
                          {grouped(row["inner_nodes"].get<std::int64_t>())},
                          {grouped(row["leaves"].get<std::int64_t>())},
                          {grouped(std::llround(row["bytes"].get<double>()))},
                          {fmt::format("{:.1f} %", share)}});
    shares[row["scenario"].get<std::int64_t>()].push_back(share);
    const bool right = row["right"].get<bool>();
    statements.add(
        fmt::format("radius.scenario{}.r{}", row["scenario"].get<std::int64_t>(), row["radius"].get<double>()),
        fmt::format("Scenario {}, radius {}", row["scenario"].get<std::int64_t>(), row["radius"].get<double>()),
        {"a right tree", ValueKind::own_check},
        fmt::format("{}; children overlap in {:.1f} % of the split nodes", right ? "right" : "wrong", share),
        verdict_if(right));
  }
  bool more = false;
  std::vector<std::string> ours;
  for (const auto& [scenario, share] : shares) {
    more = more || share.back() > share.front();
    ours.push_back(fmt::format("Scenario {}: {:.1f} % and {:.1f} %", scenario, share.front(), share.back()));
  }
  statements.add("overlaps", "Large spheres make children overlap, somewhere: split nodes that do, small and large",
                 {"more, somewhere", ValueKind::inferred}, fmt::format("{}", fmt::join(ours, ", ")), verdict_if(more));
  section.data["radii"] = found->second;
  section.data["statements_radius"] = statements.data();
  section.tables.push_back(std::move(table));
  statements.move_into(section);
}

Section figure_4_5_section(const SectionContext& context) {
  Section section;
  const Values& values = context.values;
  section.paragraphs.push_back(fmt::format(
      "The text says what counts: inner and leaf nodes, an array of indices, the global box. It says no size of any of "
      "them, and it breaks off before its results. We infer {} bytes for each node, {} for each sphere's index and {} "
      "for the box; the reasons stand below. This program itself allocates {} bytes for each node that it stores (an "
      "empty leaf is not) and {} for each sphere. Trees are those of seed {}. Nothing here is compared with a value of "
      "the thesis, because none is known: the checks are against another implementation of ours.",
      values.printed("node_bytes"), values.printed("index_bytes"), values.printed("aabb_bytes"), sizeof(Node),
      sizeof(std::int64_t), context.settings.seed));
  section.data["values"] = Json::array();
  std::vector<const Json*> done;
  for (const std::int64_t scenario : values.integers("scenarios")) {
    const auto found = context.results.find(step_name(scenario));
    if (found == context.results.end()) continue;
    const Json& trees = found->second["trees"];
    add_table(context, scenario, trees, section);
    add_thesis_chart(context, scenario, trees, section);
    add_allocation_chart(context, scenario, trees, section);
    done.push_back(&trees);
  }
  if (done.size() == values.numbers("scenarios").size()) add_statements(context, done, section);
  add_radii(context, section);
  return section;
}

}  // namespace

Experiment figure_4_5() {
  return {"figure-4.5", "Figure 4.5: memory of the tree", figure_4_5_steps, figure_4_5_section};
}

}  // namespace bihive::cli::thesis
