// Figure 4.3: six trees over one set of spheres, each in a picture of its traversal and in a drawing of the tree
// itself.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/image/image_diff.h"
#include "bihive/scene/generators.h"
#include "support/failure.h"
#include "thesis/compare.h"
#include "thesis/pictures.h"
#include "thesis/ray_counts.h"

namespace bihive::cli::thesis {
namespace {

const std::string kId = "figure-4.3";
constexpr int kQuickDivisor = 4;
// The drawing of the tree has two parts, so it is twice as large in a quick run.
constexpr int kQuickTreeDivisor = 2;
// The pictures that the text calls identical, and those that it describes by MAX_TREE_DEPTH.
const std::vector<std::string> kLetters{"a", "b", "c", "d", "e", "f"};
const std::vector<std::pair<std::string, std::string>> kIdentical{{"a", "d"}, {"c", "f"}};
const std::vector<std::string> kByDepth{"a", "b", "c"};

Scene scene_of(const StepContext& context) {
  ScenarioParameters parameters;
  parameters.count = context.values.integer("spheres");
  parameters.radius = static_cast<float>(context.values.number("radius"));
  parameters.seed = context.settings.seed;
  return value_or_fail(scenario_scene(scenario_of(context.values.integer("scenario")), parameters));
}

// A limit of values.json; `unlimited` stands for infinity.
std::int64_t limit_of(const Values& values, const std::string& name) {
  const std::int64_t limit = values.integer(name);
  return limit == values.integer("unlimited") ? kUnlimited : std::max<std::int64_t>(1, limit);
}

BuildParameters parameters_of(const Values& values, const std::string& letter) {
  return {limit_of(values, letter + ".max_prims"), limit_of(values, letter + ".max_depth")};
}

Json tree_facts(const Tree& tree) {
  const TreeStatistics statistics = tree_statistics(tree);
  return {{"inner_nodes", statistics.inner_nodes},
          {"leaves", statistics.leaves},
          {"spheres_per_leaf_min", statistics.spheres_per_leaf.min},
          {"spheres_per_leaf_max", statistics.spheres_per_leaf.max},
          {"depth", statistics.depth.max}};
}

// The smallest value above 0 of a channel: one gap or one visit.
double smallest_step(const Image& image, std::size_t channel) {
  int smallest = 0;
  for (std::size_t i = channel; i < image.rgb.size(); i += 3)
    if (image.rgb[i] > 0 && (smallest == 0 || image.rgb[i] < smallest)) smallest = image.rgb[i];
  return smallest / 255.0;
}

RayCounts count_traversal(const StepContext& context, const Scene& scene, const Tracer& tracer) {
  return count_rays(context, scene, *tracer.tree(), picture_size(context.settings, context.values, kQuickDivisor));
}

// Green for gaps, as `bihive render --view traversal` draws it. Blue for inner nodes and leaves, each by its own step
// in values.json and at most 1: there that view has one step for both. Nothing if cancelled.
std::optional<Image> traversal_picture(const StepContext& context, const Scene& scene, const Tracer& tracer,
                                       const RayCounts& counts) {
  const PictureSize size = picture_size(context.settings, context.values, kQuickDivisor);
  std::optional<Image> image = draw(context, scene, tracer, picture_settings(context, scene, size, View::traversal));
  if (!image || counts.rays.empty()) return std::nullopt;
  const double of_inner = context.values.number("visit.inner.blue"), of_leaf = context.values.number("visit.leaf.blue");
  for (std::size_t i = 0; i < counts.rays.size(); ++i) {
    const CountingObserver& ray = counts.rays[i];
    const double blue =
        of_inner * static_cast<double>(ray.node_visits) + of_leaf * static_cast<double>(ray.leaf_visits);
    image->rgb[3 * i + 2] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(blue, 0.0, 1.0)));
  }
  return image;
}

// What can be seen in the picture, as shares of its pixels.
Json seen_in(const Image& image, const RayCounts& counts) {
  std::int64_t green = 0, blue = 0, bright = 0, saturated = 0, most_gaps = 0, most_visits = 0;
  for (std::size_t i = 0; i < counts.rays.size(); ++i) {
    const CountingObserver& ray = counts.rays[i];
    const int g = image.rgb[3 * i + 1], b = image.rgb[3 * i + 2];
    green += g > b;
    blue += b > 0 && b >= g;
    bright += ray.empty_gaps >= 2;
    saturated += g == 255 || b == 255;
    most_gaps = std::max(most_gaps, ray.empty_gaps);
    most_visits = std::max(most_visits, ray.node_visits + ray.leaf_visits);
  }
  const double all = static_cast<double>(counts.rays.size());
  const RayCounts::Mean mean = counts.mean();
  return {{"green_share", static_cast<double>(green) / all},
          {"blue_share", static_cast<double>(blue) / all},
          {"several_gaps_share", static_cast<double>(bright) / all},
          {"saturated_share", static_cast<double>(saturated) / all},
          {"gaps_a_ray", mean.gaps},
          {"nodes_a_ray", mean.nodes + mean.leaves},
          {"most_gaps", most_gaps},
          {"most_nodes", most_visits}};
}

Json draw_tree(const StepContext& context, const std::string& letter) {
  const Scene scene = scene_of(context);
  const Tracer tracer =
      value_or_fail(Tracer::build(scene.spheres, Engine::reference, parameters_of(context.values, letter)));
  const RayCounts counts = count_traversal(context, scene, tracer);
  const std::optional<Image> traversal = traversal_picture(context, scene, tracer, counts);
  const PictureSize size = picture_size(context.settings, context.values, kQuickTreeDivisor);
  const std::optional<Image> tree = draw(context, scene, tracer, picture_settings(context, scene, size, View::tree));
  if (!traversal || !tree) return {};
  return {{"traversal", write_picture(context, letter + "-traversal.png", *traversal)},
          {"tree_picture", write_picture(context, letter + "-tree.png", *tree)},
          {"tree", tree_facts(*tracer.tree())},
          {"green_step", smallest_step(*traversal, 1)},
          {"seen", seen_in(*traversal, counts)}};
}

bool same_node(const Node& a, const Node& b) {
  return a.left_clip == b.left_clip && a.right_clip == b.right_clip && a.kind == b.kind &&
         a.split_axis == b.split_axis && a.first == b.first && a.sphere_count == b.sphere_count;
}

// The number of different entries of two lists.
template <class T, class Same>
std::int64_t differences(const std::vector<T>& a, const std::vector<T>& b, const Same& same) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < std::max(a.size(), b.size()); ++i)
    if (i >= a.size() || i >= b.size() || !same(a[i], b[i])) ++count;
  return count;
}

// Compares two trees node by node and two pictures pixel by pixel.
Json compare(const StepContext& context, const std::string& first, const std::string& second) {
  const Scene scene = scene_of(context);
  const Tracer one =
      value_or_fail(Tracer::build(scene.spheres, Engine::reference, parameters_of(context.values, first)));
  const Tracer other =
      value_or_fail(Tracer::build(scene.spheres, Engine::reference, parameters_of(context.values, second)));
  const RayCounts of_one = count_traversal(context, scene, one), of_other = count_traversal(context, scene, other);
  const std::optional<Image> one_image = traversal_picture(context, scene, one, of_one);
  const std::optional<Image> other_image = traversal_picture(context, scene, other, of_other);
  if (!one_image || !other_image) return {};
  const auto equal = [](std::int64_t a, std::int64_t b) { return a == b; };
  return {{"nodes", one.tree()->nodes.size()},
          {"different_nodes", differences(one.tree()->nodes, other.tree()->nodes, same_node)},
          {"different_places", differences(one.tree()->sphere_ids, other.tree()->sphere_ids, equal)},
          {"different_pixels", difference_of(*one_image, *other_image).pixels}};
}

// The trees of (a) to (c) with the MAX_PRIMS that the text gives for them.
Json build_as_stated(const StepContext& context) {
  const Scene scene = scene_of(context);
  Json trees = Json::object();
  for (const std::string& letter : kByDepth) {
    BuildParameters parameters = parameters_of(context.values, letter);
    parameters.max_prims = limit_of(context.values, "abc.max_prims_stated");
    trees[letter] = tree_facts(build_reference_tree(scene.spheres, parameters));
  }
  return trees;
}

std::string pair_name(const std::pair<std::string, std::string>& pair) {
  return pair.first + "_and_" + pair.second;
}

std::vector<Step> steps_of(const Settings& settings, const Values&) {
  const double weight = settings.quick ? 0.1 : 0.7;
  std::vector<Step> steps;
  steps.reserve(kLetters.size() + kIdentical.size() + 1);
  for (const std::string& letter : kLetters)
    steps.push_back({letter, weight, [letter](StepContext& context) { return draw_tree(context, letter); }});
  for (const auto& pair : kIdentical)
    steps.push_back(
        {pair_name(pair), weight, [pair](StepContext& context) { return compare(context, pair.first, pair.second); }});
  steps.push_back({"abc_as_stated", 0.01, [](StepContext& context) { return build_as_stated(context); }});
  return steps;
}

std::string limit_text(const Values& values, const std::string& name) {
  return limit_of(values, name) == kUnlimited ? "∞" : fmt::format("{}", values.integer(name));
}

std::string leaf_size_text(const Json& tree) {
  const auto min = tree.at("spheres_per_leaf_min").get<std::int64_t>();
  const auto max = tree.at("spheres_per_leaf_max").get<std::int64_t>();
  return min == max ? fmt::format("{}", min) : fmt::format("{} to {}", min, max);
}

// The text's statements about one tree, or about the same tree with another MAX_PRIMS. `otherwise`: the verdict where
// the tree is another one.
void add_stated(Statements& statements, const Values& values, const std::string& letter, const Json& tree,
                const std::string& row_name, const std::string& words, Verdict otherwise) {
  const std::pair<const char*, const char*> counts[] = {
      {"inner_nodes", "inner nodes"}, {"leaves", "leaves"}, {"depth", "levels"}};
  for (const auto& [key, what] : counts) {
    const std::string name = fmt::format("{}.{}", letter, key);
    if (!values.has(name)) continue;
    const auto ours = tree.at(key).get<std::int64_t>();
    statements.add(fmt::format("{}.{}", row_name, key), fmt::format("{}: {}", words, what), {values, name},
                   fmt::format("{}", ours), ours == values.integer(name) ? Verdict::agrees : otherwise);
  }
  const std::string name = letter + ".spheres_per_leaf";
  if (!values.has(name)) return;
  const std::int64_t stated = values.integer(name);
  const bool same = tree.at("spheres_per_leaf_min") == stated && tree.at("spheres_per_leaf_max") == stated;
  statements.add(row_name + ".spheres_per_leaf", words + ": spheres in each leaf", {values, name}, leaf_size_text(tree),
                 same ? Verdict::agrees : otherwise);
}

// "(a) = (d)", as trees and as pictures.
void add_identical(Statements& statements, const Values& values, const std::string& name, const Json& result) {
  const std::string words = fmt::format("({}) = ({})", name.front(), name.back());
  const std::int64_t stated = values.integer(name + ".differences");
  const auto nodes =
      result.at("different_nodes").get<std::int64_t>() + result.at("different_places").get<std::int64_t>();
  const auto pixels = result.at("different_pixels").get<std::int64_t>();
  const Expected thesis(values, name + ".differences");
  statements.add(name + ".trees", words + " as trees", thesis,
                 fmt::format("{} of {} nodes and places differ", nodes, result.at("nodes").get<std::int64_t>()),
                 verdict_if(nodes == stated));
  statements.add(name + ".pictures", words + " as pictures", thesis, fmt::format("{} pixels differ", pixels),
                 verdict_if(pixels == stated));
}

// The smallest green of a picture is that of one gap.
void add_gap_step(Statements& statements, const SectionContext& context) {
  double smallest = 1;
  for (const std::string& letter : kLetters) {
    const auto found = context.results.find(letter);
    if (found == context.results.end()) return;
    const double step = found->second.at("green_step").get<double>();
    if (step > 0) smallest = std::min(smallest, step);
  }
  // Pictures have 8 bits.
  const double stated = context.values.number("gap.green");
  statements.add("gap.green", "Green of one gap passed", {context.values, "gap.green"}, fmt::format("{:.3g}", smallest),
                 verdict_if(smallest > stated - 0.5 / 255 && smallest < stated + 0.5 / 255));
}

const Json* result_of(const SectionContext& context, const std::string& step) {
  const auto found = context.results.find(step);
  return found == context.results.end() ? nullptr : &found->second;
}

// What the text says of the colours of the pictures, and what is seen in ours.
void add_colours(Statements& statements, const SectionContext& context, Section& section) {
  Table table{"What is seen in the pictures",
              {"", "More green than blue", "Blue", "Several gaps", "Gaps a ray", "Nodes and leaves a ray", "At most",
               "Saturated"},
              {},
              ""};
  double most_gaps = 0;
  std::string most_letter;
  std::vector<std::string> greener;
  bool all = true;
  for (const std::string& letter : kLetters) {
    const Json* const result = result_of(context, letter);
    if (result == nullptr) {
      all = false;
      continue;
    }
    const Json& seen = result->at("seen");
    const auto share = [&](const char* key) { return fmt::format("{:.1f} %", 100 * seen.at(key).get<double>()); };
    table.rows.push_back({{fmt::format("({})", letter)},
                          {share("green_share")},
                          {share("blue_share")},
                          {share("several_gaps_share")},
                          {fmt::format("{:.2f}", seen.at("gaps_a_ray").get<double>())},
                          {fmt::format("{:.2f}", seen.at("nodes_a_ray").get<double>())},
                          {seen.at("most_nodes").dump()},
                          {share("saturated_share")}});
    if (seen.at("green_share").get<double>() > 0) greener.push_back(letter);
    if (seen.at("gaps_a_ray").get<double>() > most_gaps) most_letter.clear();
    if (seen.at("gaps_a_ray").get<double>() >= most_gaps) {
      most_gaps = seen.at("gaps_a_ray").get<double>();
      most_letter += letter;
    }
  }
  if (table.rows.empty()) return;
  table.note =
      "Shares of all pixels. Saturated: green or blue has reached 1, so that a further step would not be seen. The "
      "text speaks of these colours and of empty space without numbers: that they show so in our pictures, with the "
      "steps of blue that we chose, is our inference.";
  section.tables.push_back(std::move(table));
  if (!all) return;
  statements.add("green_areas",
                 "There are green areas where a tree has gaps: pictures with pixels more green than blue",
                 {"(b), (c), (e), (f)", ValueKind::inferred}, fmt::format("({})", fmt::join(greener, "), (")),
                 verdict_if(greener == std::vector<std::string>{"b", "c", "e", "f"}));
  statements.add("most_empty_space", "The empty space between the nodes is maximized in (c) and (f)",
                 {"(c) and (f)", ValueKind::inferred},
                 fmt::format("most gaps a ray: {:.2f}, in ({})", most_gaps, fmt::join(most_letter, ") and (")),
                 verdict_if(most_letter == "cf"));
  const double several = result_of(context, "c")->at("seen").at("several_gaps_share").get<double>();
  statements.add("brighter_green", "Brighter shades of green: the ray passed several gaps, in (c)",
                 {"some", ValueKind::inferred}, fmt::format("{:.1f} % of the pixels", 100 * several),
                 verdict_if(several > 0));
}

// Each tree as a row, with its two pictures side by side.
void add_trees(const SectionContext& context, Statements& statements, Section& section) {
  const Values& values = context.values;
  Table trees{
      "Our trees", {"", "MAX_TREE_DEPTH", "MAX_PRIMS", "Inner nodes", "Leaves", "Spheres a leaf", "Levels"}, {}, ""};
  for (const std::string& letter : kLetters) {
    const Json* result = result_of(context, letter);
    if (result == nullptr) continue;
    const Json& tree = result->at("tree");
    const std::string limits =
        fmt::format("MAX_TREE_DEPTH = {}, MAX_PRIMS = {}", limit_text(values, letter + ".max_depth"),
                    limit_text(values, letter + ".max_prims"));
    trees.rows.push_back({{fmt::format("({})", letter)},
                          {limit_text(values, letter + ".max_depth")},
                          {limit_text(values, letter + ".max_prims")},
                          {tree.at("inner_nodes").dump()},
                          {tree.at("leaves").dump()},
                          {leaf_size_text(tree)},
                          {tree.at("depth").dump()}});
    section.illustrations.push_back(
        illustration_of(kId, result->at("traversal"), fmt::format("({}) {}", letter, limits)));
    section.illustrations.push_back(
        illustration_of(kId, result->at("tree_picture"), fmt::format("({}) the tree itself", letter)));
    add_stated(statements, values, letter, tree, letter, fmt::format("({})", letter), Verdict::differs);
    section.data["trees"][letter] = *result;
  }
  if (!trees.rows.empty()) section.tables.push_back(std::move(trees));
}

Section section_of(const SectionContext& context) {
  Section section;
  section.pairs = true;
  const Values& values = context.values;
  Statements statements("What the text says of the trees", "A count agrees if it is the same in every leaf.");
  const std::string stated_limit = values.printed("abc.max_prims_stated");
  Statements as_stated(
      fmt::format("(a) to (c) with MAX_PRIMS = {}, as the text says", stated_limit),
      "A leaf that may hold everything is never divided, whatever the builder. So where such a tree is "
      "not what the text says of it, two sentences of the text exclude each other.");

  section.data = {{"trees", Json::object()}, {"identical", Json::object()}, {"as_stated", Json::object()}};
  add_trees(context, statements, section);
  for (const auto& pair : kIdentical)
    if (const Json* result = result_of(context, pair_name(pair))) {
      add_identical(statements, values, pair_name(pair), *result);
      section.data["identical"][pair_name(pair)] = *result;
    }
  add_gap_step(statements, context);
  if (const Json* result = result_of(context, "abc_as_stated")) {
    for (const std::string& letter : kByDepth)
      add_stated(as_stated, values, letter, result->at(letter), "as_stated." + letter, fmt::format("({})", letter),
                 Verdict::text_inconsistent);
    section.data["as_stated"] = *result;
  }

  section.paragraphs = {
      fmt::format(
          "One set of spheres under six trees. In the first picture of each pair, green counts the gaps between "
          "siblings that the ray of a pixel passes, {} for each as the text says. The sentence about the other "
          "colour is cut off; \"the area shaded in blue\" is where a leaf was visited. We chose {} of blue for a "
          "leaf and {} for an inner node, less than a gap's green, so that the green areas and the brighter green "
          "that the text describes can be seen; with the same step for all, blue would cover every gap. The plane "
          "is left out.",
          values.printed("gap.green"), values.printed("visit.leaf.blue"), values.printed("visit.inner.blue")),
      "The second picture is the tree itself: on the left the boxes of its nodes, from white at the root to violet at "
      "the "
      "deepest, with gaps as green slabs; on the right every node as a bar above its spheres, one row a level, with "
      "the "
      "gap in an inner node's bar green, in proportion.",
      fmt::format("The text gives MAX_PRIMS = {} for (a) to (c), with which each would be one leaf: but it says itself "
                  "that (b) has several and that (c) is the same tree as (f). Here they have {}, {} and {}.",
                  stated_limit, limit_text(values, "a.max_prims"), limit_text(values, "b.max_prims"),
                  limit_text(values, "c.max_prims"))};
  add_colours(statements, context, section);
  section.data["statements"] = statements.data();
  section.data["statements_as_stated"] = as_stated.data();
  for (Statements* table : {&statements, &as_stated})
    if (!table->empty()) table->move_into(section);
  return section;
}

}  // namespace

Experiment figure_4_3() {
  return {kId, "Figure 4.3: the tree and its traversal", steps_of, section_of};
}

}  // namespace bihive::cli::thesis
