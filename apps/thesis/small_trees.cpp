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

constexpr int kQuickDivisor = 4;
// The drawing of the tree has two parts, so it is twice as large in a quick run.
constexpr int kQuickTreeDivisor = 2;
// The pictures that the text calls identical, and those that it describes by MAX_TREE_DEPTH.
const std::vector<std::string> kLetters{"a", "b", "c", "d", "e", "f"};
const std::vector<std::pair<std::string, std::string>> kIdentical{{"a", "d"}, {"c", "f"}};
const std::vector<std::string> kByDepth{"a", "b", "c"};
constexpr const char* kAsStatedStep = "abc_as_stated";

BuildParameters parameters_of(const Values& values, const std::string& letter) {
  return {values.limit(letter + ".max_prims"), values.limit(letter + ".max_depth")};
}

// All leaves hold as many, or a range in words.
Json one_number(const MinAvgMax& of) {
  return of.min == of.max ? Json(of.min) : Json(fmt::format("{} to {}", of.min, of.max));
}

Json tree_facts(const Tree& tree) {
  const TreeStatistics statistics = tree_statistics(tree);
  return {{"inner_nodes", statistics.inner_nodes},
          {"leaves", statistics.leaves},
          {"spheres_per_leaf", one_number(statistics.spheres_per_leaf)},
          {"depth", statistics.depth.max}};
}

// The smallest value above 0 of a channel: one gap or one visit.
double smallest_step(const Image& image, std::size_t channel) {
  int smallest = 0;
  for (std::size_t i = channel; i < image.rgb.size(); i += 3)
    if (image.rgb[i] > 0 && (smallest == 0 || image.rgb[i] < smallest)) smallest = image.rgb[i];
  return smallest / 255.0;
}

// A tree of the figure, what the primary ray of each pixel does in it, row by row, and the picture of that.
struct SmallTree {
  std::unique_ptr<const Scene> scene;  // the tracer refers to its spheres
  Tracer tracer;
  std::vector<CountingObserver> rays;
  Image picture;
};

// Green for gaps, as `bihive render --view traversal` draws it. Blue for inner nodes and leaves, each by its own step
// in values.json and at most 1: there that view has one step for both. Nothing if cancelled.
std::optional<SmallTree> draw_traversal(const StepContext& context, const std::string& letter) {
  const Values& values = context.values;
  auto made = std::make_unique<const Scene>(
      values.scene(values.integer("scenario"), values.integer("spheres"), context.settings.seed));
  const Scene& scene = *made;
  Tracer tracer = cli::value_or_fail(Tracer::build(scene.spheres, Engine::reference, parameters_of(values, letter)));
  const cli::PictureSize size = picture_size(context.settings, values, kQuickDivisor);
  std::optional<Image> picture = draw(context, scene, tracer, picture_settings(context, scene, size, View::traversal));
  if (!picture) return std::nullopt;

  const PixelRays pixels(scene.camera, size.width_px, size.height_px);
  const double of_inner = values.number("visit.inner.blue"), of_leaf = values.number("visit.leaf.blue");
  std::vector<CountingObserver> rays(picture->rgb.size() / 3);
  parallel_for(context.settings.threads, size.height_px, [&](std::int64_t y) {
    for (int x = 0; x < size.width_px; ++x) {
      const auto i = static_cast<std::size_t>(y * size.width_px + x);
      traverse<false>(*tracer.tree(), scene.spheres,
                      ScaledRay(pixels.at(x + 0.5, static_cast<double>(y) + 0.5), scene.spheres), rays[i]);
      const double blue =
          of_inner * static_cast<double>(rays[i].node_visits) + of_leaf * static_cast<double>(rays[i].leaf_visits);
      picture->rgb[3 * i + 2] = static_cast<std::uint8_t>(std::lround(255 * std::clamp(blue, 0.0, 1.0)));
    }
  });
  return SmallTree{std::move(made), std::move(tracer), std::move(rays), std::move(*picture)};
}

// What can be seen in the picture, as shares of its pixels.
Json seen_in(const Image& image, const std::vector<CountingObserver>& counts) {
  std::int64_t green = 0, blue = 0, bright = 0, saturated = 0, gaps = 0, visits = 0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const CountingObserver& ray = counts[i];
    const int g = image.rgb[3 * i + 1], b = image.rgb[3 * i + 2];
    green += g > b;
    blue += b > 0 && b >= g;
    bright += ray.empty_gaps >= 2;
    saturated += g == 255 || b == 255;
    gaps += ray.empty_gaps;
    visits += ray.node_visits + ray.leaf_visits;
  }
  const double all = static_cast<double>(counts.size());
  return {{"green_percent", 100 * static_cast<double>(green) / all},
          {"blue_percent", 100 * static_cast<double>(blue) / all},
          {"several_gaps_percent", 100 * static_cast<double>(bright) / all},
          {"saturated_percent", 100 * static_cast<double>(saturated) / all},
          {"gaps_per_ray", static_cast<double>(gaps) / all},
          {"nodes_per_ray", static_cast<double>(visits) / all}};
}

Json draw_tree(const StepContext& context, const std::string& letter) {
  const std::optional<SmallTree> small = draw_traversal(context, letter);
  if (!small) return {};
  const cli::PictureSize size = picture_size(context.settings, context.values, kQuickTreeDivisor);
  const std::optional<Image> tree =
      draw(context, *small->scene, small->tracer, picture_settings(context, *small->scene, size, View::tree));
  if (!tree) return {};
  const auto limit_text = [&](const std::string& name) {
    const std::int64_t limit = context.values.limit(letter + name);
    return limit == kUnlimited ? std::string("∞") : std::to_string(limit);
  };
  return {{"letter", letter},
          {"max_depth", limit_text(".max_depth")},
          {"max_prims", limit_text(".max_prims")},
          {"traversal", write_picture(context, letter + "-traversal.png", small->picture)},
          {"tree_picture", write_picture(context, letter + "-tree.png", *tree)},
          {"tree", tree_facts(*small->tracer.tree())},
          {"green_step", smallest_step(small->picture, 1)},
          {"seen", seen_in(small->picture, small->rays)}};
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
  const std::optional<SmallTree> one = draw_traversal(context, first), other = draw_traversal(context, second);
  if (!one || !other) return {};
  const Tree &a = *one->tracer.tree(), &b = *other->tracer.tree();
  return {{"nodes", a.nodes.size()},
          {"different_nodes", differences(a.nodes, b.nodes, same_node)},
          {"different_places", differences(a.sphere_ids, b.sphere_ids, std::equal_to<>())},
          {"different_pixels", difference_of(one->picture, other->picture).pixels}};
}

// The trees of (a) to (c) with the MAX_PRIMS that the text gives for them.
Json build_as_stated(const StepContext& context) {
  const Values& values = context.values;
  const Scene scene = values.scene(values.integer("scenario"), values.integer("spheres"), context.settings.seed);
  Json trees = Json::object();
  for (const std::string& letter : kByDepth)
    trees[letter] = tree_facts(build_reference_tree(
        scene.spheres, {values.limit("abc.max_prims_stated"), values.limit(letter + ".max_depth")}));
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
  steps.push_back({kAsStatedStep, 0.01, [](StepContext& context) { return build_as_stated(context); }});
  return steps;
}

// What the text says of the colours: the smallest green is that of one gap; where there is more green than blue; where
// a ray passes the most gaps.
void add_colours(Json& data) {
  double smallest = 1, most = 0;
  std::vector<std::string> green, widest;
  for (const auto& [letter, tree] : data["trees"].items()) {
    if (const double step = tree["green_step"].get<double>(); step > 0) smallest = std::min(smallest, step);
    const Json& seen = tree["seen"];
    if (seen["green_percent"].get<double>() > 0) green.push_back(letter);
    const double gaps = seen["gaps_per_ray"].get<double>();
    if (gaps > most) widest.clear();
    if (gaps >= most) widest.push_back(letter);
    most = std::max(most, gaps);
  }
  data["gap"] = {{"green", smallest}};
  data["green_areas"] = fmt::format("{}", fmt::join(green, ", "));
  data["most_empty_space"] = fmt::format("{}", fmt::join(widest, ", "));
}

Json data_of(const DataContext& context) {
  Json data = Json::object();
  for (const std::string& letter : kLetters)
    if (const Json* const tree = context.result(letter)) data["trees"][letter] = *tree;
  for (const auto& pair : kIdentical)
    if (const Json* const same = context.result(pair_name(pair))) data[pair_name(pair)] = *same;
  if (const Json* const stated = context.result(kAsStatedStep)) data["as_stated"] = *stated;
  if (data.contains("trees") && data["trees"].size() == kLetters.size()) add_colours(data);
  return data;
}

}  // namespace

ExperimentCode figure_4_3() {
  return {steps_of, data_of};
}

}  // namespace bihive::thesis
