// Section D: the trees of Figure 4.3 in numbers, and whether a tree of one leaf is slower than brute force.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "bihive/base/timer.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/bih/traversal.h"
#include "bihive/math/quartiles.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/camera.h"
#include "bihive/scene/generators.h"
#include "support/failure.h"
#include "support/messages.h"
#include "thesis/compare.h"
#include "thesis/experiment.h"

namespace bihive::cli::thesis {
namespace {

// The trees of the section, by the names of their values.
struct TreeCase {
  const char* name;
  const char* label;
};
constexpr TreeCase kCases[] = {{"depth1", "(a) MAX_TREE_DEPTH 1"}, {"depth2", "MAX_TREE_DEPTH 2"},
                               {"depth3", "(b) MAX_TREE_DEPTH 3"}, {"prims_unlimited", "(d) MAX_PRIMS unlimited"},
                               {"prims32", "(e) MAX_PRIMS 32"},    {"prims1", "(c), (f) MAX_PRIMS 1"}};
constexpr const char* kQuantities[] = {"inner_nodes", "leaves", "spheres_per_leaf", "depth"};
constexpr const char* kQuantityLabels[] = {"inner nodes", "leaves", "spheres in each leaf", "depth of each leaf"};
constexpr const char* kOneLeaf = "prims_unlimited";
constexpr const char* kLeafEach = "prims1";
constexpr const char* kDeeper[] = {"prims32", "depth3", kLeafEach};

// Each repetition is a turn of the tree and a turn of brute force. A first turn of each does not count.
constexpr int kRepetitions = 21;
constexpr int kQuickRepetitions = 9;
constexpr int kQuickRowStride = 4;  // every fourth row of the picture

SphereSet spheres_of(const Values& values, std::uint64_t seed) {
  const ScenarioParameters parameters{values.integer("spheres"), static_cast<float>(values.number("radius")), seed};
  return value_or_fail(scenario_spheres(scenario_of(values.integer("scenario")), parameters));
}

BuildParameters parameters_of(const Values& values, const std::string& name) {
  return build_parameters(values.integer(name + ".max_prims"), values.integer(name + ".max_depth"));
}

Json count_trees(StepContext& context) {
  const SphereSet spheres = spheres_of(context.values, context.settings.seed);
  Json trees;
  for (const TreeCase& tree_case : kCases) {
    const Tree tree = build_reference_tree(spheres, parameters_of(context.values, tree_case.name));
    const TreeStatistics s = tree_statistics(tree);
    const auto range = [](const MinAvgMax& value) { return Json{value.min, value.max}; };
    trees[tree_case.name] = {{"inner_nodes", {s.inner_nodes, s.inner_nodes}},
                             {"leaves", {s.leaves, s.leaves}},
                             {"spheres_per_leaf", range(s.spheres_per_leaf)},
                             {"depth", range(s.depth)}};
  }
  return trees;
}

// All primary rays, or in a quick run those of some rows; and the subset that meets the box around everything.
struct PrimaryRays {
  std::vector<Ray> all, box;
};

PrimaryRays primary_rays(const StepContext& context, const Tracer& tree) {
  const auto side = [&](const char* name) {
    constexpr std::int64_t kLargestPx = 65535;
    const std::int64_t px = context.values.integer(name);
    if (px < 1 || px > kLargestPx)
      fail({std::string("/values/") + name + ": expected 1 to 65535 pixels", "values.json", 0, 0, ""});
    return static_cast<int>(px);
  };
  const int width = side("width_px");
  const int height = side("height_px");
  const PixelRays pixels(thesis_scene_without_spheres().camera, width, height);
  PrimaryRays rays;
  for (int y = 0; y < height; y += context.settings.quick ? kQuickRowStride : 1)
    for (int x = 0; x < width; ++x) {
      const Ray ray = pixels.at(x + 0.5, y + 0.5);
      CountingObserver observer;
      traverse<false>(*tree.tree(), tree.spheres(), ScaledRay(ray, tree.spheres()), observer);
      rays.all.push_back(ray);
      if (observer.leaf_visits > 0) rays.box.push_back(ray);
    }
  return rays;
}

// Nanoseconds of a ray, on one thread. The hits are summed up, so that both must do the whole work.
struct Timed {
  double ns;
  std::int64_t hits;
};
Timed time_tracer(const Tracer& tracer, const std::vector<Ray>& rays) {
  std::int64_t hits = 0;
  const Timer timer;
  for (const Ray& ray : rays) hits += tracer.closest_hit(ray).found();
  return {timer.elapsed_ms() * 1e6 / static_cast<double>(std::max<std::size_t>(rays.size(), 1)), hits};
}

Json time_rays(StepContext& context, const Tracer& tree, const Tracer& brute, const std::vector<Ray>& rays,
               int full_repetitions = kRepetitions) {
  const int repetitions = context.settings.quick ? kQuickRepetitions : full_repetitions;
  Json tree_ns = Json::array(), brute_ns = Json::array(), ratios = Json::array();
  std::int64_t hits = 0;
  for (int repetition = -1; repetition < repetitions && !context.cancel.cancelled(); ++repetition) {
    // The order changes in every second repetition, so that a machine that slows down favours neither.
    const bool tree_first = repetition % 2 == 0;
    const Timed first = time_tracer(tree_first ? tree : brute, rays);
    const Timed second = time_tracer(tree_first ? brute : tree, rays);
    BIHIVE_CHECK_EQ(first.hits, second.hits);
    if (repetition < 0) continue;
    const double of_tree = (tree_first ? first : second).ns, of_brute = (tree_first ? second : first).ns;
    hits = first.hits;
    tree_ns.push_back(of_tree);
    brute_ns.push_back(of_brute);
    ratios.push_back(of_tree / of_brute);
  }
  return {{"rays", rays.size()}, {"hits", hits}, {"tree_ns", tree_ns}, {"brute_ns", brute_ns}, {"ratios", ratios}};
}

Json time_one_leaf(StepContext& context) {
  const SphereSet spheres = spheres_of(context.values, context.settings.seed);
  const Tracer tree = value_or_fail(Tracer::build(spheres, Engine::reference, parameters_of(context.values, kOneLeaf)));
  const Tracer brute = value_or_fail(Tracer::build(spheres, Engine::brute));
  const PrimaryRays rays = primary_rays(context, tree);
  Json times{{"all", time_rays(context, tree, brute, rays.all)}, {"box", time_rays(context, tree, brute, rays.box)}};

  // Deeper trees in turns with the tree of one leaf.
  for (const char* const name : kDeeper) {
    const Tracer deeper = value_or_fail(Tracer::build(spheres, Engine::reference, parameters_of(context.values, name)));
    times["deeper"][name] = time_rays(context, tree, deeper, rays.all, kQuickRepetitions);
    if (context.cancel.cancelled()) return {};
  }
  return times;
}

void add_trees_table(const SectionContext& context, const Json& trees, Section& section) {
  Json& data = section.data["trees"];
  Table table{fmt::format("Trees over {} spheres of Scenario {}", context.values.printed("spheres"),
                          context.values.printed("scenario")),
              {"Tree", "What", "Expected", "By", "Ours", "Verdict"},
              {},
              "Exact. \"Inferred\": the text does not print the number, but it follows from what it says. \"Own "
              "check\": a tree "
              "that the text does not mention."};
  data = Json::array();
  for (const TreeCase& tree_case : kCases)
    for (std::size_t i = 0; i < std::size(kQuantities); ++i) {
      const std::string name = std::string(tree_case.name) + "." + kQuantities[i];
      const Json& range = trees[tree_case.name][kQuantities[i]];
      const double stated = context.values.number(name);
      const Verdict verdict = verdict_if(range[0] == stated && range[1] == stated);
      const std::string ours = range[0] == range[1] ? range[0].dump() : range[0].dump() + " to " + range[1].dump();
      const Expected expected(fmt::format("{}", stated), context.values.kind(name));
      table.rows.push_back({{tree_case.label},
                            {kQuantityLabels[i]},
                            {expected.text},
                            {source_text(expected.kind)},
                            {ours},
                            section.judge({name, fmt::format("{}: {}", tree_case.label, kQuantityLabels[i]),
                                           expected.text, ours, verdict, expected.kind, false},
                                          words_of(verdict, expected.kind))});
      data.push_back({{"name", name},
                      {"expected", stated},
                      {"kind", name_of(expected.kind)},
                      {"ours", range[0]},
                      {"ours_max", range[1]},
                      {"verdict", name_of(verdict)}});
    }
  section.tables.push_back(std::move(table));
}

// The median ratio decides if at least three quarters of the repetitions lie on its side.
void add_ratio(const SectionContext& context, Statements& statements, Json& data, const Json& timing,
               const std::string& name, const std::string& statement, ValueKind kind) {
  const auto ratios = timing["ratios"].get<std::vector<double>>();
  if (ratios.empty()) return;
  const Quartiles ratio = quartiles_of(ratios);
  const double claimed = context.values.number("slower.time_ratio_above");
  const double tree_ns = quartiles_of(timing["tree_ns"].get<std::vector<double>>()).median;
  const double brute_ns = quartiles_of(timing["brute_ns"].get<std::vector<double>>()).median;
  const Verdict verdict = verdict_above(ratio, claimed);
  statements.add(name, statement, {fmt::format("above {}", claimed), kind},
                 fmt::format("{:.3f} (quartiles {:.3f} and {:.3f}): {:.1f} ns a ray against {:.1f} ns", ratio.median,
                             ratio.lower, ratio.upper, tree_ns, brute_ns),
                 verdict, verdict == Verdict::undecided ? "the quartiles reach across" : "", /*timed=*/true);
  data[name] = {{"rays", timing["rays"]},       {"hits", timing["hits"]},      {"repetitions", ratios.size()},
                {"ratio_median", ratio.median}, {"ratio_lower", ratio.lower},  {"ratio_upper", ratio.upper},
                {"tree_ns_median", tree_ns},    {"brute_ns_median", brute_ns}, {"claimed_above", claimed},
                {"verdict", name_of(verdict)}};
}

// "The tree has a leaf node for each primitive ..., which considerably increases performance": beside one leaf.
void add_deeper(Section& section, const Json& deeper) {
  Table table{"Time of a ray in the trees of Figure 4.3, beside the tree of one leaf",
              {"Tree", "ns a ray", "one leaf, in turns", "times as fast (quartiles)"},
              {},
              ""};
  Statements statements("A leaf for each sphere increases performance",
                        "How many times as fast as the tree of one leaf. The text says \"considerably\" and gives no "
                        "number: agrees if the quartiles lie above 1.");
  for (const TreeCase& tree_case : kCases) {
    if (!deeper.contains(tree_case.name)) continue;
    const Json& timing = deeper[tree_case.name];
    const auto ratios = timing["ratios"].get<std::vector<double>>();
    if (ratios.empty()) return;
    const Quartiles ratio = quartiles_of(ratios);
    const auto middle = [&](const char* key) {
      return fmt::format("{:.1f}", median(timing[key].get<std::vector<double>>()));
    };
    table.rows.push_back({{tree_case.label}, {middle("brute_ns")}, {middle("tree_ns")}, {quartiles_text(ratio, 2)}});
    if (tree_case.name == std::string(kLeafEach))
      statements.add("leaf_each_is_faster", "A leaf for each sphere is faster than one leaf", "faster",
                     quartiles_text(ratio, 2) + " times as fast", verdict_above(ratio, 1), "", /*timed=*/true);
  }
  section.data["deeper"] = deeper;
  section.tables.push_back(std::move(table));
  statements.move_into(section);
}

Section section_d_section(const SectionContext& context) {
  Section section;
  if (const auto found = context.results.find("trees"); found != context.results.end())
    add_trees_table(context, found->second, section);
  const auto found = context.results.find("one_leaf");
  if (found == context.results.end()) return section;

  const Json &all = found->second["all"], &box = found->second["box"];
  section.paragraphs.push_back(fmt::format(
      "A tree of one root leaf tests what brute force tests, and the box around everything before. The same primary "
      "rays were traced by both in turns, on one thread: {} of a picture of {} x {}{}, {} of which meet the box. A ray "
      "that misses the box saves the tree all its sphere tests; a ray that meets it pays for the test. So the text's "
      "reason can only show in the rays that meet the box, and what a picture takes depends on how much of it the box "
      "fills.",
      grouped(all["rays"].get<std::int64_t>()), context.values.printed("width_px"), context.values.printed("height_px"),
      context.settings.quick ? fmt::format(" (one row in {})", kQuickRowStride) : "",
      grouped(box["rays"].get<std::int64_t>())));
  Statements statements(
      "A tree of one leaf is slower than brute force: time of the tree / time of brute force",
      "The median of the repetitions with its quartiles. Agrees or differs where both quartiles lie "
      "on one side of the limit. The text speaks of a tree's performance as a whole. That its reason, the "
      "test of the box for every ray, shows in the rays that meet the box alone is our inference.");
  Json& timing = section.data["one_leaf"] = Json::object();
  add_ratio(context, statements, timing, all, "whole_picture", "all primary rays of the picture",
            context.values.kind("slower.time_ratio_above"));
  add_ratio(context, statements, timing, box, "box_rays", "only the rays that meet the box", ValueKind::inferred);
  section.data["statements"] = statements.data();
  statements.move_into(section);
  add_deeper(section, found->second["deeper"]);
  return section;
}

}  // namespace

Experiment section_d() {
  return {
      "section-d", "Section D: small trees, and one leaf against brute force",
      [](const Settings& settings, const Values&) {
        return std::vector<Step>{{"trees", 0.1, count_trees}, {"one_leaf", settings.quick ? 3.0 : 50.0, time_one_leaf}};
      },
      section_d_section};
}

}  // namespace bihive::cli::thesis
