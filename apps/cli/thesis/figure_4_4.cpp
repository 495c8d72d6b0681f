// Figure 4.4: frames a second of brute force and of trees of several MAX_PRIMS.
//
// A frame is render() of the shaded view to a film. Camera rays and shading are the same for all; only the search for
// hits differs. The graphics processor draws the same picture and keeps it.
#include "thesis/figure_4_4.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "bihive/render/renderer.h"
#include "bihive/scene/generators.h"
#include "support/failure.h"
#include "thesis/frame_contestant.h"

namespace bihive::cli::thesis {
namespace {

// A quick run draws pictures of a quarter of the width and height.
constexpr int kQuickDivisor = 4;
constexpr int kRepetitions = 9;
// A frame that takes less time than this is repeated, so that a single moment of the machine does not decide.
constexpr double kLeastMs = 15;
// The approximate time of a frame of a full run by brute force for each of its spheres; for the estimate of the time
// left.
constexpr double kSecondsPerSphere = 0.0035;

RenderSettings frame_settings(const Settings& settings, const Values& values, const Scene& scene) {
  RenderSettings frame = settings_from(scene.picture);
  const int divisor = settings.quick ? kQuickDivisor : 1;
  frame.width_px = static_cast<int>(values.integer("width_px")) / divisor;
  frame.height_px = static_cast<int>(values.integer("height_px")) / divisor;
  frame.recursion = static_cast<int>(values.integer("recursion"));
  frame.threads = settings.threads;
  return frame;
}

Scene scene_of(const StepContext& context, std::int64_t scenario, std::int64_t spheres) {
  ScenarioParameters parameters;
  parameters.count = spheres;
  parameters.radius = static_cast<float>(context.values.number("radius"));
  parameters.seed = context.settings.seed;
  return value_or_fail(scenario_scene(static_cast<Scenario>(scenario), parameters));
}

// Milliseconds of a frame, from as many frames as kLeastMs needs. Nothing if cancelled.
std::optional<double> frame_ms(Contestant& contestant, const RenderSettings& settings, const CancelToken& cancel) {
  contestant.prepare();
  double all_ms = 0;
  int frames = 0;
  for (; all_ms < kLeastMs; ++frames) {
    all_ms += contestant.draw(settings, cancel);
    if (cancel.cancelled()) return std::nullopt;
  }
  return all_ms / frames;
}

// All contestants take turns, so that a slow minute of the machine affects all. The first round warms up and does not
// count.
Json frame_times(const std::vector<std::unique_ptr<Contestant>>& contestants, const StepContext& context) {
  const RenderSettings settings = frame_settings(context.settings, context.values, contestants.front()->scene());
  Json times = Json::object();
  for (int i = -1; i < kRepetitions; ++i)
    for (const std::unique_ptr<Contestant>& contestant : contestants) {
      const std::optional<double> ms = frame_ms(*contestant, settings, context.cancel);
      if (!ms) return {};
      if (i >= 0) times[contestant->name()].push_back(*ms);
    }
  return {{"width_px", settings.width_px}, {"height_px", settings.height_px}, {"frame_ms", std::move(times)}};
}

Json measure_configuration(const StepContext& context, const ComparedEngine& engine, std::int64_t scenario,
                           std::int64_t spheres, const ContestantMaker& make) {
  const Scene scene = scene_of(context, scenario, spheres);
  std::vector<std::unique_ptr<Contestant>> contestants;
  contestants.push_back(
      make("brute", scene, value_or_fail(Tracer::build(scene.spheres, engine.brute, engine.brute_parameters))));
  for (const double max_prims : context.values.numbers("max_prims_list")) {
    BuildParameters parameters;
    parameters.max_prims = static_cast<std::int64_t>(max_prims);
    contestants.push_back(make(fmt::format("max_prims{}", max_prims), scene,
                               value_or_fail(Tracer::build(scene.spheres, engine.tree, parameters))));
  }
  return frame_times(contestants, context);
}

Json measure_independence(const StepContext& context, const ComparedEngine& engine, const ContestantMaker& make) {
  Json by_spheres = Json::object();
  for (const double spheres : context.values.numbers("spheres_list")) {
    const std::vector<double> scenarios = context.values.numbers("scenarios");
    std::vector<Scene> scenes;
    scenes.reserve(scenarios.size());
    std::vector<std::unique_ptr<Contestant>> contestants;
    for (const double scenario : scenarios) {
      scenes.push_back(scene_of(context, static_cast<std::int64_t>(scenario), static_cast<std::int64_t>(spheres)));
      contestants.push_back(
          make(fmt::format("scenario{}", scenario), scenes.back(),
               value_or_fail(Tracer::build(scenes.back().spheres, engine.brute, engine.brute_parameters))));
    }
    by_spheres[fmt::format("spheres{}", spheres)] = frame_times(contestants, context);
    if (context.cancel.cancelled()) return {};
  }
  return by_spheres;
}

// The result of `measure` with contestants of this engine; for the graphics processor with its name.
template <class Measure>
Json measure_on(const ComparedEngine& engine, const Measure& measure) {
  if (!engine.gpu) return measure(cpu_contestants());
  const Result<std::shared_ptr<Gpu>> gpu = Gpu::open();
  if (!gpu) return {{kMissing, gpu.error().message}};
  Json result = measure(gpu_contestants(*gpu));
  if (!result.empty()) result[kGpu] = (*gpu)->renderer.description();
  return result;
}

std::vector<Step> steps_of(const Settings& settings, const Values& values) {
  std::vector<Step> steps;
  const double weight = (kRepetitions + 1) * kSecondsPerSphere / (settings.quick ? kQuickDivisor * kQuickDivisor : 1);
  const std::vector<double> scenarios = values.numbers("scenarios"), counts = values.numbers("spheres_list");
  for (const ComparedEngine& engine : compared_engines()) {
    double all_spheres = 0;
    for (const double scenario_number : scenarios)
      for (const double spheres_number : counts) {
        const auto scenario = static_cast<std::int64_t>(scenario_number),
                   spheres = static_cast<std::int64_t>(spheres_number);
        steps.push_back({configuration_step(engine, scenario, spheres), 1.5 * weight * spheres_number,
                         [engine, scenario, spheres](StepContext& context) {
                           return measure_on(engine, [&](const ContestantMaker& make) {
                             return measure_configuration(context, engine, scenario, spheres, make);
                           });
                         }});
        all_spheres += spheres_number;
      }
    steps.push_back({independence_step(engine), weight * all_spheres, [engine](StepContext& context) {
                       return measure_on(engine, [&](const ContestantMaker& make) {
                         return measure_independence(context, engine, make);
                       });
                     }});
  }
  return steps;
}

}  // namespace

const std::vector<ComparedEngine>& compared_engines() {
  static const std::vector<ComparedEngine> kCompared{{"reference", Engine::reference, Engine::brute, {}},
                                                     {"wide", Engine::wide, Engine::wide, {std::nullopt, 1}},
                                                     {"gpu", Engine::reference, Engine::brute, {}, true}};
  return kCompared;
}

std::string configuration_step(const ComparedEngine& engine, std::int64_t scenario, std::int64_t spheres) {
  return fmt::format("{}-scenario{}-spheres{}", engine.name, scenario, spheres);
}

std::string independence_step(const ComparedEngine& engine) {
  return engine.name + "-brute_force_by_scenario";
}

std::size_t ConfigurationFps::best() const {
  return static_cast<std::size_t>(std::max_element(trees.begin(), trees.end()) - trees.begin());
}

double ConfigurationFps::gain_percent() const {
  return 100 * (trees[best()] / brute - 1);
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::optional<std::string> why_missing(const Json& result) {
  const auto found = result.find(kMissing);
  return found == result.end() ? std::nullopt : std::optional(found->get<std::string>());
}

std::optional<ConfigurationFps> fps_of(const StepResults& results, const ComparedEngine& engine, std::int64_t scenario,
                                       std::int64_t spheres) {
  const auto found = results.find(configuration_step(engine, scenario, spheres));
  if (found == results.end() || why_missing(found->second)) return std::nullopt;
  ConfigurationFps fps{0, {}};
  for (const auto& [name, times] : found->second["frame_ms"].items()) {
    const double value = 1000 / median(times.get<std::vector<double>>());
    if (name == "brute")
      fps.brute = value;
    else
      fps.trees.push_back(value);
  }
  return fps;
}

Experiment figure_4_4() {
  return {"figure-4.4", "Figure 4.4: frames per second", steps_of, figure_4_4_section};
}

}  // namespace bihive::cli::thesis
