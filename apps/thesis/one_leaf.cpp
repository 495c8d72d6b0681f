// Section D: compares a tree of one leaf with brute force, and with a leaf per sphere. The work of rays is counted, and
// timed.
#include <fmt/format.h>

#include "bihive/bih/observer.h"
#include "bihive/bih/traversal.h"
#include "pictures.h"
#include "statistics.h"

namespace bihive::thesis {
namespace {

// Each repetition is a turn of either tracer.
constexpr int kRepetitions = 15, kQuickRepetitions = 5;
constexpr int kRowStride = 2, kQuickRowStride = 8;  // of the picture's rows

// The same camera in pictures of several shapes: the angle is that of the shorter side, so a box fills more of a
// square.
struct Shape {
  const char *name, *width, *height;  // the names of its values
};
constexpr Shape kShapes[] = {{"landscape", "width_px", "height_px"},
                             {"square", "height_px", "height_px"},
                             {"portrait", "height_px", "width_px"}};

// The first tracer's time over the second's.
Json time_in_turns(const Experiment& experiment, const Tracer& one, const Tracer& other, const std::vector<Ray>& rays) {
  // The hits are summed up, so that both tracers must do the whole work.
  std::int64_t hits[] = {0, 0};
  const auto trace = [&](const Tracer& tracer, std::int64_t& found) {
    for (const Ray& ray : rays) found += tracer.closest_hit(ray).found();
  };
  const Json times = times_in_turns(experiment, experiment.settings.quick ? kQuickRepetitions : kRepetitions,
                                    {{"one", [&] { trace(one, hits[0]); }}, {"other", [&] { trace(other, hits[1]); }}});
  if (times.is_null()) return {};
  BIHIVE_CHECK_EQ(hits[0], hits[1]);
  const std::vector<double> one_ms = times["one"], other_ms = times["other"];
  const double ns = 1e6 / static_cast<double>(std::max<std::size_t>(rays.size(), 1));
  return {{"rays", rays.size()},
          {"ns", median(one_ms) * ns},
          {"other_ns", median(other_ms) * ns},
          {"ratio", quartiles_json(ratios_of(one_ms, other_ms))}};
}

// The tests of one leaf over those of brute force, where this share of the rays meets the box. The test of the box
// counts as one of a sphere.
double work_ratio(double share, const Scene& scene) {
  const double spheres = static_cast<double>(scene.spheres.size());
  return (1 + share * spheres) / spheres;
}

Json time_one_leaf(const Experiment& experiment) {
  const Values& values = experiment.values;
  const Scene scene = values.scene(values.integer("scenario"), values.integer("spheres"), experiment.settings.seed);
  const auto tree_of = [&](std::int64_t max_prims) {
    return value_or_fail(Tracer::build(scene.spheres, Engine::reference, BuildParameters{max_prims, kUnlimited}));
  };
  const Tracer one_leaf = tree_of(kUnlimited), leaf_each = tree_of(1);
  const Tracer brute = value_or_fail(Tracer::build(scene.spheres, Engine::brute));

  Json result = Json::object();
  for (const Shape& shape : kShapes) {
    const int width = values.side(shape.width), height = values.side(shape.height);
    const std::size_t stride = experiment.settings.quick ? kQuickRowStride : kRowStride;
    std::vector<Ray> rays, in_box;
    for_each_ray(scene.camera, width, height, [&](std::size_t pixel, const Ray& ray) {
      if (pixel / static_cast<std::size_t>(width) % stride != 0) return;
      rays.push_back(ray);
      CountingObserver observer;
      traverse<false>(*one_leaf.tree(), scene.spheres, ScaledRay(ray, scene.spheres), observer);
      if (observer.leaf_visits > 0) in_box.push_back(ray);
    });
    Json& timed = result["shapes"][shape.name] = time_in_turns(experiment, one_leaf, brute, rays);
    if (experiment.cancel.cancelled()) return {};
    timed["width_px"] = width;
    timed["height_px"] = height;
    const double share = static_cast<double>(in_box.size()) / static_cast<double>(rays.size());
    timed["box_percent"] = 100 * share;
    timed["work_ratio"] = work_ratio(share, scene);
    if (result.contains("box")) continue;
    result["box"] = time_in_turns(experiment, one_leaf, brute, in_box);
    result["box"]["work_ratio"] = work_ratio(1, scene);
    result["leaf_each"] = time_in_turns(experiment, one_leaf, leaf_each, rays);
  }
  return result;
}

}  // namespace

void section_d(Experiment& experiment) {
  experiment.add("one_leaf", 2, 40, time_one_leaf);
  experiment.make_data = [](const Experiment& timed) {
    const Json* const result = timed.result("one_leaf");
    return result == nullptr ? Json::object() : *result;
  };
}

}  // namespace bihive::thesis
