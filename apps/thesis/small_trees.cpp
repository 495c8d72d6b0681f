// Figure 4.3: six trees over one set of spheres, each in a picture of its traversal and in a drawing of the tree
// itself.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "bihive/bih/observer.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/bih/traversal.h"
#include "pictures.h"

namespace bihive::thesis {
namespace {

const std::vector<std::string> kLetters{"a", "b", "c", "d", "e", "f"};
// The pictures that the text calls identical, and those that it describes by MAX_TREE_DEPTH.
const std::vector<std::pair<std::string, std::string>> kIdentical{{"a", "d"}, {"c", "f"}};
const std::vector<std::string> kByDepth{"a", "b", "c"};

Json tree_facts(const Tree& tree) {
  const TreeStatistics all = tree_statistics(tree);
  const MinAvgMax& in_leaf = all.spheres_per_leaf;
  return {{"inner_nodes", all.inner_nodes},
          {"leaves", all.leaves},
          {"spheres_per_leaf",
           in_leaf.min == in_leaf.max ? Json(in_leaf.min) : Json(fmt::format("{} to {}", in_leaf.min, in_leaf.max))},
          {"depth", all.depth.max}};
}

Scene scene_of(const Experiment& experiment) {
  const Values& values = experiment.values;
  return values.scene(values.integer("scenario"), values.integer("spheres"), experiment.settings.seed);
}

// The nodes of a tree and the order of its spheres: of equal trees, equal lists.
Json nodes_of(const Tree& tree) {
  Json nodes = Json::array();
  for (const Node& node : tree.nodes)
    nodes.push_back(fmt::format("{} {} {} {} {} {}", static_cast<int>(node.kind), static_cast<int>(node.split_axis),
                                node.left_clip, node.right_clip, node.first, node.sphere_count));
  for (const std::int64_t id : tree.sphere_ids) nodes.push_back(std::to_string(id));
  return nodes;
}

// The picture, and what is seen in it: colours as shares of its pixels. Green for gaps, as `bihive render --view
// traversal` draws it. Blue for inner nodes and leaves, each by its own step in values.json and at most 1: there that
// view has one step for both. "green_step": the smallest green above 0, which is that of one gap.
Json seen_in(const Experiment& experiment, const Scene& scene, const Tree& tree, Image& picture) {
  const Values& values = experiment.values;
  const double of_inner = values.number("visit.inner.blue"), of_leaf = values.number("visit.leaf.blue");
  std::int64_t green = 0, blue = 0, bright = 0, gaps = 0, visits = 0;
  int smallest = 0;
  for_each_ray(scene.camera, picture.width, picture.height, [&](std::size_t pixel, const Ray& ray) {
    CountingObserver seen;
    traverse<false>(tree, scene.spheres, ScaledRay(ray, scene.spheres), seen);
    const double steps =
        of_inner * static_cast<double>(seen.node_visits) + of_leaf * static_cast<double>(seen.leaf_visits);
    const int g = picture.rgb[3 * pixel + 1], b = static_cast<int>(std::lround(255 * std::clamp(steps, 0.0, 1.0)));
    picture.rgb[3 * pixel + 2] = static_cast<std::uint8_t>(b);
    green += g > b;
    blue += b > 0 && b >= g;
    bright += seen.empty_gaps >= 2;
    gaps += seen.empty_gaps;
    visits += seen.node_visits + seen.leaf_visits;
    if (g > 0 && (smallest == 0 || g < smallest)) smallest = g;
  });
  const auto per_ray = [all = static_cast<double>(picture.rgb.size()) / 3](std::int64_t count) {
    return static_cast<double>(count) / all;
  };
  return {{"green_percent", 100 * per_ray(green)},
          {"blue_percent", 100 * per_ray(blue)},
          {"several_gaps_percent", 100 * per_ray(bright)},
          {"gaps_per_ray", per_ray(gaps)},
          {"nodes_per_ray", per_ray(visits)},
          {"green_step", smallest / 255.0}};
}

Json draw_tree(const Experiment& experiment, const std::string& letter) {
  const Values& values = experiment.values;
  const std::int64_t max_depth = values.limit(letter + ".max_depth"), max_prims = values.limit(letter + ".max_prims");
  const Scene scene = scene_of(experiment);
  const Tracer tracer =
      value_or_fail(Tracer::build(scene.spheres, Engine::reference, BuildParameters{max_prims, max_depth}));
  std::optional<Image> traversal =
      draw(experiment, scene, tracer, picture_settings(experiment, scene, View::traversal));
  // The drawing of the tree has two halves, so it is twice as large in a quick run.
  const std::optional<Image> tree = draw(experiment, scene, tracer, picture_settings(experiment, scene, View::tree, 2));
  if (!traversal || !tree) return {};
  const Json seen = seen_in(experiment, scene, *tracer.tree(), *traversal);
  const auto limit_text = [](std::int64_t limit) { return limit == kUnlimited ? "∞" : std::to_string(limit); };
  return {{"letter", letter},
          {"max_depth", limit_text(max_depth)},
          {"max_prims", limit_text(max_prims)},
          {"traversal", write_picture(experiment, letter + "-traversal.png", *traversal)},
          {"tree_picture", write_picture(experiment, letter + "-tree.png", *tree)},
          {"tree", tree_facts(*tracer.tree())},
          {"nodes", nodes_of(*tracer.tree())},
          {"seen", seen}};
}

// Compares two trees node by node, and their pictures.
Json compare(const Json& one, const Json& other) {
  const Json &a = one["nodes"], &b = other["nodes"];
  std::size_t different = std::max(a.size(), b.size()) - std::min(a.size(), b.size());
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) different += a[i] != b[i];
  const bool same = one["traversal"]["picture_hash"] == other["traversal"]["picture_hash"];
  return {{"different_nodes", different}, {"pictures", same ? "the same" : "different"}};
}

// The trees of (a) to (c) with the MAX_PRIMS that the text gives for them.
Json build_as_stated(const Experiment& experiment) {
  const Values& values = experiment.values;
  const SphereSet spheres = scene_of(experiment).spheres;
  Json trees = Json::object();
  for (const std::string& letter : kByDepth)
    trees[letter] = tree_facts(
        build_reference_tree(spheres, {values.limit("abc.max_prims_stated"), values.limit(letter + ".max_depth")}));
  return trees;
}

// The text's claims about the colours: the smallest step of green is one gap, which trees show more green than blue,
// and in which tree a ray crosses the most gaps.
void add_colours(Json& data) {
  double smallest = 1, most = 0;
  std::vector<std::string> green, widest;
  for (const auto& [letter, tree] : data["trees"].items()) {
    if (const double step = tree["seen"]["green_step"]; step > 0) smallest = std::min(smallest, step);
    if (tree["seen"]["green_percent"] > 0) green.push_back(letter);
    const double gaps = tree["seen"]["gaps_per_ray"];
    if (gaps > most) widest.clear();
    if (gaps >= most) widest.push_back(letter);
    most = std::max(most, gaps);
  }
  data["gap"] = {{"green", smallest}};
  data["green_areas"] = fmt::format("{}", fmt::join(green, ", "));
  data["most_empty_space"] = fmt::format("{}", fmt::join(widest, ", "));
}

}  // namespace

void figure_4_3(Experiment& experiment) {
  for (const std::string& letter : kLetters) experiment.add(letter, 0.1, 0.7, draw_tree, letter);
  experiment.add("as_stated", 0.01, 0.01, build_as_stated);
  experiment.make_data = [](const Experiment& drawn) {
    Json data = Json::object();
    for (const auto& [name, result] : drawn.finished()) {
      Json& one = name.size() == 1 ? data["trees"][name] : data[name];
      one = *result;
      one.erase("nodes");
    }
    for (const auto& [first, second] : kIdentical) {
      const Json *const one = drawn.result(first), *const other = drawn.result(second);
      if (one != nullptr && other != nullptr) data[first + "_and_" + second] = compare(*one, *other);
    }
    if (data.contains("trees") && data["trees"].size() == kLetters.size()) add_colours(data);
    return data;
  };
}

}  // namespace bihive::thesis
