// Section D: does a tree of one leaf take more than brute force, and is a leaf for each sphere faster? The work of rays
// is counted; their times stand beside it.
#include <fmt/format.h>

#include "bihive/bih/observer.h"
#include "bihive/bih/traversal.h"
#include "bihive/render/tracer.h"
#include "bihive/scene/camera.h"
#include "processor_time.h"
#include "statistics.h"

namespace bihive::thesis {
namespace {

// Each repetition is a turn of either tracer. A first turn of each does not count.
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

std::vector<Ray> primary_rays(const StepContext& context, const Shape& shape) {
  const auto side = [&](const char* name) {
    const std::int64_t px = context.values.integer(name);
    if (px < 1 || px > 65535)
      cli::fail({std::string("/values/") + name + ": expected 1 to 65535 pixels", "values.json", 0, 0, ""});
    return static_cast<int>(px);
  };
  const int width = side(shape.width), height = side(shape.height);
  const PixelRays pixels(thesis_scene_without_spheres().camera, width, height);
  std::vector<Ray> rays;
  for (int y = 0; y < height; y += context.settings.quick ? kQuickRowStride : kRowStride)
    for (int x = 0; x < width; ++x) rays.push_back(pixels.at(x + 0.5, y + 0.5));
  return rays;
}

// Nanoseconds of a ray. The hits are summed up, so that both tracers must do the whole work.
struct Timed {
  double ns;
  std::int64_t hits;
};
Timed time_tracer(const Tracer& tracer, const std::vector<Ray>& rays) {
  std::int64_t hits = 0;
  const double before = thread_ms();
  for (const Ray& ray : rays) hits += tracer.closest_hit(ray).found();
  return {(thread_ms() - before) * 1e6 / static_cast<double>(std::max<std::size_t>(rays.size(), 1)), hits};
}

// The first tracer's time over the second's, in turns.
Json time_in_turns(const StepContext& context, const Tracer& one, const Tracer& other, const std::vector<Ray>& rays) {
  std::vector<double> one_ns, other_ns, ratios;
  const int repetitions = context.settings.quick ? kQuickRepetitions : kRepetitions;
  for (int repetition = -1; repetition < repetitions && !context.cancel.cancelled(); ++repetition) {
    // The order changes in every second repetition, so that a machine that slows down favours neither.
    const bool swapped = repetition % 2 != 0;
    const Timed first = time_tracer(swapped ? other : one, rays), second = time_tracer(swapped ? one : other, rays);
    BIHIVE_CHECK_EQ(first.hits, second.hits);
    if (repetition < 0) continue;
    one_ns.push_back((swapped ? second : first).ns);
    other_ns.push_back((swapped ? first : second).ns);
    ratios.push_back(one_ns.back() / other_ns.back());
  }
  if (ratios.empty()) return {};
  return {
      {"rays", rays.size()}, {"ns", median(one_ns)}, {"other_ns", median(other_ns)}, {"ratio", quartiles_json(ratios)}};
}

// The tests of one leaf over those of brute force, where this share of the rays meets the box. The test of the box
// counts as one of a sphere.
double work_ratio(double share, const Scene& scene) {
  const double spheres = static_cast<double>(scene.spheres.size());
  return (1 + share * spheres) / spheres;
}

Json time_one_leaf(StepContext& context) {
  const Values& values = context.values;
  const Scene scene = values.scene(values.integer("scenario"), values.integer("spheres"), context.settings.seed);
  const auto tree_of = [&](std::int64_t max_prims) {
    return cli::value_or_fail(Tracer::build(scene.spheres, Engine::reference, BuildParameters{max_prims, kUnlimited}));
  };
  const Tracer one_leaf = tree_of(kUnlimited), leaf_each = tree_of(1);
  const Tracer brute = cli::value_or_fail(Tracer::build(scene.spheres, Engine::brute));

  Json result = Json::object();
  for (const Shape& shape : kShapes) {
    const std::vector<Ray> rays = primary_rays(context, shape);
    std::vector<Ray> in_box;
    for (const Ray& ray : rays) {
      CountingObserver observer;
      traverse<false>(*one_leaf.tree(), one_leaf.spheres(), ScaledRay(ray, one_leaf.spheres()), observer);
      if (observer.leaf_visits > 0) in_box.push_back(ray);
    }
    Json& timed = result["shapes"][shape.name] = time_in_turns(context, one_leaf, brute, rays);
    if (context.cancel.cancelled()) return {};
    timed["width_px"] = values.integer(shape.width);
    timed["height_px"] = values.integer(shape.height);
    const double share = static_cast<double>(in_box.size()) / static_cast<double>(rays.size());
    timed["box_percent"] = 100 * share;
    timed["work_ratio"] = work_ratio(share, scene);
    if (result.contains("box")) continue;
    result["box"] = time_in_turns(context, one_leaf, brute, in_box);
    result["box"]["work_ratio"] = work_ratio(1, scene);
    result["leaf_each"] = time_in_turns(context, one_leaf, leaf_each, rays);
  }
  return result;
}

}  // namespace

ExperimentCode section_d() {
  return {[](const Settings& settings, const Values&) {
            return std::vector<Step>{{"one_leaf", settings.quick ? 2.0 : 40.0, time_one_leaf}};
          },
          [](const DataContext& context) {
            const Json* const result = context.result("one_leaf");
            return result == nullptr ? Json::object() : *result;
          }};
}

}  // namespace bihive::thesis
