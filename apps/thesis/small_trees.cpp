// Figure 4.3: six trees over one set of spheres, each in a picture of its traversal and in a drawing of the tree
// itself.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "bihive/base/parallel.h"
#include "bihive/bih/observer.h"
#include "bihive/bih/reference_builder.h"
#include "bihive/bih/statistics.h"
#include "bihive/bih/traversal.h"
#include "bihive/image/image_diff.h"
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

// A tree of the figure, the steps of each pixel's primary ray, row by row, and the picture of these.
struct SmallTree {
  std::unique_ptr<const Scene> scene;  // the tracer refers to its spheres
  Tracer tracer;
  std::vector<CountingObserver> rays;
  Image picture;
};

// Green for gaps, as `bihive render --view traversal` draws it. Blue for inner nodes and leaves, each by its own step
// in values.json and at most 1: there that view has one step for both. Nothing if cancelled.
std::optional<SmallTree> draw_traversal(const Experiment& experiment, const std::string& letter) {
  const Values& values = experiment.values;
  auto made = std::make_unique<const Scene>(scene_of(experiment));
  const Scene& scene = *made;
  Tracer tracer = value_or_fail(
      Tracer::build(scene.spheres, Engine::reference,
                    BuildParameters{values.limit(letter + ".max_prims"), values.limit(letter + ".max_depth")}));
  const RenderSettings settings = picture_settings(experiment, scene, View::traversal);
  std::optional<Image> picture = draw(experiment, scene, tracer, settings);
  if (!picture) return std::nullopt;
  const double of_inner = values.number("visit.inner.blue"), of_leaf = values.number("visit.leaf.blue");
  std::vector<CountingObserver> rays(picture->rgb.size() / 3);
  for_each_ray(scene.camera, settings.width_px, settings.height_px, [&](std::size_t pixel, const Ray& ray) {
    CountingObserver& seen = rays[pixel];
    traverse<false>(*tracer.tree(), scene.spheres, ScaledRay(ray, scene.spheres), seen);
    const double blue =
        of_inner * static_cast<double>(seen.node_visits) + of_leaf * static_cast<double>(seen.leaf_visits);
    picture->rgb[3 * pixel + 2] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(blue, 0.0, 1.0)));
  });
  return SmallTree{std::move(made), std::move(tracer), std::move(rays), std::move(*picture)};
}

// Counts colours in the picture, as shares of its pixels, and returns its smallest green above 0, which is that of one
// gap.
Json seen_in(const SmallTree& tree, double& green_step) {
  std::int64_t green = 0, blue = 0, bright = 0, gaps = 0, visits = 0;
  int smallest = 0;
  for (std::size_t i = 0; i < tree.rays.size(); ++i) {
    const CountingObserver& ray = tree.rays[i];
    const int g = tree.picture.rgb[3 * i + 1], b = tree.picture.rgb[3 * i + 2];
    green += g > b;
    blue += b > 0 && b >= g;
    bright += ray.empty_gaps >= 2;
    gaps += ray.empty_gaps;
    visits += ray.node_visits + ray.leaf_visits;
    if (g > 0 && (smallest == 0 || g < smallest)) smallest = g;
  }
  green_step = smallest / 255.0;
  const auto per_ray = [&](std::int64_t count) {
    return static_cast<double>(count) / static_cast<double>(tree.rays.size());
  };
  return {{"green_percent", 100 * per_ray(green)},
          {"blue_percent", 100 * per_ray(blue)},
          {"several_gaps_percent", 100 * per_ray(bright)},
          {"gaps_per_ray", per_ray(gaps)},
          {"nodes_per_ray", per_ray(visits)}};
}

Json draw_tree(const Experiment& experiment, const std::string& letter) {
  const std::optional<SmallTree> small = draw_traversal(experiment, letter);
  if (!small) return {};
  // The drawing of the tree has two halves, so it is twice as large in a quick run.
  const std::optional<Image> tree =
      draw(experiment, *small->scene, small->tracer, picture_settings(experiment, *small->scene, View::tree, 2));
  if (!tree) return {};
  const auto limit_text = [&](const std::string& name) {
    const std::int64_t limit = experiment.values.limit(letter + name);
    return limit == kUnlimited ? std::string("∞") : std::to_string(limit);
  };
  double green_step = 0;
  const Json seen = seen_in(*small, green_step);
  return {{"letter", letter},
          {"max_depth", limit_text(".max_depth")},
          {"max_prims", limit_text(".max_prims")},
          {"traversal", write_picture(experiment, letter + "-traversal.png", small->picture)},
          {"tree_picture", write_picture(experiment, letter + "-tree.png", *tree)},
          {"tree", tree_facts(*small->tracer.tree())},
          {"green_step", green_step},
          {"seen", seen}};
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
Json compare(const Experiment& experiment, const std::string& first, const std::string& second) {
  const std::optional<SmallTree> one = draw_traversal(experiment, first), other = draw_traversal(experiment, second);
  if (!one || !other) return {};
  const Tree &a = *one->tracer.tree(), &b = *other->tracer.tree();
  return {{"nodes", a.nodes.size()},
          {"different_nodes",
           differences(a.nodes, b.nodes, same_node) + differences(a.sphere_ids, b.sphere_ids, std::equal_to<>())},
          {"different_pixels", difference_of(one->picture, other->picture).pixels}};
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
    if (const double step = tree["green_step"]; step > 0) smallest = std::min(smallest, step);
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
  for (const auto& [first, second] : kIdentical)
    experiment.add(first + "_and_" + second, 0.1, 0.7, compare, first, second);
  experiment.add("as_stated", 0.01, 0.01, build_as_stated);
  experiment.make_data = [](const Experiment& drawn) {
    Json data = Json::object();
    for (const auto& [name, result] : drawn.finished()) (name.size() == 1 ? data["trees"][name] : data[name]) = *result;
    if (data.contains("trees") && data["trees"].size() == kLetters.size()) add_colours(data);
    return data;
  };
}

}  // namespace bihive::thesis
