// The times of Figure 4.4's frames.
#include <fmt/format.h>

#include <algorithm>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/gl/egl_context.h"
#include "bihive/thesis/thesis_program.h"
#include "figure_4_4.h"
#include "pictures.h"
#include "statistics.h"

namespace bihive::thesis {
namespace {

// Pictures have a fraction of the width and height: the time of a ray does not depend on their number. On a GPU it
// does, so its frames are whole in a full run.
constexpr int kDivisor = 2, kQuickDivisor = 4, kQuickReferenceDivisor = 6;

Json measured(const FrameRatePlan& plan, Json times) {
  return {{"width_px", plan.width_px}, {"height_px", plan.height_px}, {"frame_ms", std::move(times)}};
}

Json measure_program(const Experiment& experiment, std::int64_t scenario, std::int64_t spheres) {
  const FrameRatePlan plan = plan_of(experiment, kDivisor, kQuickDivisor);
  const Scene scene = value_or_fail(plan.scene(scenario, spheres));
  // A tree of each MAX_PRIMS, and brute force, which needs none.
  std::vector<std::int32_t> ids;
  std::map<std::int64_t, Tree> trees;
  std::map<std::int64_t, ThesisProgram> programs;
  Contestants contestants{{"brute", [&] { programs.begin()->second.draw(plan.width_px, plan.height_px, false, ids); }}};
  for (const std::int64_t prims : plan.max_prims) {
    trees[prims] = build_reference_tree(scene.spheres, {prims, kUnlimited});
    const ThesisProgram* const program = &programs.emplace(prims, ThesisProgram(scene, trees[prims])).first->second;
    contestants.emplace_back(fmt::format("max_prims{}", prims),
                             [&, program] { program->draw(plan.width_px, plan.height_px, true, ids); });
  }
  Json times = times_in_turns(experiment, plan.rounds, contestants);
  if (times.is_null()) return {};

  std::int64_t most = 0;
  for (const auto& [prims, program] : programs) {
    program.draw(plan.width_px, plan.height_px, true, ids);
    std::int64_t differ = 0;
    for_each_ray(scene.camera, plan.width_px, plan.height_px,
                 [&, &tree = trees[prims]](std::size_t pixel, const Ray& ray) {
                   const Hit hit = closest_hit(tree, scene.spheres, ray);
                   differ += (hit.found() ? hit.sphere_id : -1) != ids[pixel] ? 1 : 0;
                 });
    most = std::max(most, differ);
  }
  Json result = measured(plan, std::move(times));
  result["pixels_that_differ"] = most;
  return result;
}

// One configuration; null if cancelled.
Json measure_frames(const Experiment& experiment, FrameRatePlan plan, std::int64_t scenario, std::int64_t spheres,
                    GlRenderer* gl) {
  plan.scenarios = {scenario};
  plan.spheres = {spheres};
  FrameRateRun run(plan, gl);
  while (!run.finished()) {
    const Status status = run.step(&experiment.cancel);
    if (experiment.cancel.cancelled()) return {};
    if (!status && gl != nullptr) fail_environment(status.error());
    value_or_fail(status);
  }
  Json times = Json::object();
  for (const MeasuredRate& rate : run.rates())
    times[rate.max_prims ? fmt::format("max_prims{}", *rate.max_prims) : "brute"] = rate.frame_ms;
  return measured(plan, std::move(times));
}

Json measure_reference(const Experiment& experiment, std::int64_t scenario, std::int64_t spheres) {
  return measure_frames(experiment, plan_of(experiment, kDivisor, kQuickReferenceDivisor), scenario, spheres, nullptr);
}

Json measure_shader(const Experiment& experiment, std::int64_t scenario, std::int64_t spheres) {
  const Result<EglContext> egl = EglContext::create();
  if (!egl) return {{"missing", egl.error().message}};
  Result<GlRenderer> renderer = GlRenderer::create(egl->functions());
  if (!renderer) return {{"missing", renderer.error().message}};
  const FrameRatePlan plan = plan_of(experiment, is_software(renderer->description()) ? kDivisor : 1, kQuickDivisor);
  Json result = measure_frames(experiment, plan, scenario, spheres, &*renderer);
  // The fixed cost of a frame: one sphere, and no tree.
  const Json almost_empty = measure_frames(experiment, plan, scenario, 1, &*renderer);
  if (result.is_null() || almost_empty.is_null()) return {};
  result["one_sphere_ms"] = almost_empty["frame_ms"]["brute"];
  result["gpu"] = renderer->description();
  return result;
}

}  // namespace

FrameRatePlan plan_of(const Experiment& experiment, int divisor, int quick_divisor) {
  FrameRatePlan plan = value_or_fail(FrameRatePlan::from_values(experiment.values.stated()))
                           .smaller(experiment.settings.quick ? quick_divisor : divisor);
  plan.seed = experiment.settings.seed;
  plan.threads = experiment.settings.threads;
  plan.rounds = experiment.settings.quick ? 3 : 5;
  return plan;
}

const std::vector<TimedProgram>& timed_programs() {
  static const std::vector<TimedProgram> kPrograms{{"program", "thesis program", measure_program, 3},
                                                   {"reference", "reference engine", measure_reference, 13},
                                                   {"shader", "shader", measure_shader, 7}};
  return kPrograms;
}

bool is_software(const std::string& gpu) {
  return gpu.find("llvmpipe") != std::string::npos || gpu.find("softpipe") != std::string::npos ||
         gpu.find("SwiftShader") != std::string::npos;
}

Json measure_brute_force(const Experiment& experiment) {
  const FrameRatePlan plan = plan_of(experiment, kQuickDivisor, kQuickDivisor);
  Json result = Json::object();
  for (const std::int64_t count : plan.spheres) {
    std::vector<std::int32_t> ids;
    Contestants contestants;
    const auto add = [&](const std::string& name, const Scene& scene) {
      const ThesisProgram program(scene, build_reference_tree(scene.spheres, {kUnlimited, kUnlimited}));
      contestants.emplace_back(name, [&, program] { program.draw(plan.width_px, plan.height_px, false, ids); });
    };
    Scene scene;
    for (const std::int64_t scenario : plan.scenarios)
      add(fmt::format("scenario{}", scenario), scene = value_or_fail(plan.scene(scenario, count)));
    const std::vector<double> zero(static_cast<std::size_t>(count), 0.0), radii(zero.size(), plan.radius);
    scene.spheres = value_or_fail(SphereSet::from_world(zero, zero, zero, radii));
    add("one_place", scene);
    const Json times = times_in_turns(experiment, 2 * plan.rounds, contestants);
    for (const auto& [name, ms] : times.items())
      result[fmt::format("spheres{}", count)][name] = *std::min_element(ms.begin(), ms.end());
  }
  return result;
}

ConfigurationTimes times_of(const Json& result) {
  ConfigurationTimes times;
  const std::string prefix = "max_prims";
  for (const auto& [name, list] : result.at("frame_ms").items())
    (name == "brute" ? times.brute : times.trees[std::stoll(name.substr(prefix.size()))]) =
        list.get<std::vector<double>>();
  return times;
}

}  // namespace bihive::thesis
