#include "frame_times.h"

#include <fmt/format.h>

#include <algorithm>

#include "bihive/bih/reference_builder.h"
#include "bihive/bih/traversal.h"
#include "bihive/gl/egl_context.h"
#include "bihive/gl/gl_renderer.h"
#include "bihive/scene/camera.h"
#include "bihive/thesis/frame_rates.h"
#include "bihive/thesis/thesis_program.h"
#include "processor_time.h"

namespace bihive::thesis {
namespace {

// Rounds that count; one before them warms up.
constexpr int kRounds = 5, kQuickRounds = 3;
// Pictures have a part of the width and height: the time of a ray does not depend on how many there are. On a graphics
// processor it does, so its frames are whole in a full run.
constexpr int kDivisor = 2, kQuickDivisor = 4, kQuickReferenceDivisor = 6;

struct Size {
  int width, height;
};
Size size_of(const StepContext& context, int divisor) {
  const auto side = [&](const char* name) {
    return static_cast<int>(std::clamp<std::int64_t>(context.values.integer(name) / divisor, 1, 65535));
  };
  return {side("width_px"), side("height_px")};
}

int rounds_of(const StepContext& context) {
  return context.settings.quick ? kQuickRounds : kRounds;
}

std::int64_t pixels_that_differ(const std::vector<std::int32_t>& ids, const Scene& scene, const Tree& tree, Size size) {
  const PixelRays pixels(scene.camera, size.width, size.height);
  std::int64_t differ = 0;
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x) {
      const Hit hit = closest_hit(tree, scene.spheres, pixels.at(x + 0.5, y + 0.5));
      const auto pixel =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width) + static_cast<std::size_t>(x);
      differ += (hit.found() ? hit.sphere_id : -1) != ids[pixel] ? 1 : 0;
    }
  return differ;
}

Json measure_program(const StepContext& context, std::int64_t scenario, std::int64_t spheres) {
  const Scene scene = context.values.scene(scenario, spheres, context.settings.seed);
  const Size size = size_of(context, context.settings.quick ? kQuickDivisor : kDivisor);
  // A tree of each MAX_PRIMS, and brute force, which needs none.
  std::map<std::int64_t, ThesisProgram> programs;
  std::map<std::int64_t, Tree> trees;
  for (const std::int64_t prims : context.values.integers("max_prims_list")) {
    trees[prims] = build_reference_tree(scene.spheres, {prims, kUnlimited});
    programs.emplace(prims, ThesisProgram(scene, trees[prims]));
  }

  Json times = {{"brute", Json::array()}};
  std::int64_t differ = 0;
  std::vector<std::int32_t> ids;
  for (int round = -1; round < rounds_of(context); ++round) {
    const auto measure = [&](const std::string& name, const auto& draw) {
      const double before_ms = thread_ms();
      draw();
      if (round >= 0) times[name].push_back(thread_ms() - before_ms);
    };
    measure("brute", [&] { programs.begin()->second.draw_by_brute_force(size.width, size.height, ids); });
    for (const auto& each : programs) {  // clang 14 does not capture bindings
      measure(fmt::format("max_prims{}", each.first), [&] { each.second.draw_by_tree(size.width, size.height, ids); });
      if (round < 0) differ = std::max(differ, pixels_that_differ(ids, scene, trees[each.first], size));
    }
    if (context.cancel.cancelled()) return {};
  }
  return {{"width_px", size.width},
          {"height_px", size.height},
          {"pixels_that_differ", differ},
          {"frame_ms", std::move(times)}};
}

Json measure_contest(const StepContext& context, std::int64_t scenario, std::int64_t spheres, Size size,
                     GlRenderer* gl) {
  FrameRatePlan plan = cli::value_or_fail(FrameRatePlan::from_values(context.values.stated()));
  plan.seed = context.settings.seed;
  plan.threads = context.settings.threads;
  plan.rounds = rounds_of(context);
  plan.width_px = size.width;
  plan.height_px = size.height;
  FrameEngine engine;
  engine.gl = gl;
  FrameContest contest = cli::value_or_fail(FrameContest::of_trees(plan, engine, scenario, spheres));
  while (!contest.finished()) {
    const Status status = contest.step(&context.cancel);
    if (context.cancel.cancelled()) return {};
    if (status) continue;
    if (gl != nullptr) cli::fail_environment(status.error());
    cli::fail(status.error());
  }
  Json times = Json::object();
  for (const MeasuredRate& rate : contest.rates())
    times[rate.max_prims ? fmt::format("max_prims{}", *rate.max_prims) : "brute"] = rate.frame_ms;
  return {{"width_px", size.width}, {"height_px", size.height}, {"frame_ms", std::move(times)}};
}

Json measure_reference(const StepContext& context, std::int64_t scenario, std::int64_t spheres) {
  return measure_contest(context, scenario, spheres,
                         size_of(context, context.settings.quick ? kQuickReferenceDivisor : kDivisor), nullptr);
}

Json measure_shader(const StepContext& context, std::int64_t scenario, std::int64_t spheres) {
  const Result<EglContext> egl = EglContext::create();
  if (!egl) return {{"missing", egl.error().message}};
  Result<GlRenderer> renderer = GlRenderer::create(egl->functions());
  if (!renderer) return {{"missing", renderer.error().message}};
  const Size size = size_of(context, context.settings.quick                 ? kQuickDivisor
                                     : is_software(renderer->description()) ? kDivisor
                                                                            : 1);
  Json result = measure_contest(context, scenario, spheres, size, &*renderer);
  if (result.is_null()) return {};
  // What a frame costs whatever is in it: one sphere, and no tree.
  const Json almost_empty = measure_contest(context, scenario, 1, size, &*renderer);
  if (almost_empty.is_null()) return {};
  result["one_sphere_ms"] = almost_empty["frame_ms"]["brute"];
  result["gpu"] = renderer->description();
  return result;
}

}  // namespace

const std::vector<TimedProgram>& timed_programs() {
  static const std::vector<TimedProgram> kPrograms{{"program", "thesis program", measure_program, 30},
                                                   {"reference", "reference engine", measure_reference, 120},
                                                   {"shader", "shader", measure_shader, 60}};
  return kPrograms;
}

bool is_software(const std::string& gpu) {
  return gpu.find("llvmpipe") != std::string::npos || gpu.find("softpipe") != std::string::npos ||
         gpu.find("SwiftShader") != std::string::npos;
}

Json measure_brute_force(const StepContext& context) {
  const Size size = size_of(context, kQuickDivisor);
  Json result = Json::object();
  for (const std::int64_t count : context.values.integers("spheres_list")) {
    std::vector<std::pair<std::string, Scene>> scenes;
    for (const std::int64_t scenario : context.values.integers("scenarios"))
      scenes.emplace_back(fmt::format("scenario{}", scenario),
                          context.values.scene(scenario, count, context.settings.seed));
    scenes.emplace_back("one_place", scenes.front().second);
    const std::vector<double> zero(static_cast<std::size_t>(count), 0.0);
    const std::vector<double> radii(static_cast<std::size_t>(count), context.values.number("radius"));
    scenes.back().second.spheres = cli::value_or_fail(SphereSet::from_world(zero, zero, zero, radii));

    Json& shortest = result[fmt::format("spheres{}", count)];
    std::vector<std::int32_t> ids;
    for (int round = 0; round <= rounds_of(context) && !context.cancel.cancelled(); ++round)
      for (const auto& [name, scene] : scenes) {
        const ThesisProgram program(scene, build_reference_tree(scene.spheres, {kUnlimited, kUnlimited}));
        const double before = thread_ms();
        program.draw_by_brute_force(size.width, size.height, ids);
        const double ms = thread_ms() - before;
        shortest[name] = round == 0 ? ms : std::min(ms, shortest[name].get<double>());
      }
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
