// Figure 4.4: frames a second of brute force and of trees of several MAX_PRIMS, in steps of one configuration.
#include "thesis/figure_4_4.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

#include "bihive/bih/reference_builder.h"
#include "bihive/gl/egl_context.h"
#include "bihive/gl/gl_renderer.h"
#include "bihive/scene/generators.h"
#include "support/failure.h"
#include "thesis/compare.h"
#include "thesis/pictures.h"
#include "thesis/ray_counts.h"
#include "thesis/tree_reasons.h"

namespace bihive::cli::thesis {
namespace {

// The approximate time of a pixel for each unit of frame_cost(); for the estimate of the time left.
constexpr double kSecondsPerPixel = 5e-9;
// A quick run counts the rays of every so many rows and columns.
constexpr int kQuickStride = 4;
// Of a full run, which ends within ten minutes on two cores by them: quartiles need no more. The independence of the
// scenario is by brute force alone, a second or more a frame.
constexpr int kRounds = 7, kRoundsOfIndependence = 5;

FrameRatePlan plan_of(const Settings& settings, const Values& values) {
  FrameRatePlan plan = value_or_fail(FrameRatePlan::from_values(values.stated()));
  plan.seed = settings.seed;
  plan.threads = settings.threads;
  plan.rounds = kRounds;
  return settings.quick ? plan.with_small_pictures() : plan;
}

FrameRatePlan independence_plan_of(const Settings& settings, const Values& values) {
  FrameRatePlan plan = plan_of(settings, values);
  plan.rounds = std::min(plan.rounds, kRoundsOfIndependence);
  return plan;
}

// Runs all rounds. The times of each rate, under the name that `name_of` gives. Empty if cancelled.
Json frame_times(FrameContest contest, const FrameRatePlan& plan, const ComparedEngine& engine,
                 const CancelToken& cancel, const std::function<std::string(const MeasuredRate&)>& name_of) {
  while (!contest.finished()) {
    const Status status = contest.step(&cancel);
    if (cancel.cancelled()) return {};
    if (status) continue;
    if (engine.gpu) fail_environment(status.error());
    fail(status.error());
  }
  Json times = Json::object();
  for (const MeasuredRate& rate : contest.rates()) times[name_of(rate)] = rate.frame_ms;
  return {{"width_px", plan.width_px}, {"height_px", plan.height_px}, {"frame_ms", std::move(times)}};
}

Json measure_configuration(const StepContext& context, const ComparedEngine& engine, std::int64_t scenario,
                           std::int64_t spheres) {
  FrameRatePlan plan = plan_of(context.settings, context.values);
  plan.max_prims = measured_max_prims(context.values, engine, spheres);
  return frame_times(
      value_or_fail(FrameContest::of_trees(plan, engine.engine, scenario, spheres)), plan, engine, context.cancel,
      [](const MeasuredRate& rate) { return rate.max_prims ? fmt::format("max_prims{}", *rate.max_prims) : "brute"; });
}

Json measure_independence(const StepContext& context, const ComparedEngine& engine) {
  const FrameRatePlan plan = independence_plan_of(context.settings, context.values);
  Json by_spheres = Json::object();
  for (const std::int64_t spheres : plan.spheres) {
    by_spheres[fmt::format("spheres{}", spheres)] =
        frame_times(value_or_fail(FrameContest::of_scenarios(plan, engine.engine, spheres)), plan, engine,
                    context.cancel, [](const MeasuredRate& rate) { return fmt::format("scenario{}", rate.scenario); });
    if (context.cancel.cancelled()) return {};
  }
  return by_spheres;
}

// The result of `measure` with this engine; for the graphics processor with its name, or with the reason why there is
// none.
template <class Measure>
Json measure_on(ComparedEngine engine, const Measure& measure) {
  if (!engine.gpu) return measure(engine);
  const Result<EglContext> context = EglContext::create();
  if (!context) return {{kMissing, context.error().message}};
  Result<GlRenderer> renderer = GlRenderer::create(context->functions());
  if (!renderer) return {{kMissing, renderer.error().message}};
  engine.engine.gl = &*renderer;
  Json result = measure(engine);
  if (!result.empty()) result[kGpu] = renderer->description();
  return result;
}

// Seeds beside the run's own, and the rows and columns whose rays count with them: so 60 seeds take a minute.
constexpr int kSeeds = 60, kQuickSeeds = 5, kSeedStride = 4, kQuickSeedStride = 8;

Json counts_of_trees(const StepContext& context, const Scene& scene, const std::vector<std::int64_t>& max_prims,
                     int stride) {
  const PictureSize size = picture_size(Settings{}, context.values, 1);
  Json trees = Json::object();
  for (const std::int64_t prims : max_prims) {
    const Tree tree = build_reference_tree(scene.spheres, {prims, kUnlimited});
    const RayCounts counts = count_rays(context, scene, tree, size, stride);
    if (counts.rays.empty()) return {};
    const RayCounts::Mean mean = counts.mean();
    trees[std::to_string(prims)] = {{"nodes", mean.nodes}, {"leaves", mean.leaves}, {"tests", mean.tests}};
  }
  return trees;
}

Scene scene_with_seed(const StepContext& context, std::int64_t scenario, std::int64_t spheres, std::uint64_t seed) {
  const ScenarioParameters parameters{spheres, static_cast<float>(context.values.number("radius")), seed};
  return value_or_fail(scenario_scene(scenario_of(scenario), parameters));
}

// Counts the trees of the thesis's values of MAX_PRIMS in one scenario, for the seeds 1, 2, ...
Json count_seeds(const StepContext& context, std::int64_t scenario) {
  Json seeds = Json::array();
  for (int seed = 1; seed <= (context.settings.quick ? kQuickSeeds : kSeeds); ++seed) {
    Json by_spheres = Json::object();
    for (const std::int64_t spheres : context.values.integers("spheres_list")) {
      Json trees = counts_of_trees(
          context, scene_with_seed(context, scenario, spheres, static_cast<std::uint64_t>(seed)),
          context.values.integers("max_prims_list"), context.settings.quick ? kQuickSeedStride : kSeedStride);
      if (trees.empty()) return {};
      by_spheres[fmt::format("spheres{}", spheres)] = std::move(trees);
    }
    seeds.push_back(std::move(by_spheres));
  }
  return seeds;
}

// Means over the primary rays: nodes, leaves and tests of each tree, and the tests of brute force.
Json count_scenario(const StepContext& context, std::int64_t number) {
  const Values& values = context.values;
  Json by_spheres = Json::object();
  for (const std::int64_t spheres : values.integers("spheres_list")) {
    Json trees = counts_of_trees(context, scene_with_seed(context, number, spheres, context.settings.seed),
                                 measured_max_prims(values, compared_engines().front(), spheres),
                                 context.settings.quick ? kQuickStride : 1);
    if (trees.empty()) return {};
    by_spheres[fmt::format("spheres{}", spheres)] = {{"brute_tests", spheres}, {"trees", std::move(trees)}};
  }
  return by_spheres;
}

Json measure_balance(const StepContext& context) {
  ReasonTrees trees;
  trees.scenarios = context.values.integers("scenarios");
  trees.spheres = context.values.integers("spheres_list");
  trees.max_prims = context.values.integers("max_prims_list");
  trees.radius = context.values.number("radius");
  trees.seeds = context.settings.quick ? 10 : 100;
  return measure_reasons(context, trees);
}

std::vector<Step> steps_of(const Settings& settings, const Values& values) {
  const FrameRatePlan plan = plan_of(settings, values);
  const double round_seconds = kSecondsPerPixel * plan.width_px * plan.height_px;
  const double seconds = (plan.rounds + 1) * round_seconds;
  const double independence_seconds = (independence_plan_of(settings, values).rounds + 1) * round_seconds;
  std::vector<Step> steps;
  for (const std::int64_t scenario : plan.scenarios)
    steps.push_back({counts_step(scenario), settings.quick ? 0.5 : 8,
                     [scenario](StepContext& context) { return count_scenario(context, scenario); }});
  for (const std::int64_t scenario : plan.scenarios)
    steps.push_back({seeds_step(scenario), settings.quick ? 0.3 : 20,
                     [scenario](StepContext& context) { return count_seeds(context, scenario); }});
  for (const std::int64_t scenario : plan.scenarios)
    for (const std::int64_t spheres : plan.spheres)
      steps.push_back(
          {program_step(scenario, spheres), settings.quick ? 0.2 : 3,
           [scenario, spheres](StepContext& context) { return measure_program(context, scenario, spheres); }});
  steps.push_back({kBalanceStep, 0.3, [](StepContext& context) { return measure_balance(context); }});
  for (const ComparedEngine& engine : compared_engines()) {
    double all_brute = 0;
    for (const std::int64_t scenario : plan.scenarios)
      for (const std::int64_t spheres : plan.spheres) {
        const double brute = frame_cost(spheres, false), tree = frame_cost(spheres, true);
        steps.push_back(
            {configuration_step(engine, scenario, spheres),
             seconds * (brute + tree * static_cast<double>(measured_max_prims(values, engine, spheres).size())),
             [engine, scenario, spheres](StepContext& context) {
               return measure_on(engine, [&](const ComparedEngine& opened) {
                 return measure_configuration(context, opened, scenario, spheres);
               });
             }});
        all_brute += brute;
      }
    steps.push_back({independence_step(engine), independence_seconds * all_brute, [engine](StepContext& context) {
                       return measure_on(
                           engine, [&](const ComparedEngine& opened) { return measure_independence(context, opened); });
                     }});
  }
  steps.push_back({kFloorStep, settings.quick ? 1.0 : 8.0, measure_frames_in_memory});
  return steps;
}

}  // namespace

const std::vector<ComparedEngine>& compared_engines() {
  static const std::vector<ComparedEngine> kCompared{{"reference", {Engine::reference, Engine::brute, {}}},
                                                     {"wide", {Engine::wide, Engine::wide_brute, {}}},
                                                     {"gpu", {Engine::reference, Engine::brute, {}}, true}};
  return kCompared;
}

bool is_of_text(const ComparedEngine& engine) {
  return engine.engine.tree == Engine::reference && !engine.gpu;
}

std::string configuration_step(const ComparedEngine& engine, std::int64_t scenario, std::int64_t spheres) {
  return fmt::format("{}-scenario{}-spheres{}", engine.name, scenario, spheres);
}

std::string independence_step(const ComparedEngine& engine) {
  return engine.name + "-brute_force_by_scenario";
}

std::optional<std::string> why_missing(const Json& result) {
  const auto found = result.find(kMissing);
  return found == result.end() ? std::nullopt : std::optional(found->get<std::string>());
}

std::vector<std::int64_t> measured_max_prims(const Values& values, const ComparedEngine& engine, std::int64_t spheres) {
  std::vector<std::int64_t> all = values.integers("max_prims_list");
  if (engine.gpu) return all;
  for (const std::int64_t beyond : values.integers("max_prims_beyond"))
    if (beyond > all.back() && beyond < spheres) all.push_back(beyond);
  if (spheres > all.back()) all.push_back(spheres);
  return all;
}

std::string seeds_step(std::int64_t scenario) {
  return fmt::format("seeds-scenario{}", scenario);
}

std::string counts_step(std::int64_t scenario) {
  return fmt::format("counts-scenario{}", scenario);
}

Experiment figure_4_4() {
  return {"figure-4.4", "Figure 4.4: frames per second", steps_of, figure_4_4_section};
}

}  // namespace bihive::cli::thesis
